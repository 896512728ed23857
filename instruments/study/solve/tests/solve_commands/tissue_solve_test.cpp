// `palpate tissue solve` from the outside: what it prints, writes and draws, and which requests it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/tissue/layered_table.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::CommandResult;

class TissueSolveCommand : public ::testing::Test {
 protected:
  CommandResult solve(const std::string& arguments) const {
    return support::runPalpate("tissue solve " + arguments, folder_.path());
  }

  const std::string back_ = "--layer skin:2mm:150kPa --layer fat:8mm:10kPa --layer muscle:30mm:27kPa ";
  support::TemporaryFolder folder_;
};

TEST_F(TissueSolveCommand, PrintsWhatItSolvedAndWritesTheTable) {
  const CommandResult result = solve(back_ + "--depths 1:5:2 -o back.json --plot back.svg --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json solved = json::parse(result.out);
  EXPECT_EQ(solved["depths"], (std::vector{1.0, 3.0, 5.0}));
  EXPECT_EQ(solved["converged_to_mm"], 5.0);
  EXPECT_TRUE(solved["stopped_by"].is_null());
  EXPECT_GT(solved["seconds"].get<double>(), 0.0);
  EXPECT_NEAR(solved["force_n"].at(2).get<double>(), 1.3274, 0.005);  // an independent solver's
  EXPECT_NEAR(solved["drag"]["along_mm"].get<double>(), 16.1, 0.5);
  EXPECT_GT(solved["drag"]["tangential_over_normal"].get<double>(), 1.0);

  const tissue::LayeredTable table = tissue::readLayeredTable(folder_ / "back.json");
  ASSERT_EQ(table.shapes.size(), 3u);
  EXPECT_EQ(table.stack.layers.at(1).name, "fat");
  EXPECT_EQ(table.radii_mm.size(), 121u);
  EXPECT_TRUE(table.drag.has_value());
  const std::string svg = support::contentOf(folder_ / "back.svg");
  for (const char* text : {"layers over bone under a press", "5 mm", "force (N)"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST_F(TissueSolveCommand, SolvesOtherFingersIntoTheTableWhereAsked) {
  const CommandResult result = solve(
      "--layer skin:2:150 --layer muscle:8:27 --depths 0.5,3 --no-drag --fingers --fineness 0.5 -o thin.json --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json solved = json::parse(result.out);
  const tissue::LayeredTable table = tissue::readLayeredTable(folder_ / "thin.json");
  ASSERT_EQ(table.fingers.size(), 6u);
  ASSERT_EQ(solved["fingers"].size(), 6u);
  EXPECT_EQ(table.fingers[0].radius_mm, 1.0);
  EXPECT_EQ(table.fingers[0].depths_mm, std::vector{0.5}) << "a small sphere is not pressed deep";
  EXPECT_EQ(table.fingers[5].radius_mm, 24.0);
  EXPECT_EQ(table.fingers[5].depths_mm, (std::vector{0.5, 3.0}));
  EXPECT_LT(table.fingers[2].force_n[1], table.shapes[1].force_n) << "4 mm against 8";
  EXPECT_GT(table.fingers[3].force_n[1], 1.2 * table.shapes[1].force_n) << "12 mm against 8";
}

TEST_F(TissueSolveCommand, WhereTissueGivesWayItKeepsWhatItReachedAndSaysNo) {
  const CommandResult result =
      solve("--layer skin:2:150 --layer fat:2:10 --layer muscle:5:27 --depths 4,8.5 --no-drag -o rib.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("of 8.5 mm"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("gives way"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("solved to 7."), std::string::npos) << result.out;
  const tissue::LayeredTable table = tissue::readLayeredTable(folder_ / "rib.json");
  EXPECT_EQ(table.shapes.size(), 2u);
  EXPECT_FALSE(table.drag.has_value());
}

TEST_F(TissueSolveCommand, WrongRequestsAreOneLineAndExitCodeTwo) {
  const struct {
    std::string arguments;
    std::string said;
  } wrongs[] = {{"", "--layer"},
                {"--layer skin:2mm", "skin:2mm"},
                {"--layer skin:2mm:0kPa --depths 1", "0"},
                {"--layer skin:2mm:150kPa --depths 5", "reaches the bone"},
                {back_ + "--depths 1:10", "FROM:TO:STEP"},
                {back_ + "--depths 1:10:0", "--depths"},
                {back_ + "--depths 0.001:30:0.001", "1 to 200"},
                {back_ + "--depths 5,3", "3 after 5"},
                {back_ + "--depths deep", "--depths"},
                {back_ + "--poisson 0.5", "--poisson"},
                {back_ + "--plot picture.bmp", ".png"},
                {back_ + "--depths 0.5 --no-drag -o /proc/nowhere/table.json", "/proc/nowhere"}};
  for (const auto& wrong : wrongs) {
    const CommandResult result = solve(wrong.arguments);
    EXPECT_EQ(result.exit_code, 2) << wrong.arguments;
    EXPECT_NE(result.err.find(wrong.said), std::string::npos) << wrong.arguments << ": " << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace palpate
