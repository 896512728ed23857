#include "lab/workloads/heldout_paths.h"

#include <gtest/gtest.h>

#include "lab/workloads/heldout_meshes.h"

namespace palpate::lab {
namespace {

TEST(HeldoutPaths, RubKeepsNearTheSkinAndIsMostlyInside) {
  lab::SurfaceSide ball(lab::heldoutMesh("ball"));
  const lab::PathSettings settings{.ticks = 4000};
  const device::Trajectory path = lab::rub(ball, settings);
  std::size_t inside = 0;
  for (const Vec3& tip : path.tip_mm) {
    EXPECT_LT(ball.nearestTo(tip).distance, 3 * settings.depth_mm);
    inside += ball.sideOf(tip) == lab::Side::inside ? 1 : 0;
  }
  EXPECT_GT(inside, path.size() / 2);
  EXPECT_LT(inside, path.size());
}

TEST(HeldoutPaths, TourMovesAtItsSpeedAndCrossesTheSkinOften) {
  lab::SurfaceSide ring(lab::torusMesh(50, 18, 40, 20));
  const device::Trajectory path = lab::tour(ring, {.ticks = 10000, .step_mm = 1.0, .depth_mm = 8.0});
  std::size_t crossings = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    EXPECT_LE((path.tip_mm[k] - path.tip_mm[k - 1]).norm(), 1.0 + 1e-9);
    crossings += ring.sideOf(path.tip_mm[k]) != ring.sideOf(path.tip_mm[k - 1]) ? 1 : 0;
  }
  EXPECT_GT(crossings, 100u);
}

TEST(HeldoutPaths, AimedSegmentsGoThroughVerticesAndEdges) {
  lab::SurfaceSide saddle(lab::heldoutMesh("saddle"));
  const device::Trajectory path = lab::aimed(saddle, {.ticks = 300, .depth_mm = 1.0});
  ASSERT_EQ(path.size(), 300u);
  for (std::size_t k = 0; k < path.size(); k += 3) {
    EXPECT_EQ(saddle.sideOf(path.tip_mm[k]), lab::Side::outside);
    EXPECT_EQ(saddle.sideOf(path.tip_mm[k + 1]), lab::Side::on_surface);
    EXPECT_EQ(saddle.sideOf(path.tip_mm[k + 2]), lab::Side::inside);
  }
}

}  // namespace
}  // namespace palpate::lab
