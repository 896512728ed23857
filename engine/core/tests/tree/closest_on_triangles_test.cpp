// Several triangles side by side against one by one: the same bits, in every region of every kind of triangle.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

namespace {

Vec3 somewhere(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// Even ones, slivers to nothing in the end, points, and corners on a lattice, whose sums are often exactly 0.
TriangleRecord anyTriangle(Random& random) {
  const double size = std::pow(10.0, random.uniform(-4.0, 3.0));
  TriangleRecord record{};
  for (Vec3& corner : record.corners) corner = somewhere(random, size);
  auto& [a, b, c] = record.corners;
  switch (random.below(5)) {
    case 0:
      c = a + random.uniform() * (b - a) + std::pow(10.0, random.uniform(-20.0, 0.0)) * (c - a);
      break;
    case 1:
      b = c = a;
      break;
    case 2:
      for (Vec3& corner : record.corners) corner = (corner * (3.0 / size)).array().round();
      break;
    default:
      break;
  }
  return record;
}

/// On an edge or a corner, beside it by a rounding, or anywhere.
double anyShare(Random& random) {
  constexpr std::array<double, 6> kSpecial{0.0, 1.0, 1e-13, 1e-11, 1.0 - 1e-13, 1.0 - 1e-11};
  return random.below(2) == 0 ? kSpecial[random.below(kSpecial.size())] : random.uniform(-1.0, 2.0);
}

/// Over the face, an edge or a corner, to rounding or not, or anywhere.
Vec3 placeNear(const TriangleRecord& record, Random& random) {
  const auto& [a, b, c] = record.corners;
  const double size = (b - a).norm() + (c - a).norm();
  const double u = anyShare(random);
  const double v = anyShare(random);
  const Vec3 beside = random.below(2) == 0 ? Vec3::Zero() : somewhere(random, size);
  const Vec3 place = a + u * (b - a) + v * (c - a) + beside;
  return random.below(4) == 0 ? Vec3(place.array().round()) : place;
}

std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }

bool sameBits(const ClosestOnTriangle& one, const ClosestOnTriangle& other) {
  for (int axis = 0; axis < 3; ++axis) {
    if (bitsOf(one.point[axis]) != bitsOf(other.point[axis])) return false;
  }
  return one.feature == other.feature && bitsOf(one.squared_distance) == bitsOf(other.squared_distance);
}

}  // namespace

TEST(ClosestOnTriangles, SideBySideAreTheBitsOfOneByOne) {
  Random random(20261129);
  std::array<std::size_t, 7> seen{};
  for (int round = 0; round < 40000; ++round) {
    std::vector<TriangleRecord> records(20);
    for (TriangleRecord& record : records) record = anyTriangle(random);
    const int count = 1 + static_cast<int>(random.below(kMaxSideBySide));
    std::array<Index, kMaxSideBySide> which{};
    for (int i = 0; i < count; ++i) which[i] = static_cast<Index>(random.below(records.size()));
    const Vec3 place = placeNear(records[which[0]], random);
    ClosestSideBySide together;
    closestOnTriangles(records.data(), which.data(), count, place, together);
    for (int i = 0; i < count; ++i) {
      const ClosestOnTriangle alone = closestOnTriangle(records[which[i]].corners, place);
      ASSERT_TRUE(sameBits(together[i], alone)) << "round " << round << ", triangle " << i;
      ++seen[static_cast<std::size_t>(alone.feature)];
    }
  }
  for (const std::size_t times : seen) EXPECT_GT(times, 1000u) << "every region was met";
}

TEST(ClosestOnTriangles, APlaceThatIsNoNumberIsAnsweredAsOneByOne) {
  Random random(7);
  const std::vector<TriangleRecord> records(1, anyTriangle(random));
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Index which = 0;
  ClosestSideBySide together;
  closestOnTriangles(records.data(), &which, 1, Vec3(kNaN, 0, 0), together);
  EXPECT_TRUE(std::isnan(together[0].squared_distance));
  EXPECT_EQ(together[0].feature, closestOnTriangle(records[0].corners, Vec3(kNaN, 0, 0)).feature);
}

}  // namespace palpate::tree
