// docs/reference/dissertation.md stays true: it explains every erratum, counts them as the engine does, and names no
// file that is not there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "palpate/base/text.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/words.h"
#include "support/places.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = support::sourceFolder();

std::string page() { return readFile(kRoot / "docs/reference/dissertation.md", 1 << 20); }

}  // namespace

TEST(DissertationPage, SaysHowManyErrataAreCorrectedByDefaultAndWhichAreNot) {
  const auto listed = [](scene::ByDefault by_default) {
    std::string list;
    for (const Erratum erratum : scene::errataByDefault(by_default)) list += ", " + scene::nameOf(erratum);
    return list.substr(2);
  };
  const auto corrected = scene::errataByDefault(scene::ByDefault::corrected).size();
  const std::string count = fmt::format("{} of the {} errata are corrected by default", corrected, kErrata);
  EXPECT_NE(page().find(count), std::string::npos) << count;
  for (const scene::ByDefault other : {scene::ByDefault::as_printed, scene::ByDefault::own_choice}) {
    const std::string row = fmt::format("{} ({})", wordFor(other), listed(other));
    EXPECT_NE(page().find(row), std::string::npos) << row;
    for (const Erratum erratum : scene::errataByDefault(other)) {
      const std::string told = fmt::format("\n| {} | {} |", scene::nameOf(erratum), wordFor(other));
      EXPECT_NE(page().find(told), std::string::npos) << "whose default it is and why: " << told;
    }
  }
  const std::string readme = readFile(kRoot / "README.md", 1 << 20);
  const std::string said = fmt::format("{} of {} checked errata corrected by default", corrected, kErrata);
  EXPECT_NE(readme.find(said), std::string::npos) << said;
}

TEST(DissertationPage, ExplainsEveryErratumInItsSection) {
  const std::string text = page();
  const std::string sections = text.substr(0, text.find("## Errata"));
  for (int erratum = 1; erratum <= kErrata; ++erratum) {
    EXPECT_TRUE(std::regex_search(sections, std::regex(fmt::format("E{}[^0-9]", erratum)))) << "E" << erratum;
  }
}

TEST(DissertationPage, NamesOnlyFilesThatExist) {
  const std::string text = page();
  const std::regex path("`((?:engine|instruments|examples|tests|docs|tools)/[a-z0-9_./]+)`");
  int named = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), path), end; match != end; ++match) {
    ++named;
    EXPECT_TRUE(fs::exists(kRoot / std::string((*match)[1]))) << (*match)[1];
  }
  EXPECT_GT(named, 40);
}

TEST(DissertationPage, ShowsFiguresThatTogetherStaySmall) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "docs/images/dissertation")) bytes += entry.file_size();
  EXPECT_GT(bytes, 100'000u);
  EXPECT_LT(bytes, 1'200'000u);
}

}  // namespace palpate
