#include "palpate/classroom/class_folder.h"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/classroom/certificates.h"
#include "palpate/scene/detail/toml_table.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxStations = 999;
constexpr std::uint64_t kMaxClassFileBytes = 65536;

void makeFolder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error::inFile(folder.string(), fault.message());
}

/// Words of a host's name or address: they go into certificates and configurations as they are.
bool isHost(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
           c == ':';
  };
  return !text.empty() && text.size() <= 253 && std::ranges::all_of(text, plain);
}

void checkPlan(const ClassPlan& plan) {
  if (!isClassWord(plan.class_id)) {
    throw Error(fmt::format("class '{}': expected lower-case letters, digits and hyphens, at most 32", plan.class_id));
  }
  if (plan.stations < 1 || plan.stations > kMaxStations) {
    throw Error(fmt::format("{} stations: expected 1 to {}", plan.stations, kMaxStations));
  }
  if (plan.hosts.empty()) throw Error("the broker has no name; give one with --host");
  for (const std::string& host : plan.hosts) {
    if (!isHost(host)) throw Error(fmt::format("'{}' must be the name or address of a computer", host));
  }
  if (plan.label.find_first_of("\"\\\n\r") != std::string::npos)
    throw Error("label: must not contain quotes, backslashes or line breaks");
}

void writeMember(const fs::path& folder, Member member, const Certified& authority, const std::string& name,
                 int days = kMemberDays) {
  makeFolder(folder);
  const std::string stem(wordFor(member.role));
  const Certified made = makeMemberCertificate(authority, name, days);
  member.authority = folder / "ca.crt";
  member.certificate = folder / (stem + ".crt");
  member.key = folder / (stem + ".key");
  writeFile(member.authority, authority.certificate);
  writeFile(member.certificate, made.certificate);
  writeKeyFile(member.key, made.key);
  if (!member.trainee_key.empty()) writeKeyFile(folder / kTraineeKeyFile, member.trainee_key + "\n");
  writeFile(folder / (stem + ".toml"), memberText(member));
}

Member makeMember(const ClassFolder& folder, Role role, const std::string& name) {
  Member member;
  member.role = role;
  member.class_id = folder.class_id;
  member.name = name;
  if (role == Role::station) member.station_id = deriveStationId(folder.class_id, name);
  member.host = folder.host;
  member.port = folder.port;
  member.retention = folder.retention;
  if (role == Role::station) member.trainee_key = folder.trainee_key;
  return member;
}

Certified readAuthority(const ClassFolder& folder) {
  const fs::path at = folder.folder / "authority";
  return {readFile(at / "ca.crt", kMaxClassFileBytes), readFile(at / "ca.key", kMaxClassFileBytes)};
}

void writeStation(const ClassFolder& folder, const Certified& authority, const std::string& name,
                  int days = kMemberDays) {
  writeMember(folder.station(name), makeMember(folder, Role::station, name), authority, name, days);
}

void writeRole(const ClassFolder& folder, const Certified& authority, Role role, int number = 1,
               int days = kMemberDays) {
  const fs::path at = role == Role::instructor ? folder.instructor(number) : folder.folder / wordFor(role);
  writeMember(at, makeMember(folder, role, std::string(wordFor(role))), authority, roleCertificateName(role, number),
              days);
}

void writeServer(const ClassFolder& folder, const Certified& authority, const std::vector<std::string>& hosts,
                 int days = kMemberDays) {
  const Certified server = makeServerCertificate(authority, hosts, days);
  writeFile(folder.broker() / "ca.crt", authority.certificate);
  writeFile(folder.broker() / "server.crt", server.certificate);
  writeKeyFile(folder.broker() / "server.key", server.key);
}

std::string newTraineeKey() {
  std::string key;
  for (int i = 0; i < 2; ++i) {
    for (const std::uint64_t bits : training::systemRandom()) key += fmt::format("{:016x}", bits);
  }
  return key;
}

/// Numbers of the existing windows.
std::vector<int> findInstructorNumbers(const ClassFolder& folder) {
  std::vector<int> numbers;
  for (int number = 1; number <= kMaxInstructors; ++number) {
    if (fs::exists(folder.instructor(number) / "instructor.toml")) numbers.push_back(number);
  }
  return numbers;
}

std::string numberedStation(int number) { return fmt::format("s{:02d}", number); }

/// The user who runs the broker: started as root it would else become a user who may not read the keys.
std::string effectiveUserName() {
  const passwd* entry = getpwuid(geteuid());
  return entry == nullptr ? "root" : entry->pw_name;
}

