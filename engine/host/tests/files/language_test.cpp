// A catalogue as msgfmt writes it, made here byte by byte: nothing of gettext's tools is needed to read one.
#include "palpate/base/language.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
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

/// The language for these variables; those that are not given are not set.
std::string languageFor(const std::map<std::string, std::string>& variables, const fs::path& folder) {
  const auto set = [](const std::string& name, const char* value) {
    value == nullptr ? unsetenv(name.c_str()) : setenv(name.c_str(), value, 1);
  };
  std::map<std::string, std::optional<std::string>> before;
  for (const std::string name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(name.c_str());
    if (value != nullptr) before[name] = value;
    const auto given = variables.find(name);
    set(name, given == variables.end() ? nullptr : given->second.c_str());
  }
  useLanguage("", folder);
  for (const std::string name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) {
    set(name, before[name] ? before[name]->c_str() : nullptr);
  }
  return std::string(language().code);
}

TEST_F(LanguageTest, FollowsTheSystemByTheRulesOfGettext) {
  const auto chosen = [this](const std::map<std::string, std::string>& variables) {
    return languageFor(variables, folder_.path());
  };
  EXPECT_EQ(chosen({}), "en");
  EXPECT_EQ(chosen({{"LANG", "de_AT.UTF-8"}}), "de");
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LC_MESSAGES", "es_ES@euro"}}), "es");
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LC_MESSAGES", ""}}), "de") << "empty is not set";
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LC_ALL", "es_ES.UTF-8"}}), "es");
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LC_ALL", "C"}}), "en");
  EXPECT_EQ(chosen({{"LANG", "en_GB"}, {"LANGUAGE", "fr:de_AT.UTF-8"}}), "de") << "the first that there is";
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LANGUAGE", ""}}), "de");
  EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LANGUAGE", "fr"}}), "en") << "LANGUAGE stands for the locale";
  EXPECT_EQ(chosen({{"LANG", "es_ES"}, {"LANGUAGE", "C:de"}}), "en") << "C ends the list";
  for (const char* c : {"C", "POSIX"}) {
    EXPECT_EQ(chosen({{"LANG", "de_DE"}, {"LC_ALL", c}, {"LANGUAGE", "de"}}), "en") << "LANGUAGE is nothing in " << c;
  }
  EXPECT_EQ(chosen({{"LANGUAGE", "de"}}), "en") << "without a locale it is C";
  EXPECT_EQ(chosen({{"LANG", "C.UTF-8"}, {"LANGUAGE", "de"}}), "de");
  EXPECT_EQ(chosen({{"LANG", "C.UTF-8"}}), "en");
}

}  // namespace
}  // namespace palpate
