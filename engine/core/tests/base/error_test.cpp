#include "palpate/base/error.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <type_traits>

namespace palpate {

TEST(Error, SaysAllInOneLineAndEachPartByItself) {
  const Error error = Error::atLine("back:2.toml", 12, "friction: must be a number");
  EXPECT_STREQ(error.what(), "back:2.toml:12: friction: must be a number");
  EXPECT_EQ(error.file(), "back:2.toml");
  EXPECT_EQ(error.line(), 12u);
  EXPECT_EQ(error.cause(), "friction: must be a number");
}

TEST(Error, KnowsAFileWithoutALine) {
  const Error error = Error::inFile("back.obj", "the file has no triangles");
  EXPECT_STREQ(error.what(), "back.obj: the file has no triangles");
  EXPECT_EQ(error.file(), "back.obj");
  EXPECT_EQ(error.line(), 0u);
  EXPECT_EQ(error.cause(), "the file has no triangles");
}

TEST(Error, CountsAByteAsPartOfTheCause) {
  const Error error = Error::atByte("back.stl", 84, "the file ends here");
  EXPECT_STREQ(error.what(), "back.stl: byte 84: the file ends here");
  EXPECT_EQ(error.file(), "back.stl");
  EXPECT_EQ(error.cause(), "byte 84: the file ends here");
}

TEST(Error, MayBeInNoFile) {
  const Error error("nobody: touches anything");
  EXPECT_STREQ(error.what(), "nobody: touches anything");
  EXPECT_EQ(error.file(), "");
  EXPECT_EQ(error.line(), 0u);
  EXPECT_EQ(error.cause(), "nobody: touches anything");
}

TEST(Error, SurvivesAZeroByteInAFilesName) {
  const Error error = Error::inFile(std::string_view("skin\0.bin", 9), "no such file");
  EXPECT_STREQ(error.what(), "skin");
  EXPECT_EQ(error.file(), "skin");
  EXPECT_EQ(error.cause(), "");
}

TEST(Error, KeepsItsPartsWhenCopied) {
  static_assert(std::is_nothrow_copy_constructible_v<Error>);
  Error copy("another");
  {
    const Error error = Error::atLine("a rather long name of a file.toml", 3, "wrong");
    copy = error;
  }
  EXPECT_EQ(copy.file(), "a rather long name of a file.toml");
  EXPECT_EQ(copy.line(), 3u);
  EXPECT_EQ(copy.cause(), "wrong");
}

}  // namespace palpate