std::string brokerConfiguration(const ClassFolder& folder) {
  const std::string at = fs::absolute(folder.broker()).lexically_normal().string();
  return fmt::format(
      "# Broker of the class \"{0}\": mosquitto -c {1}/mosquitto.conf. Written by `palpate class`, again at each start "
      "of\n"
      "# `palpate class serve --broker`: changes are lost.\n"
      "per_listener_settings false\n"
      "allow_anonymous false\n"
      "user {3}\n\n"
      "listener {2}\n"
      "cafile {1}/ca.crt\n"
      "certfile {1}/server.crt\n"
      "keyfile {1}/server.key\n"
      "# Nobody without a certificate of this class; what it is called is who it is. TLS 1.2 and later.\n"
      "require_certificate true\n"
      "use_identity_as_username true\n"
      "# A certificate is one connection and one session: nobody can throw another out by its client id.\n"
      "use_username_as_clientid true\n"
      "max_connections 900\n"
      "max_qos 1\n"
      "acl_file {1}/access.acl\n\n"
      "# Stations keep what is not acknowledged and send it again, so nothing here has to last.\n"
      "persistence false\n"
      "{4}"
      "persistent_client_expiration 1h\n"
      "max_packet_size 131072\n"
      "max_inflight_messages 100\n"
      "max_inflight_bytes 4194304\n"
      "max_queued_messages 5000\n"
      "max_queued_bytes 16777216\n"
      "max_keepalive 60\n"
      "memory_limit 536870912\n"
      "set_tcp_nodelay true\n"
      "log_type error\n"
      "log_type warning\n"
      "log_type notice\n",
      folder.class_id, at, folder.port, effectiveUserName(),
      fs::exists(folder.revocationList()) ? fmt::format("# Stations that were removed.\ncrlfile {}/revoked.crl\n", at)
                                          : "");
}

}  // namespace

fs::path ClassFolder::instructor(int number) const {
  return folder / (number == 1 ? std::string("instructor") : fmt::format("instructor-{}", number));
}

std::string roleCertificateName(Role role, int number) {
  return number == 1 ? fmt::format("{}+", wordFor(role)) : fmt::format("{}+{}", wordFor(role), number);
}

void writeKeyFile(const fs::path& file, const std::string& text) { writePrivateFile(file, text); }

std::string accessList(const std::string& class_id) {
  const std::string root = fmt::format("palpate/v1/{}/st", class_id);
  std::string text = "# Who may read and write which topic; %u is the name in the certificate.\n\n";
  text +=
      "# A station: its own topics alone. (No pattern ever matches a name with a plus sign, so not the roles below.)\n";
  for (const char* kind : {"status", "state", "live", "station", "class", "trainee", "protocol", "session", "block",
                           "trial", "event", "delete", "check"}) {
    text += fmt::format("pattern write {}/%u/{}\n", root, kind);
  }
  text += fmt::format("pattern read {0}/%u/ack\npattern read {0}/%u/cmd\n", root);
  text += "\n# The instructor's windows see all, ask, and delete; results are none of theirs to write.\n";
  for (int number = 1; number <= kMaxInstructors; ++number) {
    text += fmt::format("user {1}\ntopic read {0}/#\ntopic write {0}/+/cmd\ntopic write {0}/instructor/delete\n", root,
                        roleCertificateName(Role::instructor, number));
  }
  text +=
      fmt::format("\n# `palpate class check`.\nuser {1}\ntopic write {0}/checker/check\ntopic read {0}/checker/ack\n",
                  root, roleCertificateName(Role::checker));
  text += fmt::format(
      "\n# The collector reads rows and acknowledges them; it clears the state of somebody who was deleted.\nuser {}\n",
      roleCertificateName(Role::ingest));
  text += fmt::format("topic read {0}/#\ntopic write {0}/+/ack\ntopic write {0}/+/state\n", root);
  return text;
}

void writeBrokerConfiguration(const ClassFolder& folder) {
  writeFile(folder.broker() / "access.acl", accessList(folder.class_id));
  writeFile(folder.configuration(), brokerConfiguration(folder));
}

