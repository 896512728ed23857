// The keys of a station's trainees: NAME.keys next to NAME.results, readable by its owner alone, one random key each. A
// trainee is forgotten by destroying their key: copies and backups of their recordings are unreadable. So the file of
// keys is the one that must not be backed up together with the others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpate/training/records/locked_file.h"

namespace palpate::training {

class KeyVault {
 public:
  /// The vault of a file of records. Nothing is created or opened before it is needed.
  explicit KeyVault(const std::filesystem::path& records);

  /// A new key, safe on the disk; its name does not reveal whose it is. Throws Error.
  std::string make();
  /// Returns nothing for a missing or destroyed key. Throws Error for a vault that cannot be read.
  std::optional<TraineeKey> find(const std::string& key_ref) const;
  /// Overwritten in the file, then removed. True: there was one.
  bool destroy(const std::string& key_ref);

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace palpate::training
