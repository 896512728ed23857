#include <bit>
#include <cstring>

#include "palpate/base/web_socket.h"

namespace palpate {

namespace {

constexpr std::size_t kSha1Block = 64;
using Sha1State = std::array<std::uint32_t, 5>;
using Sha1Block = std::array<std::uint8_t, kSha1Block>;

void absorb(Sha1State& state, const Sha1Block& block) noexcept {
  std::array<std::uint32_t, 80> w;
  for (std::size_t i = 0; i < 16; ++i) {
    const std::uint8_t* b = block.data() + 4 * i;
    w[i] = std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | std::uint32_t{b[3]};
  }
  for (std::size_t i = 16; i < w.size(); ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = state;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const std::uint32_t mixed = i < 20   ? ((b & c) | (~b & d)) + 0x5a827999u
                                : i < 40 ? (b ^ c ^ d) + 0x6ed9eba1u
                                : i < 60 ? ((b & c) | (b & d) | (c & d)) + 0x8f1bbcdcu
                                         : (b ^ c ^ d) + 0xca62c1d6u;
    const std::uint32_t next = std::rotl(a, 5) + mixed + e + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  const Sha1State change = {a, b, c, d, e};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += change[i];
}

}  // namespace

Sha1Digest sha1(std::string_view message) noexcept {
  Sha1State state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  const std::uint64_t bits = std::uint64_t{8} * message.size();
  Sha1Block block{};
  for (; message.size() >= kSha1Block; message.remove_prefix(kSha1Block)) {
    std::memcpy(block.data(), message.data(), kSha1Block);
    absorb(state, block);
  }
  block.fill(0);
  if (!message.empty()) std::memcpy(block.data(), message.data(), message.size());
  block[message.size()] = 0x80;
  constexpr std::size_t kLengthAt = kSha1Block - 8;
  if (message.size() >= kLengthAt) {
    absorb(state, block);
    block.fill(0);
  }
  for (std::size_t i = 0; i < 8; ++i) block[kLengthAt + i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
  absorb(state, block);
  Sha1Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    digest[i] = static_cast<std::uint8_t>(state[i / 4] >> (24 - 8 * (i % 4)));
  }
  return digest;
}

}  // namespace palpate
