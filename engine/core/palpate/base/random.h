// Seeded random numbers that are the same on every platform and library (std distributions are not).
//
// Based on: Vigna, "splitmix64" (public domain, 2015).
#pragma once

#include <cmath>
#include <cstdint>

#include "palpate/base/elementary.h"
#include "palpate/base/vec.h"

namespace palpate {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1): 53 random bits, so every value is exact.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in [0, n), n > 0. The bias of the plain remainder is below n / 2^64.
  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  /// Normal with mean 0 and variance 1 (Box and Muller, one of the pair is dropped to stay stateless).
  double normal() {
    const double radius = std::sqrt(-2.0 * elementary::log(1.0 - uniform()));
    return radius * elementary::cos(6.283185307179586 * uniform());
  }

  // Vectors of draws, the last component drawn first. Not Vec3(normal(), normal(), normal()): in which order arguments
  // are made is the compiler's choice, and a seed would mean something else to each.
  Vec3 normal3() {
    return drawLastFirst<Vec3>([this] { return normal(); });
  }
  Vec2 normal2() {
    return drawLastFirst<Vec2>([this] { return normal(); });
  }
  Vec3 uniform3(double low = 0.0, double high = 1.0) {
    return drawLastFirst<Vec3>([&] { return uniform(low, high); });
  }
  Vec2 uniform2(double low = 0.0, double high = 1.0) {
    return drawLastFirst<Vec2>([&] { return uniform(low, high); });
  }

 private:
  template <class Vector, class Draw>
  static Vector drawLastFirst(const Draw& draw) {
    Vector vector;
    for (Eigen::Index i = vector.size(); i-- > 0;) vector[i] = draw();
    return vector;
  }

  std::uint64_t state_;
};

}  // namespace palpate
