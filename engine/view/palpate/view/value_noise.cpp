// Values hashed from the corners of the lattice, joined by cubics of zero slope at the corners.
#include "palpate/view/made_skin.h"

#include <array>
#include <cstdint>

#include "palpate/base/random.h"

namespace palpate::view {

namespace {

double latticeValue(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ull +
                     static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4full +
                     static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ull;
  return Random(mixed).uniform(-1.0, 1.0);
}

}  // namespace

double noiseAt(const Vec3& p) {
  const Vec3 cell = p.array().floor();
  const Vec3 t = p - cell;
  const Vec3 s = t.array().square() * (3.0 - 2.0 * t.array());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<std::int64_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      const int high = (corner >> axis) & 1;
      weight *= high == 1 ? s[axis] : 1.0 - s[axis];
      at[axis] = static_cast<std::int64_t>(cell[axis]) + high;
    }
    sum += weight * latticeValue(at[0], at[1], at[2]);
  }
  return sum;
}

}  // namespace palpate::view
