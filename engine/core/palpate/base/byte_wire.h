// Numbers as bytes, little endian, and back: the format of engine/contact_stream.h and scene/ready_body.h.
//
// A structure is walked by one template, `walk(wire, value)`, for both ways: the writer gets constants, the reader
// fills in. The reader never goes past the end, accepts only finite numbers within limits and known words, and after
// the first fault returns zeros and remembers its place, so that a walk needs no branches.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "palpate/base/vec.h"

namespace palpate {

/// No place, length, force or coefficient is larger; mm, N. Places in map coordinates reach 2e10 mm.
inline constexpr double kMaxWire = 1e11;

namespace wire {

template <class Real>
using BitsOf = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;

template <class Whole>
void put(Whole value, char* at) {
  for (std::size_t i = 0; i < sizeof(Whole); ++i)
    at[i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
}

template <class Whole>
Whole get(const char* at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Whole); ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(at[i])) << (8 * i);
  }
  return static_cast<Whole>(value);
}

template <class Real>
BitsOf<Real> bitsOf(Real value) {
  BitsOf<Real> bits = 0;
  std::memcpy(&bits, &value, sizeof(value));
  return bits;
}

template <class Real>
Real realOf(BitsOf<Real> bits) {
  Real value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

}  // namespace wire

/// Appends to `bytes`, which must outlive it.
class WireWriter {
 public:
  static constexpr bool kReads = false;
  explicit WireWriter(std::string& bytes) : bytes_(bytes) {}

  template <class Whole>
  void whole(Whole value) {
    std::array<char, sizeof(Whole)> raw{};
    wire::put(value, raw.data());
    bytes_.append(raw.data(), raw.size());
  }
  void text(std::string_view words) { bytes_ += words; }
  void bytes(std::string_view raw) { bytes_ += raw; }
  template <class Real>
  void real(const Real& value) {
    whole(wire::bitsOf(value));
  }
  void place(const Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) real(value[axis]);
  }
  /// As floats, for display only.
  void shown(double value) { real(static_cast<float>(value)); }
  void shown(const Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) shown(value[axis]);
  }
  template <class Word>
  void word(const Word& value, Word /*last*/) {
    whole(static_cast<std::uint8_t>(value));
  }
  template <class Count>
  void count(const Count& value, Count /*least*/, Count /*most*/) {
    whole(static_cast<std::uint32_t>(value));
  }

 private:
  std::string& bytes_;
};

/// Reads `bytes`, which must outlive it.
class WireReader {
 public:
  static constexpr bool kReads = true;
  explicit WireReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Whole>
  Whole whole() {
    if (!has(sizeof(Whole))) return 0;
    position_ += sizeof(Whole);
    return wire::get<Whole>(bytes_.data() + position_ - sizeof(Whole));
  }
  /// This text and no other.
  void text(std::string_view words) {
    if (!has(words.size())) return;
    if (bytes_.substr(position_, words.size()) != words) return fail("is something else, or of another version");
    position_ += words.size();
  }
  /// The next bytes, unchanged; empty after a fault.
  std::string_view bytes(std::size_t size) {
    if (!has(size)) return {};
    position_ += size;
    return bytes_.substr(position_ - size, size);
  }
  template <class Real>
  void real(Real& value) {
    value = wire::realOf<Real>(whole<wire::BitsOf<Real>>());
    if (std::abs(value) <= static_cast<Real>(kMaxWire)) return;
    fail("a number that is not finite, or too large");
    value = 0;
  }
  void place(Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) real(value[axis]);
  }
  void shown(double& value) {
    float number = 0.0f;
    real(number);
    value = static_cast<double>(number);
  }
  void shown(Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) shown(value[axis]);
  }
  /// Refuses an enumeration or a bool beyond `last`.
  template <class Word>
  void word(Word& value, Word last) {
    const auto read = whole<std::uint8_t>();
    if (read > static_cast<std::uint8_t>(last)) return fail("an unknown word");
    value = static_cast<Word>(read);
  }
  template <class Count>
  void count(Count& value, Count least, Count most) {
    const auto read = whole<std::uint32_t>();
    if (read < least || read > most) fail("a number out of range");
    value = ok() ? static_cast<Count>(read) : least;
  }
  /// True if `size` bytes are left; otherwise the reader fails with "ends too early".
  bool has(std::uint64_t size) {
    if (ok() && size > bytes_.size() - position_) fail("ends too early");
    return ok();
  }
  /// There must be nothing left.
  void end() {
    if (ok() && position_ != bytes_.size()) fail("goes on after its end");
  }
  void fail(const char* cause) {
    if (cause_ == nullptr) cause_ = cause;
  }

  bool ok() const { return cause_ == nullptr; }
  /// Cause of the first fault, or null.
  const char* cause() const { return cause_; }
  std::size_t position() const { return position_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  const char* cause_ = nullptr;
};

}  // namespace palpate
