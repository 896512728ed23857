// The rooms of ARCHITECTURE.md are one-way: a room includes only itself and rooms above it in the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PALPATE_SOURCE_DIR;

std::vector<std::string> linesOf(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first column of the table whose header names `src/palpate/<room>`.
std::vector<std::string> roomsInOrder() {
  std::vector<std::string> rooms;
  bool inside = false;
  const std::regex row(R"(^\| `([a-z]+)` \|.*)");
  for (const std::string& line : linesOf(kRoot / "ARCHITECTURE.md")) {
    if (line.find("src/palpate/<room>") != std::string::npos && line.starts_with("|")) inside = true;
    if (inside && line.empty()) break;
    std::smatch match;
    if (inside && std::regex_match(line, match, row)) rooms.push_back(match[1]);
  }
  return rooms;
}

struct Include {
  fs::path file;
  std::string target;
};

std::vector<Include> includesUnder(const fs::path& folder) {
  std::vector<Include> includes;
  const std::regex directive(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    for (const std::string& line : linesOf(entry.path())) {
      std::smatch match;
      if (std::regex_match(line, match, directive)) includes.push_back({entry.path(), match[1]});
    }
  }
  return includes;
}

}  // namespace

TEST(Rooms, EveryFolderIsInTheTableAndOneLevelDeep) {
  const auto rooms = roomsInOrder();
  ASSERT_GE(rooms.size(), 12u);
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "src/palpate")) {
    if (!entry.is_directory()) continue;
    EXPECT_EQ(entry.path().parent_path(), kRoot / "src/palpate") << entry.path() << " is a room inside a room";
    EXPECT_TRUE(std::find(rooms.begin(), rooms.end(), entry.path().filename()) != rooms.end())
        << entry.path() << " is not in the table of ARCHITECTURE.md";
  }
}

TEST(Rooms, IncludeOnlyRoomsAbove) {
  const auto rooms = roomsInOrder();
  const auto rank = [&](const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
  };
  for (const Include& include : includesUnder(kRoot / "src/palpate")) {
    EXPECT_FALSE(include.target.starts_with("apps/") || include.target.starts_with("bench/"))
        << include.file << " includes " << include.target;
    if (!include.target.starts_with("palpate/")) continue;
    const std::string from = include.file.parent_path().filename();
    const std::string to = fs::path(include.target).parent_path().filename();
    EXPECT_LE(rank(to), rank(from)) << include.file << " includes " << include.target << ", a room below it";
  }
}

TEST(Rooms, OnlyViewKnowsGraphicsAndNobodyInTheEngineKnowsTheCommandLine) {
  for (const Include& include : includesUnder(kRoot / "src/palpate")) {
    if (include.file.parent_path().filename() == "view") continue;
    for (const std::string_view banned : {"GL/", "GLFW/", "epoxy/", "imgui", "CLI/", "nlohmann/", "iostream"}) {
      EXPECT_NE(include.target.substr(0, banned.size()), banned) << include.file << " includes " << include.target;
    }
  }
}

TEST(Rooms, PlainRoomsNeedNoThread) {
  for (const std::string room : {"contact", "deform", "partition", "maps"}) {
    if (!fs::exists(kRoot / "src/palpate" / room)) continue;
    for (const Include& include : includesUnder(kRoot / "src/palpate" / room)) {
      for (const std::string_view banned : {"thread", "mutex", "condition_variable", "fstream", "cstdio"}) {
        EXPECT_NE(include.target, banned) << include.file;
      }
    }
  }
}
