#include "palpate/contact/half_spaces.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "palpate/base/random.h"

namespace palpate::contact {

namespace {

constexpr double kSlack = 1e-9;

bool inside(const HalfSpaces& planes, const Vec3& x, double slack) {
  for (int i = 0; i < planes.size(); ++i) {
    if (planes[i].normal.dot(x) < planes[i].offset - slack) return false;
  }
  return true;
}

/// Every set of up to three planes met exactly, the best that keeps all of them: the judge.
double bruteDistance(const HalfSpaces& planes, const Vec3& target) {
  double best = inside(planes, target, 1e-12) ? 0.0 : std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::vector<int>& set) {
    const auto n = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd normals(n, 3);
    Eigen::VectorXd miss(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const HalfSpace& plane = planes[set[static_cast<std::size_t>(i)]];
      normals.row(i) = plane.normal.transpose();
      miss[i] = plane.offset - plane.normal.dot(target);
    }
    const Eigen::VectorXd multipliers = (normals * normals.transpose()).fullPivLu().solve(miss);
    const Vec3 x = target + normals.transpose() * multipliers;
    if (inside(planes, x, 1e-7)) best = std::min(best, (x - target).norm());
  };
  for (int i = 0; i < planes.size(); ++i) {
    consider({i});
    for (int j = 0; j < i; ++j) {
      consider({i, j});
      for (int k = 0; k < j; ++k) consider({i, j, k});
    }
  }
  return best;
}

}  // namespace

TEST(HalfSpaces, AnInnerPointIsItsOwnNearest) {
  HalfSpaces planes;
  planes.add({Vec3::UnitZ(), 1.0});
  Vec3 nearest;
  ASSERT_TRUE(nearestInside(planes, {3, 4, 5}, kSlack, nearest));
  EXPECT_EQ(nearest, Vec3(3, 4, 5));
}

TEST(HalfSpaces, ACornerOfThreePlanes) {
  HalfSpaces planes;
  planes.add({Vec3::UnitX(), 1.0});
  planes.add({Vec3::UnitY(), 2.0});
  planes.add({Vec3::UnitZ(), 3.0});
  Vec3 nearest;
  ASSERT_TRUE(nearestInside(planes, {0, 0, 0}, kSlack, nearest));
  EXPECT_NEAR((nearest - Vec3(1, 2, 3)).norm(), 0, 1e-12);
}

TEST(HalfSpaces, SaysWhenPlanesExcludeEachOther) {
  HalfSpaces planes;
  planes.add({Vec3::UnitX(), 1.0});
  planes.add({-Vec3::UnitX(), 1.0});
  planes.add({Vec3::UnitY(), 0.0});
  Vec3 nearest(7, 7, 7);
  EXPECT_FALSE(nearestInside(planes, {0, -1, 0}, kSlack, nearest));
  EXPECT_EQ(nearest, Vec3(7, 7, 7));
}

TEST(HalfSpaces, AgreesWithTryingAllCorners) {
  Random random(21);
  for (int trial = 0; trial < 2000; ++trial) {
    HalfSpaces planes;
    const int count = 1 + static_cast<int>(random.below(9));
    for (int i = 0; i < count; ++i) {
      const Vec3 normal = Vec3(random.normal(), random.normal(), 1.0 + random.normal()).normalized();
      planes.add({normal, random.uniform(-1, 1)});
    }
    const Vec3 target(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-4, 0));
    const double expected = bruteDistance(planes, target);
    Vec3 nearest;
    if (!nearestInside(planes, target, kSlack, nearest)) {
      EXPECT_TRUE(std::isinf(expected)) << "trial " << trial;
      continue;
    }
    EXPECT_TRUE(inside(planes, nearest, 1e-6)) << "trial " << trial;
    EXPECT_NEAR((nearest - target).norm(), expected, 1e-6) << "trial " << trial;
  }
}

TEST(HalfSpaces, ManyNearlyParallelPlanesAreHarmless) {
  Random random(22);
  HalfSpaces planes;
  for (int i = 0; i < 40; ++i) {
    planes.add({Vec3(1e-6 * random.normal(), 1e-6 * random.normal(), 1.0).normalized(), 1e-7 * random.normal()});
  }
  Vec3 nearest;
  ASSERT_TRUE(nearestInside(planes, {0.3, -0.2, -10}, kSlack, nearest));
  EXPECT_NEAR((nearest - Vec3(0.3, -0.2, 0)).norm(), 0, 1e-4);
}

}  // namespace palpate::contact
