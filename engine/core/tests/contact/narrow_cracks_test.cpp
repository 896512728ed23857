// Cracks that no finger can enter: a point slides over them as if there were none.
#include "palpate/contact/narrow_cracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {
namespace {

using Rim = std::function<double(int)>;  // x by row

constexpr int kRows = 40;
constexpr double kWidth = 110.0, kDepth = 12.0;

/// A closed block from one rim to another, its top at z = 0.
mesh::TriangleMesh block(const Rim& left, const Rim& right, double depth = kDepth) {
  mesh::TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    const double y = kWidth * row / kRows;
    for (const Vec3& p :
         {Vec3(left(row), y, 0), Vec3(right(row), y, 0), Vec3(right(row), y, -depth), Vec3(left(row), y, -depth)}) {
      mesh.positions.push_back(p);
    }
  }
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (Index at = 0; at < 4 * kRows; at += 4) {
    for (Index side = 0; side < 4; ++side) quad(at + side, at + (side + 1) % 4, at + 4 + (side + 1) % 4, at + 4 + side);
  }
  quad(3, 2, 1, 0);
  quad(4 * kRows, 4 * kRows + 1, 4 * kRows + 2, 4 * kRows + 3);
  return mesh;
}

Rim straight(double x) {
  return [x](int) { return x; };
}

Rim jagged(double x, double height = 1.5) {
  return [=](int row) { return x + (row % 2 == 0 ? -height : height); };
}

/// One body with a groove down to 2/3 of its depth.
mesh::TriangleMesh foldedBody(double gap) {
  const double x = 0.5 * kWidth;
  const Vec2 profile[] = {{0, -kDepth},          {kWidth, -kDepth},     {kWidth, 0},        {x + 0.5 * gap, 0},
                          {x + 0.5 * gap, -8.0}, {x - 0.5 * gap, -8.0}, {x - 0.5 * gap, 0}, {0, 0}};
  mesh::TriangleMesh mesh;
  for (const double y : {0.0, kWidth}) {
    for (const Vec2& p : profile) mesh.positions.emplace_back(p.x(), y, p.y());
  }
  for (Index i = 0; i < 8; ++i) {
    const Index next = (i + 1) % 8;
    mesh.triangles.push_back({i, i + 8, next});
    mesh.triangles.push_back({next, i + 8, next + 8});
  }
  for (const Triangle& t : {Triangle{0, 1, 4}, Triangle{0, 4, 5}, Triangle{1, 2, 4}, Triangle{2, 3, 4},
                            Triangle{0, 5, 7}, Triangle{5, 6, 7}}) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[2] + 8, t[1] + 8, t[0] + 8});
  }
  return mesh;
}

/// A sheet with a furrow of 40 degrees, its triangles nearly as small as a crack is wide; and a larger sheet below.
mesh::TriangleMesh furrow() {
  constexpr double kCell = 0.4, kHalfAngle = 20.0 * kRadPerDeg;
  constexpr Index kAcross = 40, kAlong = 25;
  mesh::TriangleMesh mesh;
  for (Index j = 0; j <= kAlong; ++j) {
    for (Index i = 0; i <= kAcross; ++i) {
      const double up = kCell * (static_cast<double>(i) - 0.5 * kAcross);
      mesh.positions.emplace_back(std::sin(kHalfAngle) * up, kCell * j, std::cos(kHalfAngle) * std::abs(up));
    }
  }
  for (Index j = 0; j < kAlong; ++j) {
    for (Index i = 0; i < kAcross; ++i) {
      const Index a = j * (kAcross + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + kAcross + 2});
      mesh.triangles.push_back({a, a + kAcross + 2, a + kAcross + 1});
    }
  }
  mesh::TriangleMesh below = zoo::grid(10, 100.0);
  for (Vec3& p : below.positions) p.z() = -30.0;
  return zoo::joined(mesh, below);
}

