// The keys of a station's trainees: NAME.keys next to NAME.results, readable by its owner alone, one random key each. A
// trainee is forgotten by destroying their key: copies and backups of their recordings are unreadable. So the file of
// keys is the one that must not be backed up together with the others.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace palpate::training {

// A file that only its trainee's key opens: a session's recording, once it is over.
//
//   recording ─ lockFile ─► NAME.locked ─ unlockFile ─► the same bytes        key destroyed ─► nothing, for ever
//
// AES-256 in Galois counter mode, piece by piece, so that a file of any size needs no memory. Each piece is sealed with
// its place and with whether it is the last one: cut off, reordered, or changed by one bit, it is refused.
//
// Based on: NIST SP 800-38D (GCM); Hoang, Reyhanitabar, Rogaway, Vizar, CRYPTO 2015 (STREAM: sealing in pieces).

using TraineeKey = std::array<std::uint8_t, 32>;

/// From the system's own randomness. Throws Error.
TraineeKey newTraineeKey();

/// `key_ref` is stored in the file, to find the key by. The file appears whole or not at all, and replaces an older
/// one. Throws Error.
void lockFile(const std::filesystem::path& in, const std::filesystem::path& out, const TraineeKey& key,
              const std::string& key_ref);
/// Throws Error if `in` is not a locked file, was locked with another key, or was altered.
void unlockFile(const std::filesystem::path& in, const std::filesystem::path& out, const TraineeKey& key);

/// Name of its key; nothing if it is not a locked file.
std::optional<std::string> lockedWith(const std::filesystem::path& file);

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
