// Codes for people to type, pseudonyms for machines to keep.
//
// The check letter is a sum over GF(32), each place with a weight of its own (powers of a generator): any one letter
// typed wrong and any two letters swapped are noticed, which a plain sum would not do.
//
// Based on: D. Crockford's base 32 (no I, L, O, U); RFC 9562 (UUID versions 7 and 8).
#include "palpate/training/records/trainee_code.h"

#include <algorithm>
#include <chrono>

#include "palpate/base/error.h"
#include "palpate/base/system/process.h"
#include "palpate/training/sha256.h"

namespace palpate::training {

namespace {

constexpr std::string_view kCodeAlphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
constexpr int kCodeLetters = 9;  // without the check letter
constexpr int kDashAfter = 5;

using CodeSymbols = std::array<unsigned, kCodeLetters>;

/// Times x in GF(32) with x^5 = x^2 + 1.
unsigned timesX(unsigned value) {
  value <<= 1;
  return (value & 32u) != 0 ? (value ^ 0b100101u) : value;
}

unsigned checkSymbol(const CodeSymbols& symbols) {
  // Horner: the sum of symbol i times x^(9 - i); the check symbol itself has weight 1.
  unsigned sum = 0;
  for (const unsigned symbol : symbols) sum = timesX(sum ^ symbol);
  return sum;
}

/// -1: no letter of a code.
int symbolOf(char typed) {
  if (typed >= 'a' && typed <= 'z') typed = static_cast<char>(typed - 'a' + 'A');
  if (typed == 'O') typed = '0';
  if (typed == 'I' || typed == 'L') typed = '1';
  const std::size_t place = kCodeAlphabet.find(typed);
  return place == std::string_view::npos ? -1 : static_cast<int>(place);
}

std::string writtenCode(const CodeSymbols& symbols) {
  std::string text;
  for (const unsigned symbol : symbols) {
    if (text.size() == kDashAfter) text += '-';
    text += kCodeAlphabet[symbol];
  }
  return text + kCodeAlphabet[checkSymbol(symbols)];
}

Uuid uuidText(std::array<std::uint8_t, 16> bytes, unsigned version) {
  bytes[6] = static_cast<std::uint8_t>((version << 4) | (bytes[6] & 0x0fu));
  bytes[8] = static_cast<std::uint8_t>(0x80u | (bytes[8] & 0x3fu));
  constexpr std::string_view kDigits = "0123456789abcdef";
  Uuid text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

Uuid uuidOfDigest(const std::array<std::uint8_t, 32>& digest) {
  std::array<std::uint8_t, 16> bytes{};
  std::copy_n(digest.begin(), bytes.size(), bytes.begin());
  return uuidText(bytes, 8);
}

}  // namespace

std::string makeTraineeCode(std::uint64_t random_bits) {
  CodeSymbols symbols{};
  for (unsigned& symbol : symbols) {
    symbol = static_cast<unsigned>(random_bits & 31u);
    random_bits >>= 5;
  }
  return writtenCode(symbols);
}

std::optional<std::string> codeTyped(std::string_view typed) {
  std::array<unsigned, kCodeLetters + 1> symbols{};
  std::size_t count = 0;
  for (const char letter : typed) {
    if (letter == ' ' || letter == '-' || letter == '\t') continue;
    const int symbol = symbolOf(letter);
    if (symbol < 0 || count == symbols.size()) return std::nullopt;
    symbols[count++] = static_cast<unsigned>(symbol);
  }
  if (count != symbols.size()) return std::nullopt;
  CodeSymbols code{};
  std::copy_n(symbols.begin(), code.size(), code.begin());
  if (checkSymbol(code) != symbols.back()) return std::nullopt;
  return writtenCode(code);
}

Uuid derivePseudonym(std::string_view class_id, std::string_view code, std::string_view key) {
  // Spelt as on the card, however it was typed.
  const std::string written = codeTyped(code).value_or(std::string(code));
  const std::string text = "palpate trainee\n" + std::string(class_id) + '\n' + written;
  return uuidOfDigest(key.empty() ? computeSha256(text) : computeHmacSha256(key, text));
}

Uuid uuidOfText(std::string_view text) { return uuidOfDigest(computeSha256(text)); }

Uuid makeUuidV7(std::int64_t unix_ms, const std::array<std::uint64_t, 2>& random) {
  std::array<std::uint8_t, 16> bytes{};
  const auto time = static_cast<std::uint64_t>(unix_ms);
  for (std::size_t i = 0; i < 6; ++i) bytes[i] = static_cast<std::uint8_t>(time >> (40 - 8 * i));
  for (std::size_t i = 0; i < 2; ++i) bytes[6 + i] = static_cast<std::uint8_t>(random[0] >> (8 * i));
  for (std::size_t i = 0; i < 8; ++i) bytes[8 + i] = static_cast<std::uint8_t>(random[1] >> (8 * i));
  return uuidText(bytes, 7);
}

std::array<std::uint64_t, 2> systemRandom() {
  std::array<std::uint64_t, 2> bits{};
  if (!system::fillWithRandom({reinterpret_cast<unsigned char*>(bits.data()), sizeof bits}))
    throw Error("the system provides no random numbers");
  return bits;
}

std::int64_t utcMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace palpate::training
