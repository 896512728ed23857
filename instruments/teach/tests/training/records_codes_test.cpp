// Codes that people type, pseudonyms that any station makes of them, and ids that sort by time.
#include "palpate/training/records/trainee_code.h"

#include <gtest/gtest.h>

#include <set>

#include "palpate/base/random.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/sha256.h"

namespace palpate::training {
namespace {

TEST(TraineeCodes, AreReadHoweverTheyAreTyped) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const std::string code = makeTraineeCode(random.bits());
    ASSERT_EQ(code.size(), 11u);
    EXPECT_EQ(code[5], '-');
    EXPECT_EQ(codeTyped(code), code);
    std::string careless = " ";
    for (const char letter : code) {
      if (letter == '-') continue;
      careless += letter == '0' ? 'o' : letter == '1' ? 'l' : static_cast<char>(std::tolower(letter));
      careless += ' ';
    }
    EXPECT_EQ(codeTyped(careless), code) << careless;
  }
}

/// What a sum of the letters would not notice.
TEST(TraineeCodes, EveryWrongLetterAndEverySwapIsNoticed) {
  constexpr std::string_view kLetters = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const std::string code = makeTraineeCode(random.bits());
    for (std::size_t at = 0; at < code.size(); ++at) {
      if (at == 5) continue;
      for (const char letter : kLetters) {
        std::string wrong = code;
        wrong[at] = letter;
        EXPECT_EQ(codeTyped(wrong).has_value(), letter == code[at]) << wrong;
      }
      for (std::size_t other = at + 1; other < code.size(); ++other) {
        if (other == 5 || code[other] == code[at]) continue;
        std::string swapped = code;
        std::swap(swapped[at], swapped[other]);
        EXPECT_FALSE(codeTyped(swapped)) << swapped;
      }
    }
  }
  for (const char* typed : {"", "7Q2MK", "UUUUU-UUUUU", "7Q2MK-9DXP4-1", "Smith"})
    EXPECT_FALSE(codeTyped(typed)) << typed;
}

TEST(TraineeCodes, PseudonymsDependOnClassAndCodeAlone) {
  const std::string code = makeTraineeCode(123456789);
  const Uuid pseudonym = derivePseudonym("osteo-1", code);
  std::string typed = code;
  for (char& c : typed) c = static_cast<char>(std::tolower(c));
  EXPECT_EQ(derivePseudonym("osteo-1", typed), pseudonym);
  EXPECT_NE(derivePseudonym("osteo-2", code), pseudonym);
  EXPECT_NE(derivePseudonym("osteo-1", makeTraineeCode(123456788)), pseudonym);
  EXPECT_TRUE(isUuid(pseudonym));
  EXPECT_EQ(pseudonym[14], '8');
  EXPECT_NE(std::string("89ab").find(pseudonym[19]), std::string::npos);
  // For ever: records of years ago are found by it.
  EXPECT_EQ(sha256Hex("palpate trainee\nosteo-1\n" + code).substr(0, 8), pseudonym.substr(0, 8));
}

TEST(TraineeCodes, IdsSortByTheTimeOfTheirMaking) {
  std::set<Uuid> ids;
  Uuid last;
  for (std::int64_t ms : {0ll, 1ll, 1'700'000'000'000ll, 1'700'000'000'001ll, 281'474'976'710'655ll}) {
    const Uuid id = makeUuidV7(ms, systemRandom());
    EXPECT_TRUE(isUuid(id)) << id;
    EXPECT_EQ(id[14], '7');
    EXPECT_GT(id, last);
    last = id;
  }
  for (int i = 0; i < 1000; ++i) ids.insert(makeUuidV7(5, systemRandom()));
  EXPECT_EQ(ids.size(), 1000u);
  EXPECT_EQ(makeUuidV7(0x0123456789ab, {0, 0}), "01234567-89ab-7000-8000-000000000000");
}

TEST(TraineeCodes, Sha256IsThatOfTheStandard) {
  EXPECT_EQ(sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(RecordsCodes, WithAClassesSecretNobodyTellsThePseudonymFromTheCard) {
  const std::string key(64, 'a');
  const std::string code = makeTraineeCode(7);
  EXPECT_EQ(derivePseudonym("osteo-1", code, key), derivePseudonym("osteo-1", " " + code, key));
  EXPECT_NE(derivePseudonym("osteo-1", code, key), derivePseudonym("osteo-1", code));
  EXPECT_NE(derivePseudonym("osteo-1", code, key), derivePseudonym("osteo-1", code, std::string(64, 'b')));
  EXPECT_NE(derivePseudonym("osteo-1", code, key), derivePseudonym("osteo-2", code, key));
  EXPECT_EQ(derivePseudonym("osteo-1", code, key)[14], '8');
  // RFC 4231, test case 2.
  const auto digest = computeHmacSha256("Jefe", "what do ya want for nothing?");
  EXPECT_EQ(digest[0], 0x5b);
  EXPECT_EQ(digest[31], 0x43);
}

}  // namespace
}  // namespace palpate::training