/// A sheet of 80 x 100 mm with a notch along its middle: 10 mm deep, of 8 degrees, a crack in its lowest third.
mesh::TriangleMesh notchedSheet() {
  constexpr Index kAcross = 9, kAlong = 10;
  const double slope = std::tan(4.0 * kRadPerDeg);
  mesh::TriangleMesh mesh;
  for (Index j = 0; j <= kAlong; ++j) {
    mesh.positions.emplace_back(-40.0, 10.0 * j, 0.0);
    for (const double up : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0})
      mesh.positions.emplace_back(slope * up / 0.3, 10.0 * j, std::abs(up) / 0.3 - 10.0);
    mesh.positions.emplace_back(40.0, 10.0 * j, 0.0);
  }
  for (Index j = 0; j < kAlong; ++j) {
    for (Index i = 0; i + 1 < kAcross; ++i) {
      const Index a = j * kAcross + i;
      mesh.triangles.push_back({a, a + 1, a + kAcross + 1});
      mesh.triangles.push_back({a, a + kAcross + 1, a + kAcross});
    }
  }
  return mesh;
}

/// Two sheets that face and pierce each other at 4 degrees.
mesh::TriangleMesh piercingSheets() {
  mesh::TriangleMesh upper = zoo::grid(100), lower = upper;
  for (Vec3& p : upper.positions) p.z() = std::tan(4.0 * kRadPerDeg) * (p.x() - 50.3);
  for (Triangle& t : upper.triangles) std::swap(t[1], t[2]);
  return zoo::joined(lower, upper);
}

struct Extremes {
  double least_normal = std::numeric_limits<double>::infinity();
  double most_normal = 0.0, most_sideways = 0.0;
  void add(const FingerOutput& output) {
    least_normal = std::min(least_normal, output.force.z());
    most_normal = std::max(most_normal, output.force.z());
    most_sideways = std::max(most_sideways, output.force.head<2>().norm());
  }
};

/// 5 mm deep over the crack at x = 55 and back, beside the rims' corners.
Extremes slideOver(const Surface& surface, double y = 52.3, double step = 0.1) {
  FingerTrack finger(surface);
  finger.to({45, y, 1});
  finger.slide({45, y, -5}, 0.1);
  Extremes extremes;
  for (const double end : {65.0, 45.0}) {
    const Vec3 from = finger.state().tip;
    for (double s = step; s <= 20.0; s += step) extremes.add(finger.to(from + Vec3(end > 50 ? s : -s, 0, 0)));
  }
  return extremes;
}

/// 2.5 N, and sideways no more than friction and half of a crack 0.2 mm wide make.
void expectNoCrack(const Surface& surface, double y = 52.3) {
  for (const double step : {0.1, 0.01}) {
    const Extremes felt = slideOver(surface, y, step);
    EXPECT_GT(felt.least_normal, 2.45) << step;
    EXPECT_LT(felt.most_normal, 2.55) << step;
    EXPECT_LT(felt.most_sideways, 0.46 * 2.5 + 0.05) << step;
  }
}

TEST(NarrowCracks, AJaggedOneBetweenPartsIsNoNeedleForAPoint) {
  for (const double gap : {0.03, 0.04, 0.1, 0.19}) {
    SCOPED_TRACE(gap);
    expectNoCrack(surfaceOf(zoo::joined(block(straight(0), jagged(55)), block(jagged(55 + gap), straight(kWidth)))));
  }
}

TEST(NarrowCracks, OneThatIsJaggedOtherwiseOnEachSideIsNoNeedleForAPoint) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    std::vector<double> low(kRows + 1), high(kRows + 1);
    for (int row = 0; row <= kRows; ++row) {
      low[row] = random.uniform(53.0, 57.0);
      high[row] = low[row] + random.uniform(0.03, 0.2);
    }
    const Surface surface = surfaceOf(zoo::joined(block(straight(0), [&](int row) { return low[row]; }),
                                                  block([&](int row) { return high[row]; }, straight(kWidth))));
    for (const double y : {31.4, 52.3, 66.0, 81.7}) {
      SCOPED_TRACE(y);
      expectNoCrack(surface, y);
    }
  }
}

