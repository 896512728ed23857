// A catalogue as msgfmt writes it, made here byte by byte: nothing of gettext's tools is needed to read one.
#include "palpate/base/language.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "support/temporary_folder.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

void append(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((word >> shift) & 0xff);
}

/// Little-endian, sorted, without a table of hashes (GNU gettext manual, "The Format of GNU MO Files").
std::string catalogueOf(const std::map<std::string, std::string>& texts) {
  constexpr std::uint32_t kHeader = 28;
  const auto count = static_cast<std::uint32_t>(texts.size());
  std::string bytes;
  for (const std::uint32_t word : {0x950412deu, 0u, count, kHeader, kHeader + 8 * count, 0u, 0u}) append(bytes, word);
  std::string all;
  const std::uint32_t start = kHeader + 16 * count;
  const auto describe = [&](const std::string& text) {
    append(bytes, static_cast<std::uint32_t>(text.size()));
    append(bytes, start + static_cast<std::uint32_t>(all.size()));
    all += text + '\0';
  };
  for (const auto& [english, translated] : texts) describe(english);
  for (const auto& [english, translated] : texts) describe(translated);
  return bytes + all;
}

class LanguageTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_.path() / "de/LC_MESSAGES");
    std::ofstream(folder_ / "de/LC_MESSAGES/palpate.mo", std::ios::binary)
        << catalogueOf({{"", "Content-Type: text/plain; charset=UTF-8\nPlural-Forms: nplurals=2; plural=n != 1;\n"},
                        {"Open",
                         "\xc3\x96"
                         "ffnen"},
                        {"force {:.2f} N at {}", "an {1} {0:.2f} N Kraft"},
                        {"depth {:.1f} mm", "{:d} mm tief"},
                        {std::string("one place\0{} places", 19), std::string("eine Stelle\0{} Stellen", 22)}});
  }
  void TearDown() override { useLanguage("en", folder_.path()); }
  const support::TemporaryFolder folder_;
};

TEST_F(LanguageTest, ShowsTheCodesOwnWordsInEnglish) {
  useLanguage("en", folder_.path());
  EXPECT_STREQ(tr("Open"), "Open");
  EXPECT_EQ(trf("force {:.2f} N at {}", 0.5, "T6"), "force 0.50 N at T6");
  EXPECT_STREQ(trn("one place", "{} places", 2), "{} places");
}

TEST_F(LanguageTest, TakesWordsFromTheCatalogueAndWritesTheDecimalComma) {
  useLanguage("de", folder_.path());
  EXPECT_STREQ(tr("Open"),
               "\xc3\x96"
               "ffnen");
  EXPECT_EQ(trf("force {:.2f} N at {}", 0.5, "T6"), "an T6 0,50 N Kraft");
  EXPECT_STREQ(trn("one place", "{} places", 1), "eine Stelle");
  EXPECT_EQ(trnf("one place", "{} places", 0, 0), "0 Stellen");
}

TEST_F(LanguageTest, StaysEnglishWhereTheCatalogueHasNothing) {
  useLanguage("de", folder_.path());
  EXPECT_STREQ(tr("Save"), "Save");
  EXPECT_STREQ(tr(""), "") << "not the catalogue's header";
  useLanguage("es", folder_.path());
  EXPECT_STREQ(tr("Open"), "Open") << "no catalogue at all";
}

TEST_F(LanguageTest, FallsBackToEnglishWhereATranslationDoesNotFitItsValues) {
  useLanguage("de", folder_.path());
  EXPECT_EQ(trf("depth {:.1f} mm", 6.0), "depth 6,0 mm") << "{:d} takes no fraction";
}

TEST_F(LanguageTest, RefusesALanguageWithoutACatalogueAndNamesTheOthers) {
  try {
    useLanguage("xx", folder_.path());
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("de"), std::string::npos) << error.what();
  }
}

TEST_F(LanguageTest, FollowsTheSystemWhereNoneIsAskedFor) {
  setenv("LANGUAGE", "fr:de_AT.UTF-8", 1);
  useLanguage("", folder_.path());
  EXPECT_EQ(language().code, "de");
  setenv("LANGUAGE", "", 1);
  setenv("LC_ALL", "es_ES.UTF-8", 1);
  useLanguage("", folder_.path());
  EXPECT_EQ(language().code, "es");
  unsetenv("LC_ALL");
}

}  // namespace
}  // namespace palpate
