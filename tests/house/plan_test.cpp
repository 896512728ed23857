// The plan of the house by product, as tools/house counts it. A bar here only ever falls.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

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

/// Symbolic links below a folder that lead to no file, by their names in it. What is built and what git keeps is left
/// out.
std::vector<std::string> brokenLinks(const std::filesystem::path& root) {
  std::vector<std::string> broken;
  std::size_t links = 0;
  for (auto it = std::filesystem::recursive_directory_iterator(root); it != std::filesystem::end(it); ++it) {
    if (it.depth() == 0 && (it->path().filename() == "build" || it->path().filename() == ".git")) {
      it.disable_recursion_pending();
    }
    if (!it->is_symlink()) continue;
    ++links;
    if (!it->exists()) broken.push_back(it->path().lexically_relative(root).generic_string());
  }
  EXPECT_GT(links, 0u) << "it looks at something";
  std::sort(broken.begin(), broken.end());
  return broken;
}

TEST(Plan, EverySymbolicLinkLeadsToAFile) {
  EXPECT_EQ(brokenLinks(support::sourceFolder()), std::vector<std::string>());
}

TEST(Plan, ASymbolicLinkThatLeadsNowhereIsSeen) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "tests");
  std::filesystem::create_symlink("../moved/.clang-tidy", folder / "tests/.clang-tidy");
  std::filesystem::create_symlink("tests", folder / "a_folder");
  EXPECT_EQ(brokenLinks(folder.path()), std::vector<std::string>{"tests/.clang-tidy"});
}

}  // namespace
}  // namespace palpate
