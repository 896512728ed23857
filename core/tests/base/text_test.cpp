#include "palpate/base/text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/error_message.h"

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
  EXPECT_EQ(support::messageOf([] { readFile("/nowhere/at-all.txt", 10); }), "/nowhere/at-all.txt: no such file");
}

TEST(WriteFile, IsReadBackAndNamesTheFileThatCannotBe) {
  const auto file = std::filesystem::temp_directory_path() / "palpate_write_file_test.txt";
  writeFile(file, "one\ntwo");
  writeFile(file, "three");
  EXPECT_EQ(readFile(file, 100), "three");
  std::filesystem::remove(file);
  EXPECT_THROW(writeFile("/nowhere/at-all.txt", "x"), Error);
}

}  // namespace palpate
