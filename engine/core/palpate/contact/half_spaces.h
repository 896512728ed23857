// The point of an intersection of half-spaces nearest to a target: the sphere finger's small optimisation problem.
#pragma once

#include <array>

#include "palpate/base/vec.h"

namespace palpate::contact {

/// All x with normal . x >= offset; normal is unit.
struct HalfSpace {
  Vec3 normal;
  double offset;
  double excess(const Vec3& x) const { return normal.dot(x) - offset; }
};

/// A set of bounded size: beyond kMax the newest is refused, which costs a round and not safety (the centre is always
/// tested before it moves).
class HalfSpaces {
 public:
  static constexpr int kMax = 48;
  void clear() { size_ = 0; }
  void add(const HalfSpace& plane) {
    if (size_ < kMax) planes_[size_++] = plane;
  }
  int size() const { return size_; }
  const HalfSpace& operator[](int i) const { return planes_[i]; }

 private:
  std::array<HalfSpace, kMax> planes_;
  int size_ = 0;
};

/// Finds the nearest point; planes count as kept when missed by less than `slack`. False when they exclude each other;
/// `nearest` is then left alone.
bool nearestInside(const HalfSpaces& planes, const Vec3& target, double slack, Vec3& nearest) noexcept;

}  // namespace palpate::contact
