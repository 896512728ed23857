#include "palpate/hdb/hdb_finger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/tests/hdb/hdb_track.h"
#include "palpate/base/random.h"
#include "support/counted.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"

namespace palpate::hdb {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

FingerSettings frictionless() {
  FingerSettings settings;
  settings.mu_static = settings.mu_dynamic = 0.0;
  return settings;
}

/// A sheet over z = height(x, y), 100 mm wide.
template <class Height>
mesh::TriangleMesh sheetOver(Height height, int cells = 16) {
  mesh::TriangleMesh mesh = zoo::grid(cells, 100.0);
  for (Vec3& p : mesh.positions) p.z() = height(p.x() - 50.0, p.y() - 50.0);
  return mesh;
}

}  // namespace

// ---- one finger on small bodies -------------------------------------------------------------------------------------

TEST(HdbFinger, FirstContactHasItsForceInTheSameTick) {
  const HdbBody plate(zoo::grid());
  HdbTrack finger(plate);
  EXPECT_FALSE(touches(finger.to({51.3, 48.7, 5})));
  const FingerOutput output = finger.to({51.3, 48.7, -4});
  EXPECT_NEAR((output.force - Vec3(0, 0, 4 * kTestStiffness)).norm(), 0, 1e-9);
  EXPECT_NEAR((output.proxy - Vec3(51.3, 48.7, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(output.touch, Touch::stick);
  EXPECT_NE(output.triangle, kNoIndex);
}

TEST(HdbFinger, EntersThroughVerticesAndEdgesAndAfterAStopOnTheSurface) {
  const HdbBody plate(zoo::grid(8, 100.0));
  expectEntranceEverywhere<HdbTrack>(plate);
}

TEST(HdbFinger, ComesInFromTheFrontOnlyAndLetsGoThere) {
  const HdbBody plate(zoo::grid());
  HdbTrack finger(plate);
  finger.to({50, 50, -5});
  EXPECT_FALSE(touches(finger.to({50, 50, 5}))) << "from behind";
  for (int press = 0; press < 3; ++press) {
    EXPECT_TRUE(touches(finger.to({50, 50, -2})));
    EXPECT_FALSE(touches(finger.to({50, 50, 1e-9})));
  }
}

TEST(HdbFinger, ATipThatIsNoNumberIsLostAndChangesNothing) {
  const HdbBody plate(zoo::grid());
  HdbTrack finger(plate);
  finger.to({50, 50, 1});
  finger.to({50, 50, -3});
  const FingerOutput lost = finger.to(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(lost.status, static_cast<std::uint32_t>(kTipLost));
  EXPECT_TRUE(lost.force.isZero());
  EXPECT_NEAR(finger.to({50, 50, -3}).depth_mm, 3.0, 1e-9);
}

TEST(HdbFinger, WithoutTrianglesInItsBoxItIsFree) {
  const HdbBody plate(zoo::grid(), cubeSettings(4.0));
  HdbTrack finger(plate);
  EXPECT_FALSE(touches(finger.to({50, 50, 500})));
  EXPECT_FALSE(touches(finger.slide({50, 50, 20}, 1.0)));
  EXPECT_EQ(finger.candidates().size(), 0u);
  EXPECT_TRUE(touches(finger.slide({50, 50, -1}, 1.0)));
}

TEST(HdbFinger, KineticFrictionIsItsCoefficientAtAnySpeedUnderEveryForceLaw) {
  HdbBody plate(zoo::grid());
  for (const auto kind :
       {tissue::ForceLaw::Kind::linear, tissue::ForceLaw::Kind::power, tissue::ForceLaw::Kind::stiffening}) {
    plate.surface.force_law.kind = kind;
    for (const double step : {0.02, 0.1, 0.5}) {
      HdbTrack finger(plate);
      const double highest = highestRatioOfADrag(finger, 0.0, step);
      EXPECT_LE(highest, 0.46 + 1e-9);
      EXPECT_GE(highest, 0.44 - 1e-9) << "it slips: 5 mm deep after 2.3 mm, under every law";
    }
  }
}

TEST(HdbFinger, RestsAtALocalMinimumOfTheDistanceAlsoAtEdgesAndCorners) {
  // A roof, a gutter, a tent and a saddle.
  using Height = double (*)(double, double);
  const std::initializer_list<Height> heights = {[](double x, double) { return -std::abs(x); },
                                                 [](double x, double) { return std::abs(x); },
                                                 [](double x, double y) { return -std::abs(x) - std::abs(y); },
                                                 [](double x, double y) { return 0.02 * (x * x - y * y); }};
  Random random(3);
  for (const Height height : heights) {
    const HdbBody body(sheetOver(height));
    HdbTrack finger(body, frictionless());
    double x = 0.0;
    double y = 0.0;
    for (int i = 0; i < 400; ++i) {
      x = std::clamp(x + random.uniform(-0.5, 0.5), -20.0, 20.0);
      y = std::clamp(y + random.uniform(-0.5, 0.5), -20.0, 20.0);
      const Vec3 tip(50 + x, 50 + y, height(x, y) + (i == 0 ? 5.0 : -4.0));
      FingerOutput output = finger.to(tip);
      for (int more = 0; more < 300 && (output.status & kCatchingUp) != 0; ++more) output = finger.to(tip);
      if (i == 0) continue;
      ASSERT_TRUE(touches(output)) << tip.transpose();
      const WalkResult walk = walkToNearest(body.surface, finger.state().proxy, tip, kUnbounded);
      ASSERT_NEAR((walk.at.position - tip).norm(), output.depth_mm, 1e-5) << "the walk finds nothing nearer";
    }
  }
}

namespace {

/// A tip that wanders under a sheet, away from its border, with stops so that a proxy that leapt may arrive.
template <class Height>
std::vector<Vec3> wanderingUnder(Height height, double depth_mm, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> tips = {Vec3(50, 50, height(0.0, 0.0) + 5.0)};
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double step_mm = i % 300 < 40 ? 0.0 : 0.08;
    heading += random.uniform(-0.1, 0.1);
    x += step_mm * std::cos(heading);
    y += step_mm * std::sin(heading);
    if (std::hypot(x, y) > 25.0) heading = std::atan2(-y, -x);
    tips.emplace_back(50 + x, 50 + y, height(x, y) - depth_mm);
  }
  return tips;
}

}  // namespace

TEST(HdbFinger, FeelsWhatTheDefaultFingerFeelsToTheBitWhereItsListReaches) {
  // A tent, an egg crate and a saddle: over their ridges a proxy leaps and uses up its path on the way.
  using Height = double (*)(double, double);
  const std::initializer_list<Height> heights = {
      [](double x, double y) { return -0.3 * (std::abs(x) + std::abs(y)); },
      [](double x, double y) { return 2.0 * std::sin(0.4 * x) * std::sin(0.4 * y); },
      [](double x, double y) { return 0.02 * (x * x - y * y); }};
  std::size_t leaps = 0;
  for (const Height height : heights) {
    for (const double edge_mm : {10.0, 40.0}) {
      const HdbBody body(sheetOver(height, 24), cubeSettings(edge_mm));
      HdbTrack boxed(body);
      FingerTrack walking(body.surface);
      for (const Vec3& tip : wanderingUnder(height, 4.0, 11)) {
        const FingerOutput felt = boxed.to(tip);
        const FingerOutput meant = walking.to(tip);
        ASSERT_EQ(felt.force, meant.force) << tip.transpose();
        ASSERT_EQ(felt.proxy, meant.proxy) << tip.transpose();
        ASSERT_EQ(felt.hold, meant.hold) << tip.transpose();
        ASSERT_EQ(felt.status, meant.status) << tip.transpose();
        leaps += (felt.status & kCatchingUp) != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(leaps, 300u) << "in these ticks a way of its own would end elsewhere";
}

TEST(HdbFinger, SlidesRoundAnEdgeWithoutLeavingTheSkin) {
  const HdbBody roof(sheetOver([](double x, double) { return -std::abs(x); }));
  HdbTrack finger(roof, frictionless());
  finger.to({35, 50, -5});
  for (double x = 35; x <= 65; x += 0.1) {
    const FingerOutput output = finger.to({x, 50, -std::abs(x - 50) - 3});
    ASSERT_TRUE(touches(output)) << x;
    ASSERT_NEAR(output.proxy.z(), -std::abs(output.proxy.x() - 50), 1e-6) << "on the roof";
  }
}

TEST(HdbFinger, BeyondABorderTheForceFadesAndTheFingerComesFree) {
  const HdbBody plate(zoo::grid(8, 100.0));
  HdbTrack finger(plate, frictionless());
  finger.to({90, 50, 5});
  FingerOutput last = finger.to({90, 50, -5});
  const double most = kTestStiffness * (2 * 0.1 + 0.1 + 0.1);  // path bound, and the tip's own motion
  int ticks_beyond = 0;
  for (double x = 90.1; x <= 110; x += 0.1) {
    const FingerOutput now = finger.to({x, 50, -5});
    EXPECT_LE((now.force - last.force).norm(), most) << x;
    if (x > 100 && touches(now)) ++ticks_beyond;
    last = now;
  }
  EXPECT_FALSE(touches(last));
  EXPECT_GT(ticks_beyond, 5) << "not at once";
  EXPECT_FALSE(touches(finger.slide({50, 50, -5}, 0.5))) << "back below the sheet";
}

TEST(HdbFinger, DoesNotAllocate) {
  const HdbBody plate(zoo::grid(), cubeSettings(30.0, HdbQuery::coherent));
  HdbTrack finger(plate);
  finger.to({30, 50, 5});
  support::expectNoAllocation([&] {
    finger.slide({30, 50, -5}, 0.1);
    finger.slide({80, 60, -5}, 0.5);
    finger.slide({80, 60, 5}, 2.0);
  });
}

// ---- what is known to be weak ---------------------------------------------------------------------------------------

namespace {

/// Whether a finger that drops on a plate from some height passes it, in any of `phases` positions of the box's clock.
bool punctures(double edge_mm, double mm_per_tick, std::uint32_t ticks_per_refresh) {
  HdbSettings settings = cubeSettings(edge_mm);
  settings.ticks_per_refresh = ticks_per_refresh;
  const HdbBody plate(zoo::grid(40, 100.0), settings);
  for (int phase = 0; phase < 20; ++phase) {
    HdbTrack finger(plate);
    bool touched = false;
    const double start = 3 * edge_mm + mm_per_tick * ticks_per_refresh * phase / 20.0;
    for (double z = start; z > -2 * mm_per_tick * ticks_per_refresh; z -= mm_per_tick) {
      touched = touched || touches(finger.to({50.5, 49.5, z}));
    }
    if (!touched) return true;
  }
  return false;
}

}  // namespace

// E12: half an edge >= speed x refresh delay.
TEST(HdbFingerWeakness, AFingerFasterThanHalfAnEdgePerRefreshPunctures) {
  for (const auto& [edge_mm, ticks] : {std::pair{20.0, 1u}, std::pair{20.0, 10u}, std::pair{50.0, 33u}}) {
    const double limit_mm_per_tick = 0.5 * edge_mm / ticks;
    EXPECT_FALSE(punctures(edge_mm, 0.95 * limit_mm_per_tick, ticks)) << edge_mm << " mm, " << ticks << " ticks";
    EXPECT_TRUE(punctures(edge_mm, 1.3 * limit_mm_per_tick, ticks)) << edge_mm << " mm, " << ticks << " ticks";
  }
}

TEST(HdbFingerWeakness, SlidingOutOfTheBoxLosesTheSkin) {
  HdbSettings settings = cubeSettings(10.0);
  settings.ticks_per_refresh = 33;  // 33 ms
  const HdbBody plate(zoo::grid(40, 100.0), settings);
  const auto lost = [&](double mm_per_tick) {
    HdbTrack finger(plate, frictionless());
    finger.to({10, 50, 0.5});
    finger.slide({10, 50, -2}, 0.05);
    return !touches(finger.slide({90, 50, -2}, mm_per_tick));
  };
  EXPECT_FALSE(lost(0.1)) << "100 mm/s: 3.3 mm a refresh";
  EXPECT_TRUE(lost(0.5)) << "500 mm/s: 16.5 mm a refresh, more than half an edge";
}

TEST(HdbSurface, RefusesWhatCannotWork) {
  const Surface plate = surfaceOf(zoo::grid());
  const auto message = [&](std::shared_ptr<const hdb::Partition> partition, const HdbSettings& settings) {
    return support::thrownMessage([&] { makeHdbSurface(plate, std::move(partition), settings); });
  };
  const auto octree = buildTestPartition(zoo::grid());
  EXPECT_EQ(message(octree, cubeSettings(10.0)), "no error");
  EXPECT_EQ(message(nullptr, cubeSettings(10.0)), "hdb source: has no partition");
  EXPECT_EQ(message(octree, cubeSettings(0.0)), "hdb source: the box needs edges above 0");
  EXPECT_EQ(message(buildTestPartition(zoo::grid(2, 100.0)), cubeSettings(10.0)),
            "hdb source: the partition is not of this mesh");
  HdbSettings literal = cubeSettings(10.0, HdbQuery::leaves);
  literal.literal = hdb::LiteralTraversal::ElseIf;
  EXPECT_EQ(message(octree, literal), "hdb source: this traversal needs the planes of a BSP tree");
  literal.query = HdbQuery::coherent;
  EXPECT_EQ(message(octree, literal), "hdb source: a literal traversal finds leaves only");
}

}  // namespace palpate::hdb
