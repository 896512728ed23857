// A file that only its trainee's key opens: a session's recording, once it is over.
//
//   recording ─ lockFile ─► NAME.locked ─ unlockFile ─► the same bytes        key destroyed ─► nothing, for ever
//
// AES-256 in Galois counter mode, piece by piece, so that a file of any size needs no memory. Each piece is sealed with
// its place and with whether it is the last one: cut off, reordered, or changed by one bit, it is refused.
//
// Based on: NIST SP 800-38D (GCM); Hoang, Reyhanitabar, Rogaway, Vizar, CRYPTO 2015 (STREAM: sealing in pieces).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace palpate::training {

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

}  // namespace palpate::training
