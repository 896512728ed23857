// One force with every compiler, processor and system (tools/check-platforms compares them): what would make a result
// depend on the C library, or on the order in which a compiler makes arguments, does not stand in the engine.
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

using Lines = std::vector<std::string>;

/// C++ sources below a folder of the tree, those of tests apart.
std::vector<fs::path> sourcesBelow(const char* folder) {
  std::vector<fs::path> sources;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(support::sourceFolder() / folder)) {
    const bool is_source = entry.path().extension() == ".cpp" || entry.path().extension() == ".h";
    if (is_source && entry.path().string().find("/tests/") == std::string::npos) sources.push_back(entry.path());
  }
  return sources;
}

/// Of a text without its comments, whose lines stay.
std::string stripComments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

std::string placeOf(const fs::path& file, const std::string& code, std::size_t at) {
  const auto line = 1 + std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return file.lexically_relative(support::sourceFolder()).string() + ":" + std::to_string(line);
}

/// Functions whose last bit is the C library's choice. sqrt, fmod and what rounds are exact.
constexpr const char* kInexact =
    "a?(?:cos|sin|tan)h?|atan2|sincos|cbrt|hypot|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|erfc?|[lt]gamma";

/// A call's arguments, split at its own commas: from the bracket at `open` on.
Lines argumentsFrom(const std::string& code, std::size_t open) {
  Lines arguments(1);
  int depth = 1;
  for (std::size_t i = open + 1; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && --depth == 0) break;
    if (c == ',' && depth == 1) {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  return arguments;
}

/// Calls in round brackets more than one of whose arguments draws a random number.
Lines doubleDrawsIn(const std::string& text, const fs::path& file) {
  const std::string code = stripComments(text);
  if (code.find("random") == std::string::npos) return {};
  const std::regex draws(R"(random_?\.normal\d?\(|\.(uniform|below|bits)\d?\(|\w\(\s*\w*random_?\s*[,)])");
  Lines found;
  for (std::size_t open = code.find('('); open != std::string::npos; open = code.find('(', open + 1)) {
    const bool is_call = open > 0 && code[open - 1] != ' ';  // "for (" is none
    const Lines arguments = is_call ? argumentsFrom(code, open) : Lines();
    const auto drawing = std::count_if(arguments.begin(), arguments.end(),
                                       [&](const std::string& argument) { return std::regex_search(argument, draws); });
    if (drawing > 1) found.push_back(placeOf(file, code, open));
  }
  return found;
}

TEST(OneForce, TheEngineTakesNoInexactFunctionOfTheCLibrary) {
  const std::regex call("std::(?:" + std::string(kInexact) + ")f?\\(");
  Lines found;
  for (const char* house : {"engine/core/palpate", "engine/host/palpate"}) {
    for (const fs::path& file : sourcesBelow(house)) {
      const std::string code = stripComments(support::contentOf(file));
      for (std::sregex_iterator it(code.begin(), code.end(), call); it != std::sregex_iterator(); ++it) {
        found.push_back(placeOf(file, code, static_cast<std::size_t>(it->position())));
      }
    }
  }
  EXPECT_EQ(found, Lines()) << "palpate::elementary has the same bits everywhere";
}

// Eigen's functions and builtins of the compiler end there, too.
TEST(OneForce, TheCoreLinksNoInexactFunctionOfTheCLibrary) {
  const auto symbols =
      support::runProgram("/usr/bin/nm", "-u " + (support::buildFolder() / "engine/core/libpalpate_core.a").string());
  ASSERT_EQ(symbols.exit_code, 0) << symbols.err;
  ASSERT_NE(symbols.out.find(" U fmod\n"), std::string::npos) << "it looks at something";
  const std::regex inexact("U (?:" + std::string(kInexact) + ")f?\n");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(symbols.out, found, inexact)) << found.str();
}

// Dense systems are solved by base/dense_solve.h: Eigen's blocks follow the processor's caches.
TEST(OneForce, TheCoreFactorsNothingInBlocks) {
  const std::regex blocked(
      R"((partial|full)PivLu\(|(?:PartialPiv|FullPiv)LU<|\.(householderQr|colPivHouseholderQr|llt)\()");
  Lines found;
  for (const fs::path& file : sourcesBelow("engine/core/palpate")) {
    const std::string code = stripComments(support::contentOf(file));
    std::smatch match;
    if (std::regex_search(code, match, blocked)) found.push_back(file.filename().string() + ": " + match.str());
  }
  EXPECT_EQ(found, Lines());
}

// Arguments are made in the order that the compiler likes: GCC's last first on x86-64, Clang's first first. Braces have
// an order, and Random::normal3 and its like.
TEST(OneForce, NoCallDrawsTwiceAmongItsArguments) {
  EXPECT_EQ(doubleDrawsIn("\nf(random.normal(), 2 * random.uniform(0, 1));", "file.cpp").size(), 1u);
  EXPECT_EQ(doubleDrawsIn("Vec2(drawn(random), drawn(random))", "file.cpp").size(), 1u);
  EXPECT_EQ(
      doubleDrawsIn(
          "Vec3{random.normal(), random.normal(), 0}; f(random, 1); for (x = random.below(2), y = random.below(3);;)",
          "file.cpp"),
      Lines());
  Lines found;
  for (const char* house :
       {"engine/core", "engine/host", "engine/view", "engine/cli", "instruments/measure", "instruments/teach",
        "instruments/class", "instruments/study/solve", "instruments/study/lab", "instruments/study/dissertation"}) {
    for (const fs::path& file : sourcesBelow(house)) {
      for (std::string& place : doubleDrawsIn(support::contentOf(file), file)) found.push_back(std::move(place));
    }
  }
  EXPECT_EQ(found, Lines());
}

}  // namespace
}  // namespace palpate
