// What an embedding program includes to draw: no header of OpenGL or of a window comes with it, and nothing internal.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "support/places.h"

namespace palpate::view {
namespace {

namespace fs = std::filesystem;

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The names in angle brackets or quotes after #include, of this file and of all of ours that it includes.
void collectIncludes(const fs::path& file, std::set<std::string>& names) {
  std::istringstream lines(contentsOf(file));
  const std::string_view word = "#include ";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(word)) continue;
    const std::string name = line.substr(word.size() + 1, line.find_first_of(">\"", word.size() + 1) - word.size() - 1);
    if (!names.insert(name).second || !name.starts_with("palpate/")) continue;
    for (const char* house : {"core", "host", "view"}) {
      const fs::path header = support::sourceFolder() / "engine" / house / name;
      if (fs::exists(header)) collectIncludes(header, names);
    }
  }
}

class PublicHeaders : public testing::TestWithParam<std::string> {};

TEST_P(PublicHeaders, BringNoOpenGlAndNothingInternal) {
  const fs::path folder = support::sourceFolder() / "engine/view/palpate" / GetParam();
  std::size_t headers = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".h") continue;
    ++headers;
    std::set<std::string> names;
    collectIncludes(entry.path(), names);
    for (const std::string& name : names) {
      for (const std::string_view unwanted :
           {"epoxy/", "imgui", "GLFW/", "fmt/", "toml++/", "palpate/view/layers/", "palpate/view/overlays/"}) {
        EXPECT_FALSE(name.starts_with(unwanted)) << entry.path().filename() << " includes " << name;
      }
    }
  }
  EXPECT_GE(headers, 5u);
}

INSTANTIATE_TEST_SUITE_P(Rooms, PublicHeaders, testing::Values("view", "window"));

}  // namespace
}  // namespace palpate::view
