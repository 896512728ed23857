// The documents stay true to the tree: every relative link leads somewhere, docs/README.md reaches every page, and the
// README stays short.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/places.h"

namespace {

namespace fs = std::filesystem;

const fs::path kRepository = palpate::support::sourceFolder();
constexpr std::size_t kMaxReadmeLinks = 12;

struct Link {
  std::string target;  // without its anchor; empty for a link into its own page
  bool is_image = false;
};

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// `page` without its fenced blocks: what stands in them is code.
std::string proseOf(const std::string& page) {
  std::istringstream lines(page);
  std::string prose;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start != std::string::npos && line.compare(start, 3, "```") == 0) {
      inside = !inside;
    } else if (!inside) {
      prose += line + '\n';
    }
  }
  return prose;
}

/// Every [text](target#anchor) and ![text](target) of `page`. A badge, a link round an image, counts as an image.
std::vector<Link> linksOf(const std::string& page) {
  const std::string prose = proseOf(page);
  std::vector<Link> links;
  for (std::size_t at = prose.find("]("); at != std::string::npos; at = prose.find("](", at + 2)) {
    const std::size_t open = prose.rfind('[', at);
    const std::size_t close = prose.find(')', at);
    if (open == std::string::npos || close == std::string::npos) continue;
    const std::string target = prose.substr(at + 2, close - at - 2);
    if (target.find_first_of(" \n") != std::string::npos) continue;
    links.push_back({target.substr(0, target.find('#')), open > 0 && prose[open - 1] == '!'});
  }
  return links;
}

std::vector<fs::path> pagesUnder(const fs::path& folder) {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  return pages;
}

std::vector<fs::path> allPages() {
  std::vector<fs::path> pages = pagesUnder(kRepository / "docs");
  for (const auto& entry : fs::directory_iterator(kRepository)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  return pages;
}

bool isElsewhere(const std::string& target) {
  return target.starts_with("http:") || target.starts_with("https:") || target.starts_with("mailto:");
}

/// The relative links of `page` that lead nowhere.
std::vector<std::string> brokenLinks(const fs::path& folder, const std::string& page) {
  std::vector<std::string> broken;
  for (const Link& link : linksOf(page)) {
    if (link.target.empty() || isElsewhere(link.target) || fs::exists(folder / link.target)) continue;
    broken.push_back(link.target);
  }
  return broken;
}

std::size_t textLinks(const std::string& page) {
  const std::vector<Link> links = linksOf(page);
  return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [](const Link& link) { return !link.is_image; }));
}

/// The folders that programs of tests are named after: <house>/tests/FOLDER, and tests/FOLDER
/// (cmake/PalpateTests.cmake).
std::set<std::string> testPrograms() {
  std::set<std::string> programs;
  const auto add_those_of = [&](const fs::path& tests) {
    if (!fs::is_directory(tests)) return;
    for (const auto& folder : fs::directory_iterator(tests))
      programs.insert("test_" + folder.path().filename().string());
  };
  add_those_of(kRepository / "tests");
  for (const char* place : {"engine", "instruments", "instruments/study"}) {
    for (const auto& house : fs::directory_iterator(kRepository / place)) add_those_of(house.path() / "tests");
  }
  return programs;
}

/// The programs of tests that a page names and nobody builds.
std::set<std::string> unknownTestPrograms(const std::string& page) {
  static const std::set<std::string> known = testPrograms();
  static const std::regex quoted("`test_[a-z_]+");
  std::set<std::string> unknown;
  for (std::sregex_iterator at(page.begin(), page.end(), quoted), end; at != end; ++at) {
    const std::string name = at->str().substr(1);
    if (!known.contains(name)) unknown.insert(name);
  }
  return unknown;
}

}  // namespace

TEST(Docs, EveryTestProgramThatIsNamedIsBuilt) {
  EXPECT_EQ(unknownTestPrograms("`test_apps --gtest_filter=Map*` and `test_house`"),
            std::set<std::string>{"test_apps"});
  for (const fs::path& page : allPages()) {
    for (const std::string& name : unknownTestPrograms(textOf(page))) ADD_FAILURE() << page << " names " << name;
  }
}

TEST(Docs, EveryRelativeLinkLeadsSomewhere) {
  const std::vector<fs::path> pages = allPages();
  ASSERT_GE(pages.size(), 50u);
  for (const fs::path& page : pages) {
    for (const std::string& target : brokenLinks(page.parent_path(), textOf(page)))
      ADD_FAILURE() << page << " links to " << target;
  }
}

TEST(Docs, EveryPageIsOfOneKindAndOnTheMap) {
  const fs::path docs = kRepository / "docs";
  std::set<fs::path> linked;
  for (const Link& link : linksOf(textOf(docs / "README.md"))) linked.insert((docs / link.target).lexically_normal());
  const std::set<std::string> kinds = {"tutorials", "howto", "reference", "explanation"};
  for (const fs::path& page : pagesUnder(docs)) {
    if (page == docs / "README.md") continue;
    EXPECT_TRUE(kinds.contains(page.parent_path().filename().string())) << page << " is in none of the four folders";
    EXPECT_TRUE(linked.contains(page.lexically_normal())) << page << " is not linked from docs/README.md";
  }
}

TEST(Docs, TheReadmeHasAtMostTwelveLinks) {
  const std::size_t links = textLinks(textOf(kRepository / "README.md"));
  EXPECT_GE(links, 1u);
  EXPECT_LE(links, kMaxReadmeLinks) << "link pages from docs/README.md instead";
}

TEST(Docs, BrokenAndSurplusLinksAreSeen) {
  const std::string page =
      "[a](README.md#top) ![b](no/picture.png) [c](nowhere.md) [d](https://example.org) [e](#here)\n"
      "```\n[f](code.md)\n```\n";
  EXPECT_EQ(brokenLinks(kRepository, page), (std::vector<std::string>{"no/picture.png", "nowhere.md"}));
  EXPECT_EQ(textLinks(page), 4u);
}
