// The default scene, body and all, feels the same forces to the last bit whether or not the compiler optimised. The
// twin needs a minute to build the torso, so this is one of the heavy tests; tests/apps compares a smaller scene every
// time.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {

namespace fs = std::filesystem;

TEST(Determinism, TheDefaultSceneIsBitIdenticalWithoutOptimisation) {
  const fs::path build = PALPATE_BINARY_DIR;
  if (std::getenv("PALPATE_HEAVY") == nullptr) GTEST_SKIP() << "set PALPATE_HEAVY=1 (tools/test-heavy)";
  if (!fs::exists(build / "palpate_unoptimised")) GTEST_SKIP() << "built without PALPATE_DETERMINISM_BUILD";
  const support::TemporaryFolder folder;
  const auto fast = support::runProgram(build / "palpate", "simulate --no-pictures --out fast", folder.path());
  ASSERT_EQ(fast.exit_code, 0) << fast.err;
  const auto slow = support::runProgram(build / "palpate_unoptimised",
                                        PALPATE_SOURCE_DIR "/scenes/default.toml slow.csv", folder.path());
  ASSERT_EQ(slow.exit_code, 0) << slow.err;
  const std::string forces = support::contentOf(folder.path() / "fast" / "forces.csv");
  EXPECT_GT(forces.size(), 1'000'000u);
  EXPECT_TRUE(forces == support::contentOf(folder.path() / "slow.csv"));
}

}  // namespace palpate
