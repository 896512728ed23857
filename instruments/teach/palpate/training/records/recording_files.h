// The recordings of a store: where each session's lies, locked once it is over, opened for a replay.
//
//   store's folder / sessions / SITTING.session ─ lock (session over) ─► SITTING.session.locked ─ open ─► a temporary
//   file
//
//   RecordingFiles files(store);
//   row.file = files.nameFor(row.id);                    // record into files.pathOf(row.file)
//   trainee.key_ref = files.keyOf(trainee.id);           // once; the trainee is kept already
//   files.lock(row.id);                                  // after the recorder has finished and the session's end is
//   kept
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/training/records/key_vault.h"
#include "palpate/training/records/store.h"

namespace palpate::training {

inline constexpr std::string_view kLockedExtension = ".locked";

/// A recording in the clear, in a file that is removed with this object.
class OpenedRecording {
 public:
  explicit OpenedRecording(std::filesystem::path file) : file_(std::move(file)) {}
  ~OpenedRecording();
  OpenedRecording(OpenedRecording&& other) noexcept : file_(std::exchange(other.file_, {})) {}
  OpenedRecording(const OpenedRecording&) = delete;
  OpenedRecording& operator=(const OpenedRecording&) = delete;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

class RecordingFiles {
 public:
  /// `store` outlives it.
  explicit RecordingFiles(Store& store) : store_(store), vault_(store.file()) {}

  /// SessionRow::file, while it is recorded: "sessions/SITTING.session".
  static std::string nameFor(const Uuid& session);
  /// Path of SessionRow::file. Throws Error for a name that leads out of the folder.
  std::filesystem::path pathOf(const std::string& name) const;

  /// Where recordings are kept, for its owner alone (mode 0700, also where an earlier version left it open). Throws
  /// Error.
  void makeFolder() const;

  /// The name of the trainee's key, made and kept if missing. Throws Error for an unknown trainee.
  std::string keyOf(const Uuid& trainee);

  /// Locks the session's file, keeps its new name and its SHA-256, and removes the open one. A file that its recorder
  /// left unfinished is finished first. False: none was recorded. Throws Error; the open file is then still there.
  bool lock(const Uuid& session);
  /// The same for all that were left behind and have not changed for this time: a recorder may still write to newer
  /// ones.
  int lockLeftBehind(double older_than_s = 600.0);

  /// Into a folder for temporary files. Throws Error where the file or its key is gone.
  OpenedRecording open(const SessionRow& session) const;

  /// Whatever lies in the folder of this session: recorded, unfinished, locked, SQLite's own.
  std::vector<std::filesystem::path> sessionFiles(const Uuid& session) const;
  std::filesystem::path folder() const { return store_.folder() / "sessions"; }
  KeyVault& vault() { return vault_; }

 private:
  Store& store_;
  KeyVault vault_;
};

}  // namespace palpate::training
