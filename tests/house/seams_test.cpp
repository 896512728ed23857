// What the engine's libraries leave to others: printing and exiting to programs, threads for cold work to
// base/background.h, foreign mesh formats to read_foreign.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kEngineFolder = fs::path(PALPATE_SOURCE_DIR) / "src/palpate";

/// "room/file:line" of every line of code that matches, in rooms and files that are not named in `except`.
std::vector<std::string> placesOf(const std::string& pattern, const std::vector<std::string>& except = {}) {
  const std::regex regex(pattern);
  std::vector<std::string> places;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kEngineFolder)) {
    const std::string name = entry.path().lexically_relative(kEngineFolder).string();
    const auto excepted = [&](const std::string& prefix) { return name.starts_with(prefix); };
    if (!entry.is_regular_file() || std::any_of(except.begin(), except.end(), excepted)) continue;
    std::ifstream stream(entry.path());
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      const std::string code = line.substr(0, line.find("//"));
      if (std::regex_search(code, regex)) places.push_back(name + ":" + std::to_string(number) + ": " + line);
    }
  }
  return places;
}

const std::vector<std::string> kNowhere;

TEST(Seams, LibrariesNeitherPrintNorExit) {
  EXPECT_EQ(placesOf(R"(std::c(out|err|log)\b|\bf?printf\(|\b(fputs|puts|perror)\(|fmt::print)"), kNowhere);
  EXPECT_EQ(placesOf(R"(\b(exit|_Exit|quick_exit|abort|terminate)\()"), kNowhere);
}

/// The servo loop and the hand-over of worlds are threads themselves.
TEST(Seams, ColdWorkAsksOnePlaceForThreads) {
  const std::string threads = R"(std::(async|thread|jthread|packaged_task)\b|hardware_concurrency)";
  EXPECT_EQ(placesOf(threads, {"base/background.", "servo/", "engine/", "window/"}), kNowhere);
  EXPECT_FALSE(placesOf(threads).empty());  // the pattern finds something
}

TEST(Seams, OneFileKnowsAssimp) {
  EXPECT_EQ(placesOf("<assimp/|Assimp::", {"mesh/files/read_foreign.cpp"}), kNowhere);
  EXPECT_FALSE(placesOf("<assimp/").empty());
}

}  // namespace