ClassFolder makeClassFolder(const fs::path& folder, const ClassPlan& plan) {
  checkPlan(plan);
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder))) {
    throw Error::inFile(folder.string(), "exists already; a class needs a new or empty folder");
  }
  ClassFolder made{.folder = folder,
                   .class_id = plan.class_id,
                   .label = plan.label,
                   .host = plan.hosts.front(),
                   .port = plan.port,
                   .retention = plan.retention,
                   .trainee_key = newTraineeKey(),
                   .stations = {}};
  makeFolder(folder);
  fs::permissions(folder, fs::perms::owner_all);
  const Certified authority = makeAuthority(fmt::format("palpate class {}", plan.class_id));
  makeFolder(folder / "authority");
  writeFile(folder / "authority" / "ca.crt", authority.certificate);
  writeKeyFile(folder / "authority" / "ca.key", authority.key);
  writeKeyFile(folder / kTraineeKeyFile, made.trainee_key + "\n");

  std::vector<std::string> hosts = plan.hosts;
  for (const char* here : {"localhost", "127.0.0.1"}) {
    if (std::ranges::find(hosts, here) == hosts.end()) hosts.emplace_back(here);
  }
  makeFolder(made.broker());
  writeServer(made, authority, hosts);
  writeBrokerConfiguration(made);

  for (const Role role : {Role::instructor, Role::ingest, Role::checker}) writeRole(made, authority, role);
  for (int i = 1; i <= plan.stations; ++i) {
    made.stations.push_back(numberedStation(i));
    writeStation(made, authority, made.stations.back());
  }
  writeFile(
      folder / "class.toml",
      fmt::format("# A class: `palpate class init` made this folder.\nid = \"{}\"\nlabel = \"{}\"\nhost = \"{}\"  # "
                  "the broker's, as stations reach it\nport = {}\n\n{}\n# A station's share of the disk in the class's "
                  "records, MB since the last purge.\nstation_megabytes = {}\n",
                  plan.class_id, plan.label, made.host, made.port, retentionText(plan.retention),
                  made.station_megabytes));
  return made;
}

ClassFolder readClassFolder(const fs::path& folder) {
  const fs::path file = folder / "class.toml";
  const std::string text = readFile(file, kMaxClassFileBytes);
  const std::string name = file.string();
  const scene::TomlNode root = scene::parseToml(text, name);
  const scene::TomlTable table(
      root, name, "a class",
      {"id", "label", "host", "port", "retain_days", "retain_samples_days", "station_megabytes"});
  ClassFolder read;
  read.folder = folder;
  table.read("id", read.class_id);
  table.read("label", read.label);
  table.read("host", read.host);
  table.read("port", read.port, NumberRange{1, 65535});
  readRetention(table, read.retention);
  int megabytes = static_cast<int>(read.station_megabytes);
  table.read("station_megabytes", megabytes, NumberRange{1, 1'000'000});
  read.station_megabytes = megabytes;
  read.trainee_key = readTraineeKey(folder);
  if (!isClassWord(read.class_id)) table.fail("id is a word of lower-case letters, digits and hyphens, at most 32");
  if (!isHost(read.host)) table.fail("host is the broker's name or address");
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder / "stations", fault)) {
    const std::string station = entry.path().filename().string();
    if (isStationName(station) && fs::exists(entry.path() / "station.toml")) read.stations.push_back(station);
  }
  std::ranges::sort(read.stations);
  return read;
}

void removeStation(const ClassFolder& folder, const std::string& name) {
  const fs::path at = folder.station(name);
  if (!isStationName(name) || !fs::exists(at / "station.crt")) {
    throw Error::inFile(folder.folder.string(), fmt::format("has no station '{}'", name));
  }
  const fs::path revoked = folder.folder / "revoked";
  std::vector<std::string> certificates = {readFile(at / "station.crt", kMaxClassFileBytes)};
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(revoked, none)) {
    certificates.push_back(readFile(entry.path() / "station.crt", kMaxClassFileBytes));
  }
  // First the list: whatever happens then, the station stays out.
  writeFile(folder.revocationList(), makeRevocationList(readAuthority(folder), certificates));
  makeFolder(revoked);
  int number = 1;
  while (fs::exists(revoked / fmt::format("{}-{}", name, number))) ++number;
  fs::rename(at, revoked / fmt::format("{}-{}", name, number));
  fs::remove(revoked / fmt::format("{}-{}", name, number) / "station.key");
  writeBrokerConfiguration(folder);
}

std::string addStation(const ClassFolder& folder, const std::string& name) {
  std::string added = name;
  for (int number = 1; added.empty(); ++number) {
    if (!fs::exists(folder.station(numberedStation(number)))) added = numberedStation(number);
  }
  if (!isStationName(added)) {
    throw Error(fmt::format("station '{}': expected lower-case letters, digits and hyphens, at most 32", added));
  }
  if (fs::exists(folder.station(added)))
    throw Error::inFile(folder.station(added).string(), "exists already; name another station");
  writeStation(folder, readAuthority(folder), added);
  return added;
}

