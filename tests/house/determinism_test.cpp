// Same scene, same forces: bit by bit, run after run, and whether or not the compiler optimised.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path kBuild = PALPATE_BINARY_DIR;

// The forces of the first seconds of the default scene: two fingers press, stick and slip on the torso.
std::string forcesOf(const std::string& command, const std::string& run) {
  const fs::path folder = fs::temp_directory_path() / ("palpate_determinism_" + run);
  fs::remove_all(folder);
  const std::string line =
      (kBuild / command).string() + " simulate --seconds 3 --out " + folder.string() + " > /dev/null 2>&1";
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  std::ostringstream text;
  text << std::ifstream(folder / "forces.csv", std::ios::binary).rdbuf();
  fs::remove_all(folder);
  return text.str();
}

}  // namespace

TEST(Determinism, TwoRunsOfTheDefaultSceneAreBitIdentical) {
  const std::string first = forcesOf("palpate", "first");
  EXPECT_GT(first.size(), 100'000u);
  EXPECT_TRUE(first == forcesOf("palpate", "second"));
}

TEST(Determinism, AnUnoptimisedBuildFeelsTheSameForces) {
  if (!fs::exists(kBuild / "palpate_unoptimised")) GTEST_SKIP() << "configured without PALPATE_DETERMINISM_BUILD";
  EXPECT_TRUE(forcesOf("palpate", "optimised") == forcesOf("palpate_unoptimised", "unoptimised"));
}
