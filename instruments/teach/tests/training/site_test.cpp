#include "palpate/training/site.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/trace/sample.h"
#include "support/error_message.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

TEST(Sites, TwelveGoDownTheLeftSideThenTheRight) {
  const SiteSet set = flatTwelve();
  ASSERT_EQ(set.choices(), 12);
  EXPECT_EQ(set.numbered(1)->label, "T4, left");
  EXPECT_EQ(set.numbered(6)->label, "L2, left");
  EXPECT_EQ(set.numbered(7)->label, "T4, right");
  EXPECT_EQ(spoken(*set.numbered(4)), "site 4, left");
  EXPECT_EQ(spoken(*set.numbered(9)), "site 9, right");
  EXPECT_LT(set.numbered(1)->place_mm.x(), 0.0);  // x goes to the patient's right
  EXPECT_GT(set.numbered(1)->place_mm.y(), set.numbered(2)->place_mm.y());
  EXPECT_EQ(set.numbered(0), nullptr);
  EXPECT_EQ(set.numbered(13), nullptr);
}

TEST(Sites, OppositeSitesAreOfOneLevel) {
  const SiteSet set = flatTwelve();
  for (int number = 1; number <= 6; ++number) {
    EXPECT_EQ(set.numbered(number)->level, number);
    EXPECT_EQ(set.numbered(number + 6)->level, number);
  }
}

TEST(Sites, PlacesOfOnesOwnAreNumberedAsTheyStand) {
  const std::vector<std::string> words = {"T6 right 30 mm", "T6 left 30 mm", "T10", "T10 right 40 mm"};
  const SiteSet set = sitesNamed(flatSpine(), words);
  ASSERT_EQ(set.choices(), 4);
  EXPECT_EQ(set.numbered(2)->side, Side::left);
  EXPECT_EQ(set.numbered(3)->side, Side::middle);
  EXPECT_EQ(spoken(*set.numbered(3)), "site 3");
  EXPECT_EQ(set.numbered(1)->level, 1);
  EXPECT_EQ(set.numbered(2)->level, 1);
  EXPECT_EQ(set.numbered(4)->level, 2);
}

TEST(Sites, PlacesThatAFingertipCannotTellApartAreRefused) {
  const std::vector<std::string> words = {"T6 right 30 mm", "T6 right 40 mm"};
  const std::string message = support::thrownMessage([&] { sitesNamed(flatSpine(), words); });
  EXPECT_NE(message.find("T6 right 40 mm"), std::string::npos) << message;
  EXPECT_THROW(sitesNamed(flatSpine(), std::vector<std::string>{"T6"}), Error);
  EXPECT_THROW(sitesNamed(flatSpine(), std::vector<std::string>{"T6", "T77"}), Error);
}

}  // namespace
}  // namespace palpate::training
