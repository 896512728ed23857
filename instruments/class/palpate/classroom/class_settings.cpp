#include "palpate/classroom/class_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/toml_table.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/sha256.h"

namespace palpate::classroom {

namespace {

constexpr std::uint64_t kMaxMemberBytes = 65536;
constexpr NumberRange kPortRange = {1, 65535};

std::filesystem::path fileNamed(const scene::TomlTable& table, const char* key, const std::filesystem::path& folder) {
  std::string name;
  table.read(key, name);
  if (name.empty()) table.fail(fmt::format("{} is missing: a file", key));
  return (folder / name).lexically_normal();
}

Role readRole(const scene::TomlTable& table) {
  std::string word;
  table.read("role", word);
  const auto role = valueNamed<Role>(word);
  if (!role) table.fail("role must be station, instructor, ingest or checker");
  return *role;
}

void checkNames(const scene::TomlTable& table, const Member& member) {
  if (!isClassWord(member.class_id)) {
    table.fail("class is a word of lower-case letters, digits and hyphens, at most 32");
  }
  if (member.host.empty() || member.host.size() > 253) table.fail("host is the broker's name or address");
  if (member.role != Role::station) return;
  if (!isStationName(member.name)) {
    table.fail("name is a word of lower-case letters, digits and hyphens, at most 32, and no role's");
  }
  if (!training::isUuid(member.station_id)) table.fail("station_id is a UUID");
}

/// A UUID of version 8 that any two computers make of the same text.
training::Uuid uuidOfName(const std::string& text) {
  std::string hex = training::sha256Hex(text).substr(0, 32);
  hex[12] = '8';
  hex[16] = "89ab"[static_cast<unsigned char>(hex[16]) % 4];
  return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4),
                     hex.substr(20));
}

}  // namespace

Member parseMember(std::string_view text, const std::filesystem::path& file) {
  const std::string name = file.string();
  const scene::TomlNode root = scene::parseToml(text, name);
  const scene::TomlTable table(root, name, "a member of a class",
                               {"role", "class", "name", "station_id", "host", "port", "retain_days",
                                "retain_samples_days", "authority", "certificate", "key"});
  Member member;
  member.role = readRole(table);
  member.name = wordFor(member.role);
  table.read("class", member.class_id);
  table.read("name", member.name);
  table.read("station_id", member.station_id);
  table.read("host", member.host);
  table.read("port", member.port, kPortRange);
  readRetention(table, member.retention);
  checkNames(table, member);
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  member.authority = fileNamed(table, "authority", folder);
  member.certificate = fileNamed(table, "certificate", folder);
  member.key = fileNamed(table, "key", folder);
  return member;
}

Member readMember(const std::filesystem::path& file_or_folder) {
  std::filesystem::path file = file_or_folder;
  if (std::filesystem::is_directory(file)) {
    constexpr std::array kNames = {"station.toml", "instructor.toml", "ingest.toml", "checker.toml"};
    const auto* const found =
        std::ranges::find_if(kNames, [&](const char* name) { return std::filesystem::exists(file_or_folder / name); });
    if (found == kNames.end()) {
      throw Error::inFile(file.string(), "has no station.toml, instructor.toml, ingest.toml or checker.toml");
    }
    file /= *found;
  }
  Member member = parseMember(readFile(file, kMaxMemberBytes), file);
  member.trainee_key = readTraineeKey(file.parent_path());
  for (const auto& needed : {member.authority, member.certificate, member.key}) {
    if (!std::filesystem::is_regular_file(needed)) {
      throw Error::inFile(file.string(), fmt::format("names {}, which does not exist", needed.string()));
    }
  }
  return member;
}

std::string readTraineeKey(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kTraineeKeyFile;
  if (!std::filesystem::exists(file)) return {};
  std::string key(trimmed(readFile(file, kMaxMemberBytes)));
  if (!training::isHash(key)) throw Error::inFile(file.string(), "must hold 64 hex digits");
  return key;
}

std::string memberText(const Member& member) {
  std::string text = fmt::format("# One who takes part in a class: `palpate class init` made this.\nrole = \"{}\"\n",
                                 wordFor(member.role));
  text += fmt::format("class = \"{}\"\n", member.class_id);
  if (member.role == Role::station) {
    text += fmt::format("name = \"{}\"  # in topics, and what the certificate says\nstation_id = \"{}\"\n", member.name,
                        member.station_id);
  }
  text += fmt::format("\n# The broker.\nhost = \"{}\"\nport = {}\n", member.host, member.port);
  if (member.role == Role::station) text += "\n" + retentionText(member.retention);
  text += fmt::format(
      "\n# Beside this file: who signed the broker's certificate, and what this member shows. Whoever has the key is "
      "this\n# member.\nauthority = \"{}\"\ncertificate = \"{}\"\nkey = \"{}\"\n",
      member.authority.filename().string(), member.certificate.filename().string(), member.key.filename().string());
  return text;
}

void readRetention(const scene::TomlTable& table, Retention& retention) {
  table.read("retain_days", retention.days, kRetentionDays);
  table.read("retain_samples_days", retention.samples_days, kRetentionDays);
}

std::string retentionText(const Retention& retention) {
  return fmt::format(
      "# Days after a session for which rows, and recordings, are kept; `palpate train results purge` forgets what "
      "is older.\nretain_days = {}\nretain_samples_days = {}\n",
      retention.days, retention.samples_days);
}

bool isStationName(std::string_view text) {
  return isClassWord(text) && !valueNamed<Role>(text == wordFor(Role::station) ? "" : text);
}

training::Uuid deriveStationId(std::string_view class_id, std::string_view station) {
  return uuidOfName(fmt::format("palpate station\n{}\n{}", class_id, station));
}

}  // namespace palpate::classroom
