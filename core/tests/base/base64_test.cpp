#include "palpate/base/base64.h"

#include <gtest/gtest.h>

namespace palpate {

TEST(Base64, IsWrittenAsTheStandardHasIt) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
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