fs::path addInstructor(const ClassFolder& folder) {
  for (int number = 1; number <= kMaxInstructors; ++number) {
    const fs::path at = folder.instructor(number);
    if (fs::exists(at)) continue;
    writeRole(folder, readAuthority(folder), Role::instructor, number);
    return at;
  }
  throw Error::inFile(folder.folder.string(),
                      fmt::format("already has {} instructors, the most allowed", kMaxInstructors));
}

std::vector<fs::path> renewCertificates(const ClassFolder& folder, const std::vector<std::string>& names, int days) {
  const Certified authority = readAuthority(folder);
  days = std::min(days, daysLeft(authority.certificate));
  if (days <= 0) {
    throw Error::inFile((folder.folder / "authority/ca.crt").string(),
                        "has expired; make a new class (`palpate class init`) and copy its folders to the stations");
  }
  std::vector<std::string> left = names;
  std::vector<fs::path> renewed;
  // Once for each that exists and was requested.
  const auto renew = [&](const fs::path& at, const auto& write) {
    const std::string name = at.filename().string();
    if (!names.empty() && std::erase(left, name) == 0) return;
    write();
    renewed.push_back(at);
  };
  renew(folder.broker(), [&] {
    writeServer(folder, authority, certificateHosts(readFile(folder.broker() / "server.crt", kMaxClassFileBytes)),
                days);
  });
  for (const int number : findInstructorNumbers(folder)) {
    renew(folder.instructor(number), [&] { writeRole(folder, authority, Role::instructor, number, days); });
  }
  renew(folder.ingest(), [&] { writeRole(folder, authority, Role::ingest, 1, days); });
  renew(folder.checker(), [&] { writeRole(folder, authority, Role::checker, 1, days); });
  for (const std::string& name : folder.stations) {
    renew(folder.station(name), [&] { writeStation(folder, authority, name, days); });
  }
  if (!left.empty()) throw Error::inFile(folder.folder.string(), fmt::format("has no member '{}'", left.front()));
  writeBrokerConfiguration(folder);
  return renewed;
}

std::vector<CertificateLife> certificateLives(const ClassFolder& folder) {
  std::vector<CertificateLife> lives;
  const auto add = [&lives](const std::string& whose, const fs::path& file) {
    lives.push_back({whose, file, daysLeft(readFile(file, kMaxClassFileBytes))});
  };
  add("the class's authority", folder.folder / "authority/ca.crt");
  add("the broker", folder.broker() / "server.crt");
  for (const int number : findInstructorNumbers(folder)) {
    add(number == 1 ? std::string("the instructor") : fmt::format("instructor {}", number),
        folder.instructor(number) / "instructor.crt");
  }
  add("the collector", folder.ingest() / "ingest.crt");
  if (fs::exists(folder.checker())) add("the checker", folder.checker() / "checker.crt");
  for (const std::string& name : folder.stations) add(name, folder.station(name) / "station.crt");
  return lives;
}

std::vector<std::string> certificateWarnings(const std::vector<CertificateLife>& lives) {
  std::vector<std::string> warnings;
  for (const CertificateLife& life : lives) {
    if (life.days_left > kWarnDays) continue;
    warnings.push_back(
        life.days_left < 0
            ? fmt::format("the certificate of {} has ended; `palpate class renew` makes a new one", life.whose)
            : fmt::format("the certificate of {} ends in {} days; `palpate class renew` makes a new one", life.whose,
                          life.days_left));
  }
  return warnings;
}

std::string outdatedConfiguration(const ClassFolder& folder) {
  std::error_code fault;
  if (!fs::exists(folder.configuration(), fault)) return "is missing";
  const std::string there = readFile(folder.configuration(), kMaxClassFileBytes);
  const std::string access = readFile(folder.broker() / "access.acl", kMaxClassFileBytes);
  std::string lacks;
  const std::string now = brokerConfiguration(folder);
  for (const std::string_view line : split(now, '\n')) {
    if (line.empty() || line.starts_with('#')) continue;
    if (("\n" + there).find("\n" + std::string(line) + "\n") != std::string::npos) continue;
    lacks += fmt::format("{}{}", lacks.empty() ? "lacks " : ", ", line.substr(0, line.find(' ')));
  }
  if (lacks.empty() && access != accessList(folder.class_id)) lacks = "has another access list";
  return lacks;
}

std::string keyFileFault(const fs::path& file) {
  std::error_code fault;
  const fs::perms allowed = fs::status(file, fault).permissions();
  if (fault || !fs::exists(file, fault)) return "is missing";
  if ((allowed & (fs::perms::group_all | fs::perms::others_all)) == fs::perms::none) return {};
  return fmt::format("can be used by others (mode {:o}): chmod 600 {}", static_cast<unsigned>(allowed) & 0777U,
                     file.string());
}

}  // namespace palpate::classroom
