// A program's class and its role in it: the folders that `palpate class init` made (class_folder.h), read and checked.
//
//   DIR/stations/s01/station.toml ─ readMember ─► Member ─► StationLink, Collector, ClassWatch
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/base/number_range.h"
#include "palpate/base/words.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/rows.h"

namespace palpate::scene {
class TomlTable;
}

namespace palpate::classroom {

/// Purpose of a certificate; the broker's access list gives each its topics.
enum class Role : std::uint8_t {
  station,     ///< publishes under its own name, receives its own commands and acknowledgements
  instructor,  ///< reads all, writes commands
  ingest,      ///< reads rows, writes acknowledgements
  checker,     ///< checks that broker, collector and database answer (`palpate class check`)
};

inline constexpr int kStandardPort = 8883;  // MQTT over TLS, as registered

/// Retention of a class's records, in whole days after a session (training::ClassRow).
struct Retention {
  int days = training::ClassRow().retain_days;                  ///< rows
  int samples_days = training::ClassRow().retain_samples_days;  ///< recordings
  friend bool operator==(const Retention&, const Retention&) = default;
};
inline constexpr NumberRange kRetentionDays = {1, 36500};

/// One who takes part.
struct Member {
  Role role = Role::station;
  std::string class_id;       ///< "osteo-1"
  std::string name;           ///< in topics and as the certificate's subject: "s01"; "instructor", "ingest", "checker"
  training::Uuid station_id;  ///< id in its rows (training::StationRow::id); empty for the other roles
  std::string host = "localhost";
  int port = kStandardPort;
  Retention retention;  ///< for a station's own records
  /// The class's secret, from which trainees' ids are made (training::derivePseudonym); empty: an older class has none.
  std::string trainee_key;
  // Absolute, once read.
  std::filesystem::path authority;    ///< ca.crt: who signed the broker's certificate
  std::filesystem::path certificate;  ///< this member's certificate
  std::filesystem::path key;          ///< private key, readable only by its owner
  friend bool operator==(const Member&, const Member&) = default;
};

/// The file, or the folder that holds `station.toml`, `instructor.toml` or `ingest.toml`. Throws Error with the line
/// for an unknown key or a value that makes no sense, and for a certificate or key that is not there.
Member readMember(const std::filesystem::path& file_or_folder);
Member parseMember(std::string_view text, const std::filesystem::path& file);
/// With explanations; parseMember gives the same back. Files are named relative to the folder of the text's own.
std::string memberText(const Member& member);

/// `retain_days` and `retain_samples_days`; missing keys keep their values. Throws Error with the line.
void readRetention(const scene::TomlTable& table, Retention& retention);
std::string retentionText(const Retention& retention);

using training::isClassWord;
/// A class word that is not the name of a role.
bool isStationName(std::string_view text);

/// The file of the class's secret, in the class's folder and in each station's: 64 hex digits, its owner's alone.
inline constexpr const char* kTraineeKeyFile = "trainees.key";
/// Throws Error if the file does not hold a key; empty if it does not exist.
std::string readTraineeKey(const std::filesystem::path& folder);

/// Any computer makes the same of the same names.
training::Uuid deriveStationId(std::string_view class_id, std::string_view station);

}  // namespace palpate::classroom

template <>
struct palpate::WordsOf<palpate::classroom::Role> {
  using V = palpate::classroom::Role;
  static constexpr std::array kAll = {Word{"station", V::station}, Word{"instructor", V::instructor},
                                      Word{"ingest", V::ingest}, Word{"checker", V::checker}};
};
