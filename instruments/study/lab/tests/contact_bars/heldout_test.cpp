// Shapes and movements that no bar was tuned on: whatever happens, the invariants of a finger hold.
#include <fmt/format.h>

#include "lab/tests/contact_bars/bars.h"
#include "lab/workloads/heldout_paths.h"

namespace palpate::bars {
namespace {

/// Lengths of the tiny and the huge world: the same experiment, thousands of times smaller or larger.
double worldScale(const std::string& mesh) { return mesh == "tiny" ? 0.01 / 400 : (mesh == "huge" ? 1e5 / 400 : 1.0); }

class HeldoutShape : public testing::TestWithParam<std::string> {
 protected:
  void expectSound(bench::ContactWorld& world, const device::Trajectory& path, const contact::FingerSettings& finger,
                   const std::string& what) {
    const bench::FingerRun run = bench::runFinger(world.surface, finger, path.tip_mm);
    const lab::InvariantReport invariants =
        lab::checkInvariants(world.side.mesh(), finger, world.stiffness_n_per_mm, run.outputs);
    EXPECT_TRUE(invariants.clean()) << what << ": " << invariants.text();
    const bench::ContactFigures figures = bench::computeFigures(world, run, finger, path.time_s);
    EXPECT_EQ(figures.falls.ticks, 0u) << what << ", first at tick " << figures.falls.first_tick.value_or(0);
    EXPECT_GT(figures.contact_ticks, path.size() / 20) << what;
  }
};

TEST_P(HeldoutShape, IsFeltSoundlyByPointsAndSpheres) {
  const double size = worldScale(GetParam());
  bench::ContactWorld world = bench::buildContactWorld(lab::heldoutMesh(GetParam()));
  for (const double radius_mm : {0.0, 4.0}) {
    const contact::FingerSettings finger = contact::scaled(makeBarFinger(radius_mm), size);
    for (const double step_mm : {0.1, 1.0, 5.0}) {
      const lab::PathSettings settings{
          .ticks = 6000, .step_mm = step_mm * size, .depth_mm = 5.0 * size, .start_above_mm = 10.0 * size, .seed = 7};
      const std::string what = fmt::format("{} mm a tick, radius {} mm", step_mm, radius_mm);
      expectSound(world, lab::rub(world.side, settings), finger, "rub, " + what);
      expectSound(world, lab::tour(world.side, settings), finger, "tour, " + what);
    }
  }
}

/// All but those that repair has to mend first.
std::vector<std::string> soundShapes() {
  std::vector<std::string> names = lab::heldoutMeshNames();
  std::erase_if(names, [](const std::string& name) { return name == "overlapping_balls" || name == "touching_boxes"; });
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, HeldoutShape, testing::ValuesIn(soundShapes()),
                         [](const auto& mesh) { return mesh.param; });

}  // namespace
}  // namespace palpate::bars
