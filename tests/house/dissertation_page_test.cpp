// docs/dissertation.md stays true: it has every erratum as the engine has it, and names no file that is not there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "palpate/base/text.h"
#include "palpate/scene/errata.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PALPATE_SOURCE_DIR;

std::string page() { return readFile(kRoot / "docs/dissertation.md", 1 << 20); }

std::string codeOf(std::string_view choice, scene::LiteralForm form) {
  switch (form) {
    case scene::LiteralForm::switchable:
      return fmt::format("fidelity: {}", choice);
    case scene::LiteralForm::setting:
      return fmt::format("`{}`", choice);
    case scene::LiteralForm::none:
      return fmt::format("none: {}", choice);
  }
  return "";
}

}  // namespace

TEST(DissertationPage, HasEveryErratumAsTheEngineHasIt) {
  const std::string text = page();
  ASSERT_EQ(scene::errata().size(), static_cast<std::size_t>(kErrata));
  for (const scene::ErratumText& erratum : scene::errata()) {
    const std::string row = fmt::format("| {} | {} | {} | {} |\n", scene::nameOf(erratum.erratum), erratum.printed,
                                        erratum.ours, codeOf(erratum.choice, erratum.form));
    EXPECT_NE(text.find(row), std::string::npos) << "docs/dissertation.md, table of errata, should have the row\n"
                                                 << row;
  }
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
  const std::regex path("`((?:src|study|figures|bench|apps|tests|docs|tools)/[a-z0-9_./]+)`");
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
