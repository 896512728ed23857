// Paths of the hunt: as long as asked, the same for the same seed, free at first, deep later.
#include "lab/workloads/hunted_paths.h"

#include <gtest/gtest.h>

#include "lab/workloads/heldout_meshes.h"

namespace palpate::lab {
namespace {

class HuntedPaths : public testing::Test {
 protected:
  OracleBody ball{bumpyBallMesh(60, 0.05, 5, 4), false};
};

TEST_F(HuntedPaths, BeginOutOfReachAndHaveTheirTicks) {
  for (const std::string& kind : huntedPathKinds()) {
    for (const double radius : {0.0, 5.0}) {
      const std::vector<Vec3> tips = huntedPath(ball, kind, {.ticks = 700, .radius_mm = radius, .seed = 4});
      ASSERT_EQ(tips.size(), 700u) << kind;
      EXPECT_FALSE(ball.inside(tips.front())) << kind;
      if (kind == "graze") continue;  // it may begin at the skin
      EXPECT_GT(ball.nearest(tips.front()).distance, radius) << kind;
    }
  }
}

TEST_F(HuntedPaths, AreTheSameForTheSameSeedAndScaleWithTheBody) {
  const HuntedPathSettings settings{.ticks = 500, .seed = 9};
  EXPECT_EQ(huntedPath(ball, "walk", settings), huntedPath(ball, "walk", settings));
  mesh::TriangleMesh large = ball.mesh();
  for (Vec3& p : large.positions) p *= 1024.0;
  OracleBody large_ball(large, false);
  const std::vector<Vec3> tips = huntedPath(ball, "press", settings);
  const std::vector<Vec3> large_tips = huntedPath(large_ball, "press", {.ticks = 500, .mm = 1024.0, .seed = 9});
  for (std::size_t k = 0; k < tips.size(); ++k) ASSERT_LT((1024.0 * tips[k] - large_tips[k]).norm(), 1e-6);
}

TEST_F(HuntedPaths, GoDeepAndJumpFar) {
  double deepest = 0.0, longest = 0.0;
  for (std::uint64_t seed = 1; seed < 30; ++seed) {
    for (const Vec3& tip : huntedPath(ball, "press", {.seed = seed})) {
      if (ball.inside(tip)) deepest = std::max(deepest, ball.nearest(tip).distance);
    }
    const std::vector<Vec3> jumps = huntedPath(ball, "jump", {.ticks = 100, .seed = seed});
    for (std::size_t k = 1; k < jumps.size(); ++k) longest = std::max(longest, (jumps[k] - jumps[k - 1]).norm());
  }
  EXPECT_GT(deepest, 40.0);
  EXPECT_GT(longest, 15.0);
  EXPECT_LT(longest, 31.0) << "noise apart, 30 mm a tick is the longest";
}

}  // namespace
}  // namespace palpate::lab
