// SHA-256, as text: of protocols, recordings, and of ids that must not be kept as they are.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace palpate::training {

std::array<std::uint8_t, 32> computeSha256(std::string_view bytes);
/// RFC 2104.
std::array<std::uint8_t, 32> computeHmacSha256(std::string_view key, std::string_view bytes);
/// 64 letters of lower case hex.
std::string sha256Hex(std::string_view bytes);
/// Hash of the file's contents, read piece by piece. Throws Error.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace palpate::training
