// The same forces to the last bit whether or not the compiler optimised: tips on the benchmark's meshes, and a run from
// the default scene to forces.csv. Both need the twins that PALPATE_DETERMINISM_BUILD adds (tools/test-heavy).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {

namespace fs = std::filesystem;

TEST(Determinism, AFingerFeelsTheSameBitsWithoutOptimisation) {
  const fs::path twins = fs::path(PALPATE_BINARY_DIR) / "twin";
  if (!fs::exists(twins / "feel_unoptimised")) GTEST_SKIP() << "built without PALPATE_DETERMINISM_BUILD";
  const auto fast = support::runProgram(twins / "feel_optimised", "");
  const auto slow = support::runProgram(twins / "feel_unoptimised", "");
  ASSERT_EQ(fast.exit_code, 0) << fast.err;
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  EXPECT_EQ(std::count(fast.out.begin(), fast.out.end(), '\n'), 16);
  EXPECT_EQ(fast.out, slow.out);
}

TEST(Determinism, TheDefaultSceneIsBitIdenticalWithoutOptimisation) {
  const fs::path build = PALPATE_BINARY_DIR;
  if (std::getenv("PALPATE_HEAVY") == nullptr) GTEST_SKIP() << "set PALPATE_HEAVY=1 (tools/test-heavy)";
  if (!fs::exists(build / "twin/scene_unoptimised")) GTEST_SKIP() << "built without PALPATE_DETERMINISM_BUILD";
  const support::TemporaryFolder folder;
  const auto fast = support::runProgram(build / "palpate", "simulate --no-pictures --out fast", folder.path());
  ASSERT_EQ(fast.exit_code, 0) << fast.err;
  const auto slow = support::runProgram(build / "twin/scene_unoptimised",
                                        PALPATE_SOURCE_DIR "/scenes/default.toml slow.csv", folder.path());
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  const std::string forces = support::contentOf(folder.path() / "fast" / "forces.csv");
  EXPECT_GT(forces.size(), 1'000'000u);
  EXPECT_TRUE(forces == support::contentOf(folder.path() / "slow.csv"));
}

}  // namespace palpate
