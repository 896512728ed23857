// Based on: FIPS 180-4, Secure Hash Standard (2015), sections 4.1.2, 5.1.1 and 6.2.
#include "support/sha256.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace palpate::test {
namespace {

using State = std::array<std::uint32_t, 8>;
using RoundConstants = std::array<std::uint32_t, 64>;

/// The first 32 bits of the fractional part of a root. Long double has the 64 bits that the cube root of 311 needs.
std::uint32_t fractionBits(long double root) {
  return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

/// FIPS 180-4 defines its constants as roots of the first primes; so do we.
std::array<int, 64> firstPrimes() {
  std::array<int, 64> primes{};
  int found = 0;
  for (int n = 2; found < 64; ++n) {
    bool prime = true;
    for (int i = 0; i < found; ++i) prime = prime && n % primes[i] != 0;
    if (prime) primes[found++] = n;
  }
  return primes;
}

RoundConstants roundConstants() {
  RoundConstants k{};
  const std::array<int, 64> primes = firstPrimes();
  for (int i = 0; i < 64; ++i) k[i] = fractionBits(std::cbrt(static_cast<long double>(primes[i])));
  return k;
}

State initialState() {
  State h{};
  const std::array<int, 64> primes = firstPrimes();
  for (int i = 0; i < 8; ++i) h[i] = fractionBits(std::sqrt(static_cast<long double>(primes[i])));
  return h;
}

std::array<std::uint32_t, 64> schedule(const char* block) {
  std::array<std::uint32_t, 64> w{};
  for (int i = 0; i < 64; ++i) w[i / 4] = w[i / 4] << 8 | static_cast<unsigned char>(block[i]);
  for (int i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3;
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10;
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  return w;
}

void addBlock(const char* block, const RoundConstants& k, State& state) {
  const std::array<std::uint32_t, 64> w = schedule(block);
  auto [a, b, c, d, e, f, g, h] = state;
  for (int i = 0; i < 64; ++i) {
    const std::uint32_t sum1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + sum1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
    const std::uint32_t sum0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = sum0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const State added{a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; ++i) state[i] += added[i];
}

/// The last bytes, a 1 bit, zeros and the length in bits: one or two blocks.
std::string padded(std::string_view tail, std::uint64_t total_bytes) {
  std::string end(tail);
  end += '\x80';
  while (end.size() % 64 != 56) end += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) end += static_cast<char>(total_bytes * 8 >> shift & 0xff);
  return end;
}

}  // namespace

std::string sha256(std::string_view bytes) {
  static const RoundConstants rounds = roundConstants();
  State state = initialState();
  const std::size_t whole = bytes.size() / 64 * 64;
  for (std::size_t i = 0; i < whole; i += 64) addBlock(bytes.data() + i, rounds, state);
  const std::string end = padded(bytes.substr(whole), bytes.size());
  for (std::size_t i = 0; i < end.size(); i += 64) addBlock(end.data() + i, rounds, state);
  std::string digits;
  for (const std::uint32_t word : state) digits += fmt::format("{:08x}", word);
  return digits;
}

}  // namespace palpate::test
