// HMAC-SHA256 (RFC 2104, FIPS 180-4) for a thread that must neither allocate nor lock: the servo's checks datagrams
// with it. OpenSSL's does both, and the engine does not link it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace palpate {

using Sha256Digest = std::array<std::uint8_t, 32>;

class HmacSha256 {
 public:
  explicit HmacSha256(std::string_view key) noexcept;
  /// Some 0.3 us for every 64 bytes of the message, and twice that.
  Sha256Digest of(std::string_view message) const noexcept;

 private:
  using State = std::array<std::uint32_t, 8>;
  State inner_, outer_;  // after their first blocks, which are the key's
};

/// 64 digits in small letters.
std::array<char, 64> hexOf(const Sha256Digest& digest) noexcept;

/// The time does not depend on where they differ.
bool equalInConstantTime(std::string_view a, std::string_view b) noexcept;

}  // namespace palpate
