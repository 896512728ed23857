// A running 64-bit hash that names the result of a run, so that two runs can be compared by one number.
//
// Based on: Fowler, Noll, Vo, FNV-1a. Not for security.
#pragma once

#include <bit>
#include <cstdint>

#include "palpate/base/vec.h"

namespace palpate {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) addByte(static_cast<unsigned char>(word >> shift));
  }
  void addByte(unsigned char byte) {
    value_ ^= byte;
    value_ *= 0x100000001b3ull;
  }
  /// Hashes the bits: -0.0 and 0.0 differ on purpose, a hash must see every change.
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3& v) {
    add(v.x());
    add(v.y());
    add(v.z());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace palpate