TEST(NarrowCracks, BanksThatAreCutIntoOtherTrianglesAreOneSkin) {
  const auto shifted = zoo::joined(block(straight(0), straight(55)), [] {
    mesh::TriangleMesh other = block(straight(55.1), straight(kWidth));
    for (Vec3& p : other.positions) p.y() = 1.37 * (p.y() - 10.0);  // longer than the first: its wall is free in part
    return other;
  }());
  for (const double y : {52.3, 0.5, 1.0}) expectNoCrack(surfaceOf(shifted), y);  // also where it ends
}

TEST(NarrowCracks, AFoldOfOneBodyIsNoNeedleForAPoint) {
  for (const double gap : {0.05, 0.2}) {
    SCOPED_TRACE(gap);
    expectNoCrack(surfaceOf(foldedBody(gap)));
  }
}

TEST(NarrowCracks, OfTwoOpenSheetsAreSlidOver) {
  mesh::TriangleMesh left = zoo::grid(10), right = zoo::grid(13);
  for (Vec3& p : left.positions) p.x() *= 0.55;
  for (Vec3& p : right.positions) p.x() = 55.06 + 0.5 * p.x();
  expectNoCrack(surfaceOf(zoo::joined(left, right)));
}

TEST(NarrowCracks, APointThatComesDownIntoOneIsHeldByItsRim) {
  const Surface surface = surfaceOf(foldedBody(0.1));
  FingerTrack finger(surface);
  finger.to({55.01, 52.3, 2});
  FingerOutput output = finger.slide({55.01, 52.3, -5}, 0.03);
  EXPECT_NEAR(output.force.z(), 2.5, 0.01);
  output = finger.slide({62, 52.3, -5}, 0.03);
  EXPECT_NEAR(output.force.z(), 2.5, 0.01);
  EXPECT_FALSE(touches(finger.slide({55.01, 52.3, 1}, 0.03)));
}

TEST(NarrowCracks, AtTheMouthOfOneInANotchFrictionDoesNotLeadIntoTheWall) {
  const Surface surface = surfaceOf(notchedSheet());
  for (const double y : {53.0, 57.0}) {
    FingerTrack finger(surface);
    finger.to({-2.5, y, 1});
    finger.slide({-2.5, y, -1}, 0.5);
    for (int tick = 0; tick < 3; ++tick) {  // from the bank to beside the wall at once
      const FingerOutput output = finger.to({-0.4, y, -9.5});
      ASSERT_LT(output.proxy.z(), -5.0) << "on the wall";
      const Vec3 wall = faceNormal(surface.geometry->tree.records[finger.state().proxy.triangle]);
      EXPECT_GT(output.force.norm(), 0.5);
      EXPECT_GT(output.force.dot(wall), -1e-9) << "y = " << y << ", tick " << tick;
    }
  }
}

TEST(NarrowCracks, WiderOnesAreEntered) {
  EXPECT_TRUE(surfaceOf(foldedBody(0.4)).geometry->cracked.empty());
  EXPECT_FALSE(surfaceOf(foldedBody(0.2)).geometry->cracked.empty());
}

TEST(NarrowCracks, BodiesWithoutHaveNone) {
  for (const mesh::TriangleMesh& mesh :
       {zoo::sphere(), zoo::cube(), zoo::plate(), zoo::torus(), zoo::hollowSphere(), zoo::cubesSharingAnEdge(),
        zoo::wavyGrid(), zoo::openTube(), furrow(), piercingSheets()}) {
    EXPECT_TRUE(surfaceOf(mesh).geometry->cracked.empty());
  }
}

TEST(NarrowCracks, AreCountedAndPlaced) {
  const mesh::TriangleMesh two =
      zoo::joined(zoo::joined(block(straight(0), straight(30)), block(straight(30.1), straight(60))),
                  block(straight(60.1), straight(kWidth)));
  const NarrowCracks cracks = countCracks(*surfaceOf(two).geometry);
  EXPECT_EQ(cracks.count, 2u);
  EXPECT_NEAR(std::min(std::abs(cracks.at.x() - 30.05), std::abs(cracks.at.x() - 60.05)), 0.0, 0.1);
  EXPECT_EQ(countCracks(*surfaceOf(zoo::sphere()).geometry).count, 0u);
}

}  // namespace
}  // namespace palpate::contact
