#include "palpate/base/base64.h"

#include <gtest/gtest.h>

#include "support/expect_each.h"

namespace palpate {

TEST(Base64, IsWrittenAsTheStandardHasIt) {  // RFC 4648, section 10
  support::expectEach(
      base64, {{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}, {"\xff\xfe", "//4="}});
}

TEST(Base64, IsReadWithOrWithoutPadding) {
  EXPECT_EQ(bytesOfBase64("Zm8="), "fo");
  EXPECT_EQ(bytesOfBase64("Zm8"), "fo");
  EXPECT_EQ(bytesOfBase64("//4="), "\xff\xfe");
  EXPECT_EQ(bytesOfBase64("Zm9v"), "foo");
}

TEST(Base64, RefusesOtherLetters) {
  EXPECT_FALSE(bytesOfBase64("Zm9v\n"));
  EXPECT_FALSE(bytesOfBase64("Zm=v"));
  EXPECT_FALSE(bytesOfBase64("Zm-_"));
}

}  // namespace palpate
