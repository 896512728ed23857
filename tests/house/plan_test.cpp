// The plan of the house by product, as tools/house counts it. A bar here only ever falls.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_command.h"

namespace palpate {
namespace {

/// The tool reads every file of the repository, seconds long: it runs once.
const nlohmann::json& planOfTheHouse() {
  static const nlohmann::json plan = [] {
    const auto answer = support::runProgram(support::sourceFolder() / "tools/house", "--json");
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    return nlohmann::json::parse(answer.out);
  }();
  return plan;
}

TEST(Plan, IncludesBetweenHousesRunOneWay) {
  const nlohmann::json& plan = planOfTheHouse();
  EXPECT_GT(plan["includes_between_houses"], 1500) << "it looks at something";
  EXPECT_EQ(plan["wrong_way_includes"], 0) << "tools/house --wrong names them";
  EXPECT_EQ(plan["mutual_folders"], 0) << "tools/house --wrong names them";
  EXPECT_EQ(plan["cmake_regexes"], 0);
  EXPECT_LE(plan["viewer_lines"], 350);
  EXPECT_FALSE(plan["lines_by_house"].contains("other") && plan["lines_by_house"]["other"] > 150)
      << "a file of no house: the table of ARCHITECTURE.md";
}

TEST(Plan, NothingIsWrittenTwice) {
  EXPECT_LE(planOfTheHouse()["duplicates"], 6) << "tools/house --duplicates names them";
}

}  // namespace
}  // namespace palpate
