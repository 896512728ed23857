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
  for (const char* twin : {"palpate", "palpate_unoptimised"}) {
    const auto run =
        support::runProgram(build / twin, std::string("simulate --no-pictures --out ") + twin, folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const std::string forces = support::contentOf(folder.path() / "palpate" / "forces.csv");
  EXPECT_GT(forces.size(), 1'000'000u);
  EXPECT_TRUE(forces == support::contentOf(folder.path() / "palpate_unoptimised" / "forces.csv"));
}

}  // namespace palpate
