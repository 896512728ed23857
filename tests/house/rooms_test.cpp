// The rooms of ARCHITECTURE.md are one-way: a room of core and host includes only itself and rooms above it, and core
// includes nothing of a system. What houses may include of each other is counted by tools/house (plan_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "support/places.h"

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = palpate::support::sourceFolder();
const std::vector<std::string> kHouses = {"engine/core",
                                          "engine/host",
                                          "engine/view",
                                          "engine/cli",
                                          "instruments/report",
                                          "instruments/measure",
                                          "instruments/teach",
                                          "instruments/class",
                                          "instruments/study/dissertation",
                                          "instruments/study/solve",
                                          "instruments/study/lab"};

std::vector<std::string> linesOf(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Rows of the table of ARCHITECTURE.md whose header starts with `header`, cell by cell.
std::vector<std::vector<std::string>> tableOf(const std::string& header) {
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (const std::string& line : linesOf(kRoot / "ARCHITECTURE.md")) {
    if (line.starts_with(header)) {
      inside = true;
    } else if (inside && line.empty()) {
      break;
    } else if (inside && line.starts_with("| ")) {
      std::vector<std::string> cells;
      for (std::size_t at = 1; at < line.size();) {
        const std::size_t end = line.find('|', at);
        cells.push_back(line.substr(at, end - at));
        at = end + 1;
      }
      rows.push_back(cells);
    }
  }
  return rows;
}

std::vector<std::string> quotedIn(const std::string& cell) {
  std::vector<std::string> words;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator match(cell.begin(), cell.end(), quoted), end; match != end; ++match)
    words.push_back((*match)[1]);
  return words;
}

/// The rooms of core and host, in the order of the table.
std::vector<std::string> roomsInOrder() {
  std::vector<std::string> rooms;
  for (const auto& row : tableOf("| room | owns |")) rooms.push_back(quotedIn(row[0]).at(0));
  return rooms;
}

struct Include {
  fs::path file;  ///< relative to the root
  std::string target;
};

std::vector<Include> includesUnder(const fs::path& folder) {
  std::vector<Include> includes;
  const std::regex directive(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    for (const std::string& line : linesOf(entry.path())) {
      std::smatch match;
      if (std::regex_match(line, match, directive)) includes.push_back({fs::relative(entry.path(), kRoot), match[1]});
    }
  }
  return includes;
}

/// "mesh" of "palpate/mesh/files/load.h"; empty for what is not a library's.
std::string roomName(const std::string& target) {
  if (!target.starts_with("palpate/")) return {};
  return target.substr(8, target.find('/', 8) - 8);
}

/// The place of a room in the table; one past the end for a room of another house.
std::ptrdiff_t rankOf(const std::string& room) {
  static const std::vector<std::string> rooms = roomsInOrder();
  return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
}

/// Looks at every include of `folder`, a room's sources or tests; how many were of a room.
std::size_t expectOnlyRoomsUpTo(const std::string& room, const fs::path& folder) {
  std::size_t looked_at = 0;
  for (const Include& include : includesUnder(folder)) {
    const std::string to = roomName(include.target);
    if (to.empty()) continue;
    EXPECT_LE(rankOf(to), rankOf(room)) << include.file << " includes " << include.target << ", below " << room;
    ++looked_at;
  }
  return looked_at;
}

}  // namespace

TEST(Rooms, EveryFolderIsInTheTable) {
  const auto rooms = roomsInOrder();
  ASSERT_GE(rooms.size(), 14u);
  for (const char* house : {"engine/core/palpate", "engine/host/palpate"}) {
    for (const auto& entry : fs::directory_iterator(kRoot / house)) {
      EXPECT_LT(rankOf(entry.path().filename()), std::ssize(rooms)) << entry.path() << " is not in ARCHITECTURE.md";
    }
  }
  for (const std::string& room : rooms) EXPECT_TRUE(fs::is_directory(kRoot / "engine/core/palpate" / room)) << room;
}

TEST(Rooms, IncludeOnlyRoomsAbove) {
  std::size_t looked_at = 0;
  for (const char* house : {"engine/core/palpate", "engine/host/palpate"}) {
    for (const auto& entry : fs::directory_iterator(kRoot / house)) {
      looked_at += expectOnlyRoomsUpTo(entry.path().filename(), fs::relative(entry.path(), kRoot));
    }
  }
  EXPECT_GT(looked_at, 500u);
}

TEST(Rooms, TestsOfARoomKnowNoRoomBelowIt) {
  std::size_t looked_at = 0;
  for (const char* house : {"engine/core/tests", "engine/host/tests"}) {
    for (const std::string& room : roomsInOrder()) {
      const fs::path folder = fs::path(house) / room;
      if (fs::is_directory(kRoot / folder)) looked_at += expectOnlyRoomsUpTo(room, folder);
    }
  }
  EXPECT_GT(looked_at, 200u);
}

TEST(Rooms, TheCoreNeedsNothingOfASystem) {
  std::size_t looked_at = 0;
  for (const Include& include : includesUnder("engine/core/palpate")) {
    for (const std::string_view banned :
         {"thread", "future", "condition_variable", "fstream", "iostream", "cstdio", "sqlite3.h", "unistd.h", "fcntl.h",
          "sys/", "boost/", "assimp/", "toml++/", "nlohmann/", "openssl/", "zlib.h", "CLI/", "opencv2/"}) {
      const bool folder = banned.back() == '/';
      EXPECT_FALSE(folder ? include.target.starts_with(banned) : include.target == banned)
          << include.file << " includes " << include.target;
    }
    ++looked_at;
  }
  EXPECT_GT(looked_at, 1000u);
}

TEST(Rooms, OnlyWhatDrawsKnowsGraphics) {
  for (const std::string& house : kHouses) {
    const bool draws = house == "engine/view" || house == "instruments/measure" || house == "instruments/teach" ||
                       house == "instruments/class" || house == "instruments/study/lab";
    for (const Include& include : includesUnder(house)) {
      const std::string file = include.file.string();
      if (file.find("/tests/") != std::string::npos) continue;
      const bool library = file.starts_with(house + "/palpate/");
      for (const std::string_view graphics : {"GL/", "GLFW/", "epoxy/", "imgui"}) {
        if (draws && !(library && house != "engine/view")) continue;
        EXPECT_FALSE(include.target.starts_with(graphics)) << file << " includes " << include.target;
      }
    }
  }
}

/// The templates of these are slow to compile: the rest of the product sees a header without them.
TEST(Rooms, OneFileIncludesEachParserOfTemplates) {
  std::map<std::string, std::vector<std::string>> files;
  for (const std::string& house : kHouses) {
    for (const Include& include : includesUnder(house)) {
      for (const std::string parser : {"CLI/", "toml++/"}) {
        if (include.target.starts_with(parser)) files[parser].push_back(include.file.string());
      }
    }
  }
  EXPECT_EQ(files["CLI/"], std::vector<std::string>{"engine/cli/kit/options.cpp"});
  EXPECT_EQ(files["toml++/"], std::vector<std::string>{"engine/host/palpate/scene/toml_node.cpp"});
}

TEST(Rooms, PlainRoomsNeedNoLockEither) {
  for (const std::string room : {"tree", "contact", "hdb", "deform", "maps"}) {
    for (const Include& include : includesUnder("engine/core/palpate/" + room)) {
      for (const std::string_view banned : {"mutex", "atomic"}) EXPECT_NE(include.target, banned) << include.file;
    }
  }
}
