// Functions by which training reaches a class over the network. A program with a network provides them: training itself
// knows no broker and no database server.
//
//   folder ─ station ─► ClassStation ─ connect ─► ClassLink ◄─ window: samples, session        commands ─► window
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/trace/sample.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/store.h"
#include "palpate/training/session/session.h"

namespace palpate::training {

enum class InstructorAct : std::uint8_t {
  pause,       ///< stops the trial's clock
  go_on,       ///< after a pause
  message,     ///< words for the trainee
  next_block,  ///< put this block down and begin the next
};
/// Instructors' commands to a station. None affects force or device.
struct InstructorCommand {
  InstructorAct kind = InstructorAct::pause;
  std::string text;  ///< text of a message, at most 200 bytes
  friend bool operator==(const InstructorCommand&, const InstructorCommand&) = default;
};

/// A station's connection, open while one of these functions is kept: stored rows go to the class by themselves.
struct ClassLink {
  std::function<void(const trace::Sample&)> felt;
  std::function<void(const Session*)> follow;                     ///< once a frame; null: no trainee is signed in
  std::function<void(const std::string&)> publish_safety;         ///< "ok", or what stopped the device
  std::function<std::optional<InstructorCommand>()> pop_command;  ///< oldest first
};

/// A station of a class, as its folder describes it.
struct ClassStation {
  ClassRow of;              ///< with how long the class keeps
  StationRow row;           ///< its id and name
  std::string trainee_key;  ///< the class's secret, for pseudonyms; empty: an older class has none
  /// The store must outlive the link. `app`: "palpate 0.9"; `device`: "mouse". A missing broker is not an error. Throws
  /// Error for certificates that cannot be used and for a file that cannot be opened.
  std::function<ClassLink(Store& store, const std::string& app, const std::string& device)> connect;
};

struct ClassSecret {
  std::string class_id;
  std::string key;  ///< as ClassStation::trainee_key
};

/// Whether rows were erased from a class's database, and what of them is still in the server's files (empty: nothing).
struct ErasedFromDatabase {
  bool found = false;
  std::string left;
};
struct PurgedFromDatabase {
  Purged purged;
  std::string left;
};

/// All of it, in one place. An address is one that isDatabaseAddress knows; every function throws Error.
struct ClassPart {
  ClassStation (*station)(const std::filesystem::path& folder) = nullptr;
  /// Reads the secret in a class's folder or a station's.
  ClassSecret (*secret)(const std::filesystem::path& folder) = nullptr;
  /// A snapshot, in memory: "database NAME".
  Store (*copy_of_database)(const std::string& address) = nullptr;
  ErasedFromDatabase (*erase)(const std::string& address, const Uuid& trainee, std::string_view actor) = nullptr;
  PurgedFromDatabase (*purge)(const std::string& address, std::int64_t now_ms) = nullptr;
  /// RowTables::note, in the database.
  void (*note)(const std::string& address, std::string_view actor, std::string_view what,
               const std::string& detail) = nullptr;
};

}  // namespace palpate::training
