// HMAC-SHA256 against the vectors of RFC 4231 and, at every length up to three blocks, against Python.
#include "palpate/base/hmac_sha256.h"

#include <gtest/gtest.h>

#include <string>

#include "support/counted.h"

namespace palpate {
namespace {

std::string signedHex(std::string_view key, std::string_view message) {
  const auto hex = hexOf(HmacSha256(key).of(message));
  return {hex.begin(), hex.end()};
}

TEST(HmacSha256, IsThatOfRfc4231) {
  EXPECT_EQ(signedHex(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(signedHex("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(signedHex(std::string(20, '\xaa'), std::string(50, '\xdd')),
            "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
  EXPECT_EQ(signedHex(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
  EXPECT_EQ(signedHex(std::string(131, '\xaa'),
                      "This is a test using a larger than block-size key and a larger than block-size data. The key "
                      "needs to be hashed before being used by the HMAC algorithm."),
            "9b09ffa71b942fcb27635fbcd5b0e944bfdc63644f0713938a7f51535c3a35e2");
}

// python3 -c "import hmac; k = b'key'; m = b''
// for n in range(200): m += hmac.new(k, b'a' * n, 'sha256').digest()
// print(hmac.new(k, m, 'sha256').hexdigest())"
TEST(HmacSha256, PadsMessagesOfEveryLength) {
  const HmacSha256 key("key");
  std::string all;
  for (std::size_t length = 0; length < 200; ++length) {
    const Sha256Digest digest = key.of(std::string(length, 'a'));
    all.append(digest.begin(), digest.end());
  }
  EXPECT_EQ(signedHex("key", all), "1d6042421442e8e27a8f202398f9c971f8021fd6c9121627c7e8a87095b455b9");
}

TEST(HmacSha256, AsksForNeitherMemoryNorLocks) {
  const HmacSha256 key("key");
  const std::string message(200, 'm');
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (int i = 0; i < 1000; ++i) (void)hexOf(key.of(message));
  const lab::ThreadCounts asked = lab::countsSince(before);
  support::expectNone(asked.allocations, "allocations");
  support::expectNone(asked.locks, "locks");
}

TEST(HmacSha256, EqualTextsAreEqualAndNoOthers) {
  EXPECT_TRUE(equalInConstantTime("", ""));
  EXPECT_TRUE(equalInConstantTime("abc", "abc"));
  EXPECT_FALSE(equalInConstantTime("abc", "abd"));
  EXPECT_FALSE(equalInConstantTime("abc", "ab"));
  EXPECT_FALSE(equalInConstantTime("abc", "abcd"));
}

}  // namespace
}  // namespace palpate
