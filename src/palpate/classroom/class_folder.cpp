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
#include "palpate/scene/toml_table.h"

namespace palpate::classroom {

namespace {

namespace fs = std::filesystem;

constexpr int kMostStations = 999;
constexpr std::uint64_t kMostClassFileBytes = 65536;

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
    throw Error(fmt::format("class '{}': lower-case letters, digits and hyphens, at most 32", plan.class_id));
  }
  if (plan.stations < 1 || plan.stations > kMostStations) {
    throw Error(fmt::format("{} stations: a class has 1 to {}", plan.stations, kMostStations));
  }
  if (plan.hosts.empty()) throw Error("the broker has no name: --host");
  for (const std::string& host : plan.hosts) {
    if (!isHost(host)) throw Error(fmt::format("'{}' is no name or address of a computer", host));
  }
  if (plan.label.find_first_of("\"\\\n\r") != std::string::npos) throw Error("label: without quotes and line ends");
}

void writeMember(const fs::path& folder, Member member, const Certified& authority, const std::string& name) {
  makeFolder(folder);
  const std::string stem(wordFor(member.role));
  const Certified made = makeMemberCertificate(authority, name);
  member.authority = folder / "ca.crt";
  member.certificate = folder / (stem + ".crt");
  member.key = folder / (stem + ".key");
  writeFile(member.authority, authority.certificate);
  writeFile(member.certificate, made.certificate);
  writeKeyFile(member.key, made.key);
  writeFile(folder / (stem + ".toml"), memberText(member));
}

Member memberOf(const ClassFolder& folder, Role role, const std::string& name) {
  Member member;
  member.role = role;
  member.class_id = folder.class_id;
  member.name = name;
  if (role == Role::station) member.station_id = stationIdOf(folder.class_id, name);
  member.host = folder.host;
  member.port = folder.port;
  member.retention = folder.retention;
  return member;
}

Certified authorityOf(const ClassFolder& folder) {
  const fs::path at = folder.folder / "authority";
  return {readFile(at / "ca.crt", kMostClassFileBytes), readFile(at / "ca.key", kMostClassFileBytes)};
}

void writeStation(const ClassFolder& folder, const Certified& authority, const std::string& name) {
  writeMember(folder.station(name), memberOf(folder, Role::station, name), authority, name);
}

std::string numberedStation(int number) { return fmt::format("s{:02d}", number); }

/// Who runs the broker: started as root it would else become a user who may not read the keys.
std::string userNow() {
  const passwd* entry = getpwuid(geteuid());
  return entry == nullptr ? "root" : entry->pw_name;
}

std::string brokerConfiguration(const ClassFolder& folder) {
  const std::string at = fs::absolute(folder.broker()).lexically_normal().string();
  return fmt::format(
      "# Broker of the class \"{0}\": mosquitto -c {1}/mosquitto.conf. Written by `palpate class`, anew at each start "
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
      "acl_file {1}/access.acl\n\n"
      "# Stations keep what is not acknowledged and send it again, so nothing here has to last.\n"
      "persistence false\n"
      "{4}"
      "max_packet_size 131072\n"
      "max_queued_messages 5000\n"
      "set_tcp_nodelay true\n"
      "log_type error\n"
      "log_type warning\n"
      "log_type notice\n",
      folder.class_id, at, folder.port, userNow(),
      fs::exists(folder.revocationList()) ? fmt::format("# Stations that were removed.\ncrlfile {}/revoked.crl\n", at)
                                          : "");
}

}  // namespace

std::string roleCertificateName(Role role) { return std::string(wordFor(role)) + "+"; }

void writeKeyFile(const fs::path& file, const std::string& text) { writePrivateFile(file, text); }

