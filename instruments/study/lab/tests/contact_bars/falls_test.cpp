// No finger ever falls through the skin, at any radius, scale or speed of the benchmark; and contact is felt at once.
#include <fmt/format.h>

#include "lab/tests/contact_bars/bars.h"

namespace palpate::bars {
namespace {

void expectNoFalls(bench::ContactWorld& world, const device::Trajectory& path, double radius_mm,
                   const std::string& what) {
  const bench::ContactFigures figures = bench::measureContact(world, path, makeBarFinger(radius_mm));
  EXPECT_EQ(figures.falls.ticks, 0u) << what << ", first at tick " << figures.falls.first_tick.value_or(0);
  EXPECT_EQ(figures.falls.first_contact_delay_ticks, 0u) << what;
  EXPECT_GT(figures.contact_ticks, 0u) << what;
  if (!figures.sphere) return;
  EXPECT_EQ(figures.sphere->missed_ticks, 0u) << what;
}

struct Setting {
  double scale, radius_mm;
};

class EveryScaleAndRadius : public testing::TestWithParam<Setting> {};

TEST_P(EveryScaleAndRadius, BackJumpsAndStabs) {
  bench::ContactWorld world = makeBarWorld("back_8163", GetParam().scale);
  for (const lab::PathName& name : lab::workloadPathNames()) {
    if (name.mesh != "back") continue;
    expectNoFalls(world, lab::workloadPath(name.path), GetParam().radius_mm, name.path);
  }
}

TEST_P(EveryScaleAndRadius, GroovesPitAndEggcrate) {
  for (const char* mesh : {"groove60", "groove90", "groove120", "pit", "eggcrate"}) {
    bench::ContactWorld world = makeBarWorld(mesh, GetParam().scale);
    for (const lab::PathName& name : lab::workloadPathNames()) {
      if (name.mesh != mesh || name.path.starts_with("lattice")) continue;
      expectNoFalls(world, lab::workloadPath(name.path), GetParam().radius_mm, name.path);
    }
  }
}

TEST_P(EveryScaleAndRadius, ClosedBodies) {
  const mesh::TriangleMesh ball = lab::bumpyBallMesh(60, 0.08, 9.0, 4);
  bench::ContactWorld ball_world = bench::buildContactWorld(ball, GetParam().scale);
  expectNoFalls(ball_world, lab::orbit(ball, Vec3::Zero()), GetParam().radius_mm, "ball");
  const mesh::TriangleMesh ring = lab::torusMesh(50, 18, 60, 24);
  bench::ContactWorld ring_world = bench::buildContactWorld(ring, GetParam().scale);
  expectNoFalls(ring_world, lab::orbit(ring, {50, 0, 0}), GetParam().radius_mm, "ring");
}

std::vector<Setting> everySetting() {
  std::vector<Setting> settings;
  for (const double scale : {0.001, 1.0, 1000.0}) {
    for (const double radius_mm : radiiMm()) settings.push_back({scale, radius_mm});
  }
  return settings;
}

INSTANTIATE_TEST_SUITE_P(Falls, EveryScaleAndRadius, testing::ValuesIn(everySetting()), [](const auto& setting) {
  return testName(fmt::format("scale_{}_radius_{}", setting.param.scale, setting.param.radius_mm));
});

class EverySize : public testing::TestWithParam<std::size_t> {};

TEST_P(EverySize, BackJumpsAndStabs) {
  if (GetParam() > 200000 && !heavy()) GTEST_SKIP() << "only with PALPATE_HEAVY=1";
  const std::vector<double> scales = heavy() ? std::vector<double>{0.001, 1.0, 1000.0} : std::vector<double>{1.0};
  const std::vector<double> radii = heavy() ? radiiMm() : std::vector<double>{0.0};
  for (const double scale : scales) {
    bench::ContactWorld world = makeBarWorld(fmt::format("back_{}", GetParam()), scale);
    for (const lab::PathName& name : lab::workloadPathNames()) {
      if (name.mesh != "back") continue;
      for (const double radius_mm : radii) {
        expectNoFalls(world, lab::workloadPath(name.path), radius_mm,
                      fmt::format("{} at scale {} radius {}", name.path, scale, radius_mm));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Falls, EverySize, testing::Values(2962, 41582, 200000, 1000000, 4000000),
                         [](const auto& size) { return fmt::to_string(size.param); });

TEST(FirstContact, EveryOneOf300StabsIsFeltInItsOwnTick) {
  bench::ContactWorld world = makeBarWorld("back_8163");
  for (const char* path : {"back_stab1mps", "back_stab2mps", "back_stab5mps"}) {
    for (const double radius_mm : radiiMm()) {
      const bench::ContactFigures figures = measure(world, path, radius_mm);
      EXPECT_EQ(figures.falls.first_contacts, 300u) << path << " radius " << radius_mm;
      EXPECT_EQ(figures.falls.first_contact_delay_ticks, 0u) << path << " radius " << radius_mm;
    }
  }
}

TEST(OpenBorder, SlidesOffAndIsFeltAgainOnlyFromTheFront) {
  bench::ContactWorld world = makeBarWorld("flat100");
  const bench::ContactFigures press = measure(world, "flat_press");
  EXPECT_EQ(press.falls.first_contacts, 16u);
  EXPECT_EQ(press.falls.ticks, 0u);
  EXPECT_LE(press.max_force_step_n, 0.2) << "the force fades at the border instead of breaking off";
  const bench::ContactFigures under = measure(world, "flat_edge");
  EXPECT_LT(under.contact_ticks, 500u) << "after the first exit the tip comes back below the sheet and is not felt";
}

}  // namespace
}  // namespace palpate::bars
