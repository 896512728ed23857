// The house of ARCHITECTURE.md is one-way: an engine room includes only itself and rooms above it in the first table,
// an outer folder only what the second table allows it. Every #include of the repository is looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PALPATE_SOURCE_DIR;
const std::string kEngine = "src/palpate/";
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

/// The engine's rooms, in the order of the table.
std::vector<std::string> roomsInOrder() {
  std::vector<std::string> rooms;
  for (const auto& row : tableOf("| room (`src/palpate/<room>`)")) rooms.push_back(quotedIn(row[0]).at(0));
  return rooms;
}

/// Outer folder -> what it may include: outer folders, or "engine" for every room.
std::map<std::string, std::set<std::string>> outerFolders() {
  std::map<std::string, std::set<std::string>> allowed;
  for (const auto& row : tableOf("| outside the engine |")) {
    const auto uses = quotedIn(row[2]);
    allowed[quotedIn(row[0]).at(0)] = {uses.begin(), uses.end()};
  }
  return allowed;
}

/// The folders of the root that these lie in.
std::set<std::string> outerRoots() {
  std::set<std::string> roots;
  for (const auto& [folder, uses] : outerFolders()) roots.insert(folder.substr(0, folder.find('/')));
  return roots;
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

/// "mesh" of "palpate/mesh/files/load.h"; empty for what is not the engine's.
std::string roomOf(const std::string& target) {
  if (!target.starts_with("palpate/")) return {};
  return target.substr(8, target.find('/', 8) - 8);
}

/// The folder of the outer table that a path lies in: the longest that fits.
std::string outerFolderOf(const std::string& path) {
  std::string best;
  for (const auto& [folder, uses] : outerFolders()) {
    if (path.starts_with(folder + "/") && folder.size() > best.size()) best = folder;
  }
  return best;
}

}  // namespace

TEST(Rooms, EveryFolderIsInTheTable) {
  const auto rooms = roomsInOrder();
  ASSERT_GE(rooms.size(), 14u);
  for (const auto& entry : fs::directory_iterator(kRoot / "src/palpate")) {
    EXPECT_TRUE(std::find(rooms.begin(), rooms.end(), entry.path().filename()) != rooms.end())
        << entry.path() << " is not in the table of ARCHITECTURE.md";
  }
  for (const std::string& room : rooms) EXPECT_TRUE(fs::is_directory(kRoot / "src/palpate" / room)) << room;
  for (const auto& [folder, uses] : outerFolders()) EXPECT_TRUE(fs::is_directory(kRoot / folder)) << folder;
}

TEST(Rooms, IncludeOnlyRoomsAbove) {
  const auto rooms = roomsInOrder();
  const auto rank = [&](const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
  };
  const auto outer_roots = outerRoots();
  std::size_t looked_at = 0;
  for (const Include& include : includesUnder("src")) {
    for (const std::string& outer : outer_roots) {
      EXPECT_FALSE(include.target.starts_with(outer + "/")) << include.file << " includes " << include.target;
    }
    const std::string to = roomOf(include.target);
    if (to.empty()) continue;
    const std::string from = roomOf(fs::relative(include.file, "src").string());
    EXPECT_LE(rank(to), rank(from)) << include.file << " includes " << include.target << ", a room below it";
    ++looked_at;
  }
  EXPECT_GT(looked_at, 500u);
}

TEST(Rooms, TestsOfARoomKnowNoRoomBelowIt) {
  const auto rooms = roomsInOrder();
  const auto rank = [&](const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
  };
  std::size_t looked_at = 0;
  for (const std::string& room : rooms) {
    if (!fs::is_directory(kRoot / "tests" / room)) continue;
    for (const Include& include : includesUnder("tests/" + room)) {
      const std::string to = roomOf(include.target);
      if (to.empty()) continue;
      EXPECT_LE(rank(to), rank(room)) << include.file << " includes " << include.target << ", a room below " << room;
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 200u);
}

TEST(Rooms, TheOuterHouseIncludesOnlyWhatTheTableAllows) {
  const auto allowed = outerFolders();
  ASSERT_GE(allowed.size(), 8u);
  std::size_t looked_at = 0;
  for (const std::string& root : outerRoots()) {
    for (const Include& include : includesUnder(root)) {
      const std::string from = outerFolderOf(include.file.string());
      ASSERT_FALSE(from.empty()) << include.file << " lies in no folder of the table";
      const std::string to = roomOf(include.target).empty() ? outerFolderOf(include.target) : "engine";
      if (to.empty() || to == from) continue;  // a library of a stranger, or its own folder
      EXPECT_TRUE(allowed.at(from).contains(to)) << include.file << " includes " << include.target;
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 500u);
}

TEST(Rooms, OnlyViewAndWindowKnowGraphicsAndNobodyInTheEngineKnowsTheCommandLine) {
  for (const Include& include : includesUnder("src/palpate")) {
    const std::string room = roomOf(include.file.string().substr(4));
    for (const std::string_view banned : {"GL/", "GLFW/", "epoxy/", "imgui", "CLI/", "nlohmann/", "iostream"}) {
      if ((room == "view" || room == "window") && banned != "CLI/" && banned != "nlohmann/") continue;
      if ((room == "training" || room == "classroom") && banned == "nlohmann/") continue;  // rows and messages are JSON
      if (include.file.filename() == "haply_message.cpp" && banned == "nlohmann/") continue;  // a service speaks JSON
      EXPECT_NE(include.target.substr(0, banned.size()), banned) << include.file << " includes " << include.target;
    }
  }
}

TEST(Rooms, PlainRoomsNeedNoThreadAndNoFile) {
  for (const std::string room : {"tree", "contact", "hdb", "deform", "maps"}) {
    for (const Include& include : includesUnder(kEngine + room)) {
      for (const std::string_view banned : {"thread", "mutex", "condition_variable", "future", "fstream", "cstdio"}) {
        EXPECT_NE(include.target, banned) << include.file;
      }
    }
  }
}

TEST(Rooms, AFolderIsAHallOfAtMostFortyFiles) {
  std::map<fs::path, int> files;
  for (const std::string& root : {std::string("src"), std::string("lab"), std::string("bench"), std::string("figures"),
                                  std::string("study"), std::string("apps")}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / root)) {
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") ++files[entry.path().parent_path()];
    }
  }
  ASSERT_GT(files.size(), 20u);
  for (const auto& [folder, count] : files) EXPECT_LE(count, 40) << folder;
}
