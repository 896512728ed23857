// Degenerate contact: tips that hit edges and vertices exactly, and tips that live on planes. Nothing may slip through
// the gap that a rounded side test leaves between two triangles.
#include <fmt/format.h>

#include "lab/tests/contact_bars/bars.h"
#include "lab/workloads/heldout_paths.h"

namespace palpate::bars {
namespace {

struct Misses {
  std::size_t straight = 0, with_stop = 0;
};

/// Each three of tips is above, on and below; a fresh finger goes straight through, another stops on the surface.
Misses countMisses(const bench::ContactWorld& world, const device::Trajectory& aimed) {
  const std::vector<Vec3> tips = bench::scaledTips(aimed, world.scale);
  const contact::FingerSettings finger = contact::scaled(makeBarFinger(0.0), world.scale);
  Misses misses;
  for (std::size_t k = 0; k + 2 < tips.size(); k += 3) {
    contact::FingerState straight, stopping;
    contact::step(world.surface, finger, straight, tips[k]);
    contact::step(world.surface, finger, stopping, tips[k]);
    contact::step(world.surface, finger, stopping, tips[k + 1]);
    misses.straight += contact::step(world.surface, finger, straight, tips[k + 2]).force.isZero(0.0) ? 1 : 0;
    misses.with_stop += contact::step(world.surface, finger, stopping, tips[k + 2]).force.isZero(0.0) ? 1 : 0;
  }
  return misses;
}

class AimedSegments : public testing::TestWithParam<const char*> {};

TEST_P(AimedSegments, NeverMissEdgesAndVertices) {
  const std::string mesh = GetParam();
  if (mesh == "back_1000000" && !heavy()) GTEST_SKIP() << "only with PALPATE_HEAVY=1";
  const std::size_t segments = heavy() ? 200000 : 20000;
  bench::ContactWorld real = makeBarWorld(mesh);
  const device::Trajectory path = lab::aimed(real.side, {.ticks = 3 * segments, .depth_mm = 1.0});
  for (const double scale : {0.001, 1.0, 1000.0}) {
    const bench::ContactWorld world = makeBarWorld(mesh, scale);
    const Misses misses = countMisses(world, path);
    EXPECT_EQ(misses.straight, 0u) << "scale " << scale;
    EXPECT_EQ(misses.with_stop, 0u) << "scale " << scale;
  }
}

INSTANTIATE_TEST_SUITE_P(Exact, AimedSegments,
                         testing::Values("back_2962", "back_200000", "back_1000000", "lattice100", "groove90"),
                         [](const auto& mesh) { return std::string(mesh.param); });

class Lattice : public testing::TestWithParam<double> {};

TEST_P(Lattice, TipsOnPlanesEdgesAndVerticesNeitherFallNorWait) {
  for (const auto& [path, mesh] : {std::pair{"lattice_flat", "lattice100"}, {"lattice_groove", "groove90"}}) {
    bench::ContactWorld world = makeBarWorld(mesh, GetParam());
    const bench::ContactFigures figures = measure(world, path);
    EXPECT_EQ(figures.ticks, 100000u);
    EXPECT_EQ(figures.falls.ticks, 0u) << path << ", first at tick " << figures.falls.first_tick.value_or(0);
    EXPECT_EQ(figures.falls.first_contact_delay_ticks, 0u) << path;
    EXPECT_GT(figures.falls.first_contacts, 1000u) << path;
    support::expectNone(figures.counts.allocations, path);
  }
}

INSTANTIATE_TEST_SUITE_P(Exact, Lattice, testing::Values(0.001, 1.0, 1000.0),
                         [](const auto& scale) { return testName(fmt::format("scale_{}", scale.param)); });

}  // namespace
}  // namespace palpate::bars
