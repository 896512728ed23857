#include "palpate/base/text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate {

TEST(ParseNumber, ReadsWholeTextOrNothing) {
  EXPECT_EQ(parseNumber(" 1.5e3 "), 1500.0);
  EXPECT_EQ(parseNumber("+2"), 2.0);
  EXPECT_FALSE(parseNumber("1.5mm"));
  EXPECT_FALSE(parseNumber("+-5"));
  EXPECT_FALSE(parseNumber("++5"));
  EXPECT_FALSE(parseNumber("+"));
  EXPECT_FALSE(parseNumber(""));
  EXPECT_TRUE(std::isnan(*parseNumber("nan")));
}

TEST(Split, KeepsEmptyFieldsAndTrims) {
  EXPECT_EQ(split("a, ,b ", ','), (std::vector<std::string_view>{"a", "", "b"}));
  EXPECT_EQ(split("", ',').size(), 1u);
}

TEST(ReadFile, NamesTheFileThatIsMissing) {
  EXPECT_EQ(support::thrownMessage([] { readFile("/nowhere/at-all.txt", 10); }), "/nowhere/at-all.txt: no such file");
}

TEST(WriteFile, IsReadBackAndNamesTheFileThatCannotBe) {
  const support::TemporaryFolder folder;
  const auto file = folder / "file.txt";
  writeFile(file, "one\ntwo");
  writeFile(file, "three");
  EXPECT_EQ(readFile(file, 100), "three");
  EXPECT_THROW(writeFile("/dev/null/at-all.txt", "x"), Error);
}

TEST(WellFormed, KeepsLettersAndMarksBytesThatAreOfNone) {
  const std::string mark = "\xef\xbf\xbd";
  const std::string good = "T6 \xc3\xa9 \xe2\x82\xac \xf0\x9f\x91\x8b";
  EXPECT_EQ(wellFormed(good), good);
  EXPECT_EQ(wellFormed("sz\xe9ne.toml"), "sz" + mark + "ne.toml");
  EXPECT_EQ(wellFormed("\xc0\xaf"), mark + mark) << "overlong";
  EXPECT_EQ(wellFormed("\xed\xa0\x80"), mark + mark + mark) << "a surrogate";
  EXPECT_EQ(wellFormed("\xe2\x82"), mark + mark) << "torn off";
  EXPECT_EQ(wellFormed("\xf4\x90\x80\x80"), mark + mark + mark + mark) << "beyond U+10FFFF";
  EXPECT_EQ(wellFormed(""), "");
}

TEST(InSmallLetters, ChangesAToZAlone) {
  EXPECT_EQ(inSmallLetters("T6 Left.STL"), "t6 left.stl");
  EXPECT_EQ(inSmallLetters("\xc3\x89"), "\xc3\x89") << "a letter beyond ASCII is of no file's ending";
}

TEST(LetterBytes, CountsTheLetterThatATextBeginsWith) {
  EXPECT_EQ(letterBytes("a"), 1u);
  EXPECT_EQ(letterBytes("\xc3\xa9!"), 2u);
  EXPECT_EQ(letterBytes("\xa9"), 0u);
  EXPECT_EQ(letterBytes(""), 0u);
}

}  // namespace palpate
