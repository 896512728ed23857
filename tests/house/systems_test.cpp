// Windows, Linux on every processor, macOS: what differs between them stands in one room,
// engine/host/palpate/base/system, and a text becomes the name of a file in one way, or Windows would read it in the
// code page of its user.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

using Places = std::vector<std::string>;

/// What is built for other systems, too (the presets arm64 and win64).
constexpr const char* kEverywhere[] = {"engine/core/palpate",  "engine/host/palpate", "engine/view",
                                       "engine/cli/devices",   "engine/cli/kit",      "engine/cli/model",
                                       "engine/cli/recording", "engine/cli/render",   "engine/cli/run",
                                       "engine/cli/serve",     "engine/cli/simulate", "engine/bindings/c"};

/// Files of those whose names do not end as `but` says, with what matches in them.
Places matching(const std::regex& wanted, const std::regex& but) {
  Places found;
  for (const char* folder : kEverywhere) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(support::sourceFolder() / folder)) {
      const std::string name = entry.path().lexically_relative(support::sourceFolder()).string();
      const bool is_source = entry.path().extension() == ".cpp" || entry.path().extension() == ".h";
      if (!is_source || name.find("/tests/") != std::string::npos || std::regex_search(name, but)) continue;
      const std::string code = std::regex_replace(support::contentOf(entry.path()), std::regex("//[^\n]*"), "");
      for (std::sregex_iterator it(code.begin(), code.end(), wanted); it != std::sregex_iterator(); ++it) {
        found.push_back(name + ": " + it->str());
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Systems, OneRoomIncludesWhatOnlySomeSystemsHave) {
  const std::regex headers(
      R"(#include <(sys/|unistd|fcntl|pthread|sched\.|dlfcn|link\.|net/|netinet|ifaddrs|arpa/|poll\.|netdb|termios|c?signal|spawn|pwd\.|windows|winsock|io\.h))");
  EXPECT_FALSE(matching(headers, std::regex("^$")).empty()) << "it looks at something";
  EXPECT_EQ(matching(headers, std::regex("^engine/host/palpate/base/system/|_windows[.]cpp$")), Places());
}

TEST(Systems, OneRoomAsksForWhichSystemItIsCompiled) {
  // Besides: what the C interfaces and a maker's runtime call their functions, and the assembler's dialects.
  const std::regex besides(
      "^engine/host/palpate/base/system/|palpate_device[.]h$|openxr_api[.]h$|view/layers/embedded_file[.]h$|"
      "bindings/c/palpate[.]h$");
  EXPECT_EQ(matching(std::regex("_WIN32|__linux__|__APPLE__"), besides), Places());
}

TEST(Systems, ATextBecomesAPathByPathOf) {
  const std::regex made(R"((?:filesystem|fs)::path\((?!\)|"|std::wstring)[^)]*\))");
  EXPECT_EQ(matching(made, std::regex("^engine/host/palpate/base/system/|base/path_text[.]h$")), Places())
      << "base/path_text.h";
  const std::regex glued(R"([.]string\(\) \+ (?:"[.]|"-wal|std::string\(kPartial))");
  EXPECT_EQ(matching(glued, std::regex("^$")), Places()) << "withEnding of base/path_text.h";
}

TEST(Systems, TheEnvironmentIsReadInUtf8) {
  EXPECT_EQ(matching(std::regex("\\bgetenv\\("), std::regex("^engine/host/palpate/base/system/")), Places())
      << "system::variable";
}

}  // namespace
}  // namespace palpate
