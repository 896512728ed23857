#include "palpate/tree/exact_predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/random.h"

namespace palpate::tree {

namespace {

using Lattice = std::array<std::int64_t, 3>;

/// Sign of the determinant in 192-bit integers: the judge. Coordinates up to 2^53.
int judge(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  using Wide = __int128;
  std::int64_t u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
    w[i] = d[i] - a[i];
  }
  Wide high = 0, low = 0;  // the determinant is high 2^64 + low
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Wide minor = static_cast<Wide>(v[j]) * w[k] - static_cast<Wide>(v[k]) * w[j];
    high += (minor >> 64) * u[i];
    low += static_cast<Wide>(static_cast<std::uint64_t>(minor)) * u[i];
  }
  high += low >> 64;
  const auto rest = static_cast<std::uint64_t>(low);
  if (high != 0) return high > 0 ? 1 : -1;
  return rest == 0 ? 0 : 1;
}

Vec3 point(const Lattice& l, double unit) {
  return {static_cast<double>(l[0]) * unit, static_cast<double>(l[1]) * unit, static_cast<double>(l[2]) * unit};
}

Lattice randomLattice(Random& random, int bits) {
  Lattice l;
  for (auto& x : l) x = static_cast<std::int64_t>(random.below(1ull << (bits + 1))) - (1ll << bits);
  return l;
}

}  // namespace

TEST(Orient3d, FrontIsWhereTheCounterClockwiseNormalPoints) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orient3d(a, b, c, {0.2, 0.2, 1.0}), 1);
  EXPECT_EQ(orient3d(a, b, c, {0.2, 0.2, -1.0}), -1);
  EXPECT_EQ(orient3d(a, b, c, {7.0, -3.0, 0.0}), 0);
}

TEST(Orient3d, AgreesWithIntegersOnRandomAndOnNearlyCoplanarPoints) {
  Random random(1);
  int zeros = 0;
  for (int i = 0; i < 100000; ++i) {
    const int bits = 4 + static_cast<int>(random.below(48));
    const Lattice a = randomLattice(random, bits), b = randomLattice(random, bits), c = randomLattice(random, bits);
    // d in the plane of a, b, c (an integer combination), then off by at most one unit: as hard as it gets.
    Lattice d;
    for (int k = 0; k < 3; ++k) d[k] = (i % 2 == 0 ? a[k] + b[k] - c[k] : randomLattice(random, bits)[k]);
    d[random.below(3)] += static_cast<std::int64_t>(random.below(3)) - 1;
    const int expected = judge(a, b, c, d);
    zeros += expected == 0 ? 1 : 0;
    for (const double unit : {1.0, 0x1.0p-40, 0x1.0p+30}) {
      ASSERT_EQ(orient3d(point(a, unit), point(b, unit), point(c, unit), point(d, unit)), expected) << "trial " << i;
    }
  }
  EXPECT_GT(zeros, 10000);
}

TEST(Orient3d, NearlyCoplanarWithFullMantissasAndMixedMagnitudes) {
  // Differences that are not exact: a tiny and a large corner, so the long sum of 24 products must decide.
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Lattice a = randomLattice(random, 12), b = randomLattice(random, 52), c = randomLattice(random, 30);
    Lattice d;
    for (int k = 0; k < 3; ++k) d[k] = a[k] + (b[k] - a[k]) / 4096 + (c[k] - a[k]) / 4096;
    const int expected = judge(a, b, c, d);
    ASSERT_EQ(orient3d(point(a, 1), point(b, 1), point(c, 1), point(d, 1)), expected);
  }
}

TEST(Orient3d, InexactDifferencesAgainstAnExactlyKnownSign) {
  // a is 2^-60 off the plane z = 0 through b, c, d: every difference a - x in z loses it or not, the sign must not.
  const Vec3 b(1, 0, 0x1.0p+40), c(0, 1, 0x1.0p+40), d(-1, -1, 0x1.0p+40);
  const double tiny = 0x1.0p-60;
  EXPECT_EQ(orient3d({0, 0, 0x1.0p+40}, b, c, d), 0);
  // The lowest bit that 2^40 can carry next to it is 2^-12.
  EXPECT_EQ(orient3d(b, c, d, {0, 0, 0x1.0p+40 + 0x1.0p-12}), 1);
  EXPECT_EQ(orient3d({1, 0, tiny}, {0, 1, tiny}, {-1, -1, tiny}, {0, 0, 2 * tiny}), 1);
  EXPECT_EQ(orient3d({1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0x1.0p+30, 3.0, tiny}), 1);
  EXPECT_EQ(orient3d({1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0x1.0p+30, 3.0, -tiny}), -1);
}

TEST(Orient3d, SwappingTwoPointsFlipsTheSign) {
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    std::array<Vec3, 4> p;
    for (auto& v : p) v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    p[3] = p[0] + 0.25 * (p[1] - p[0]) + 0.5 * (p[2] - p[0]);  // on the plane, up to rounding
    const int sign = orient3d(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(orient3d(p[1], p[0], p[2], p[3]), -sign);
    EXPECT_EQ(orient3d(p[0], p[2], p[1], p[3]), -sign);
    EXPECT_EQ(orient3d(p[0], p[1], p[3], p[2]), -sign);
    EXPECT_EQ(orient3d(p[1], p[2], p[0], p[3]), sign);
  }
}

TEST(CrossesFrontToBack, OnlyInThatDirectionAndHalfOpen) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_TRUE(crossesFrontToBack(a, b, c, {1, 1, 1}, {1, 1, -1}));
  EXPECT_FALSE(crossesFrontToBack(a, b, c, {1, 1, -1}, {1, 1, 1}));
  EXPECT_FALSE(crossesFrontToBack(a, b, c, {1, 1, 1}, {1, 1, 0})) << "stopping on the plane is still outside";
  EXPECT_TRUE(crossesFrontToBack(a, b, c, {1, 1, 0}, {1, 1, -1})) << "the next move enters";
  EXPECT_FALSE(crossesFrontToBack(a, b, c, {3, 3, 1}, {3, 3, -1})) << "beside the triangle";
}

TEST(CrossesFrontToBack, EdgesAndCornersBelongToTheTriangle) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  for (const Vec3& aim : {a, b, c, Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 1, 0)}) {
    EXPECT_TRUE(crossesFrontToBack(a, b, c, aim + Vec3(0.3, 0.1, 1), aim - Vec3(0.3, 0.1, 1))) << aim.transpose();
  }
}

TEST(CrossesFrontToBack, NeverATriangleWithoutArea) {
  const Vec3 a(0, 0, 0), b(1, 1, 0), c(2, 2, 0);
  EXPECT_FALSE(crossesFrontToBack(a, b, c, {1, 1, 1}, {1, 1, -1}));
}

}  // namespace palpate::tree