std::string accessList(const std::string& class_id) {
  const std::string root = fmt::format("palpate/v1/{}/st", class_id);
  std::string text = "# Who may read and write which topic; %u is the name in the certificate.\n\n";
  text +=
      "# A station: its own topics alone. (No pattern ever matches a name with a plus sign, so not the roles below.)\n";
  for (const char* kind : {"status", "state", "live", "station", "class", "trainee", "protocol", "session", "block",
                           "trial", "event", "delete"}) {
    text += fmt::format("pattern write {}/%u/{}\n", root, kind);
  }
  text += fmt::format("pattern read {0}/%u/ack\npattern read {0}/%u/cmd\n", root);
  text += fmt::format("\n# The instructor sees all and asks; results are none of theirs to write.\nuser {}\n",
                      roleCertificateName(Role::instructor));
  text += fmt::format("topic read {0}/#\ntopic write {0}/+/cmd\n", root);
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
    throw Error::inFile(folder.string(), "is there already; a class gets a folder of its own");
  }
  ClassFolder made{folder, plan.class_id, plan.label, plan.hosts.front(), plan.port, plan.retention, {}};
  makeFolder(folder);
  fs::permissions(folder, fs::perms::owner_all);
  const Certified authority = makeAuthority(fmt::format("palpate class {}", plan.class_id));
  makeFolder(folder / "authority");
  writeFile(folder / "authority" / "ca.crt", authority.certificate);
  writeKeyFile(folder / "authority" / "ca.key", authority.key);

  std::vector<std::string> hosts = plan.hosts;
  for (const char* here : {"localhost", "127.0.0.1"}) {
    if (std::ranges::find(hosts, here) == hosts.end()) hosts.emplace_back(here);
  }
  const Certified server = makeServerCertificate(authority, hosts);
  makeFolder(made.broker());
  writeFile(made.broker() / "ca.crt", authority.certificate);
  writeFile(made.broker() / "server.crt", server.certificate);
  writeKeyFile(made.broker() / "server.key", server.key);
  writeBrokerConfiguration(made);

  for (const auto& [role, at] :
       {std::pair(Role::instructor, made.instructor()), std::pair(Role::ingest, made.ingest())}) {
    writeMember(at, memberOf(made, role, std::string(wordFor(role))), authority, roleCertificateName(role));
  }
  for (int i = 1; i <= plan.stations; ++i) {
    made.stations.push_back(numberedStation(i));
    writeStation(made, authority, made.stations.back());
  }
  writeFile(
      folder / "class.toml",
      fmt::format("# A class: `palpate class init` made this folder.\nid = \"{}\"\nlabel = \"{}\"\nhost = \"{}\"  # "
                  "the broker's, as stations reach it\nport = {}\n\n{}",
                  plan.class_id, plan.label, made.host, made.port, retentionText(plan.retention)));
  return made;
}

ClassFolder readClassFolder(const fs::path& folder) {
  const fs::path file = folder / "class.toml";
  const std::string text = readFile(file, kMostClassFileBytes);
  const std::string name = file.string();
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw Error::atLine(name, error.source().begin.line, error.description());
  }
  const scene::TomlTable table(root, name, "a class",
                               {"id", "label", "host", "port", "retain_days", "retain_samples_days"});
  ClassFolder read;
  read.folder = folder;
  table.read("id", read.class_id);
  table.read("label", read.label);
  table.read("host", read.host);
  table.read("port", read.port, NumberRange{1, 65535});
  readRetention(table, read.retention);
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
  std::vector<std::string> certificates = {readFile(at / "station.crt", kMostClassFileBytes)};
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(revoked, none)) {
    certificates.push_back(readFile(entry.path() / "station.crt", kMostClassFileBytes));
  }
  // First the list: whatever happens then, the station stays out.
  writeFile(folder.revocationList(), makeRevocationList(authorityOf(folder), certificates));
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
    throw Error(fmt::format("station '{}': lower-case letters, digits and hyphens, at most 32", added));
  }
  if (fs::exists(folder.station(added))) throw Error::inFile(folder.station(added).string(), "is there already");
  writeStation(folder, authorityOf(folder), added);
  return added;
}

}  // namespace palpate::classroom
