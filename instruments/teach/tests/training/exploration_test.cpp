#include "palpate/training/exploration.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

constexpr double kTickS = 0.001;

class ExplorationOfTwelve : public testing::Test {
 protected:
  void press(int site, double force_n, int ticks, const Vec3& off = Vec3::Zero(), std::uint32_t finger = 0) {
    for (int i = 0; i < ticks; ++i)
      exploration_.follow(pressAt(sites_.numbered(site)->point_mm + off, force_n, finger));
  }
  SiteSet sites_ = flatTwelve();
  Exploration exploration_{sites_, {}, kTickS};
};

TEST_F(ExplorationOfTwelve, ASiteCountsAfterThreeTenthsOfASecondAtHalfANewton) {
  press(4, 0.5, 299);
  EXPECT_FALSE(exploration_.visited(4));
  press(4, 0.5, 1);
  EXPECT_TRUE(exploration_.visited(4));
  EXPECT_EQ(exploration_.visitedSites(), 1);
}

TEST_F(ExplorationOfTwelve, ALightTouchDoesNotCountHoweverLong) {
  press(4, 0.49, 5000);
  EXPECT_FALSE(exploration_.visited(4));
  ASSERT_EQ(exploration_.visits().size(), 1U);  // it is recorded all the same
  EXPECT_EQ(exploration_.visits()[0].presses, 0);
  EXPECT_NEAR(exploration_.visits()[0].peak_force_n, 0.49, 1e-12);
}

TEST_F(ExplorationOfTwelve, SeveralPressesAddUp) {
  press(4, 1.0, 150);
  press(4, 0.0, 10);
  press(4, 2.0, 150);
  EXPECT_TRUE(exploration_.visited(4));
  const SiteVisit visit = exploration_.visits().at(0);
  EXPECT_EQ(visit.presses, 2);
  EXPECT_NEAR(visit.dwell_ms, 300.0, 1e-6);
  EXPECT_NEAR(visit.mean_force_n, 1.5, 1e-9);
  EXPECT_NEAR(visit.peak_force_n, 2.0, 1e-12);
  EXPECT_NEAR(visit.deepest_mm, 4.0, 1e-12);
}

TEST_F(ExplorationOfTwelve, OnlyTheNearestSiteWithinReachIsPressed) {
  press(4, 1.0, 400, Vec3(14.0, 0.0, 0.0));
  press(5, 1.0, 400, Vec3(16.0, 0.0, 0.0));  // 15 mm reach
  EXPECT_TRUE(exploration_.visited(4));
  EXPECT_FALSE(exploration_.visited(5));
}

TEST_F(ExplorationOfTwelve, TheFrontOfTheBodyIsNoSite) {
  press(4, 1.0, 400, Vec3(0.0, 0.0, -200.0));
  EXPECT_EQ(exploration_.visitedSites(), 0);
}

TEST_F(ExplorationOfTwelve, TwoFingersEachHaveTheirPresses) {
  press(4, 1.0, 1, Vec3::Zero(), 0);
  press(10, 1.0, 1, Vec3::Zero(), 1);
  for (int i = 0; i < 400; ++i) {
    press(4, 1.0, 1, Vec3::Zero(), 0);
    press(10, 1.0, 1, Vec3::Zero(), 1);
  }
  EXPECT_TRUE(exploration_.visited(4));
  EXPECT_TRUE(exploration_.visited(10));
  for (const SiteVisit& visit : exploration_.visits()) EXPECT_EQ(visit.presses, 1) << visit.site;
}

TEST_F(ExplorationOfTwelve, MissingSitesAreNamedAndANewTrialForgets) {
  for (int site = 1; site <= 12; ++site) {
    if (site != 3 && site != 11) press(site, 1.0, 300);
  }
  EXPECT_EQ(exploration_.missing(), (std::vector<int>{3, 11}));
  exploration_.restart();
  EXPECT_EQ(exploration_.visitedSites(), 0);
  EXPECT_TRUE(exploration_.visits().empty());
}

TEST_F(ExplorationOfTwelve, TheTouchedSiteIsThatOfTheFingerThatTouches) {
  press(4, 0.2, 1);
  EXPECT_EQ(exploration_.touchedSite(), 4);
  press(4, 0.0, 1, Vec3::Zero(), 1);  // another finger in the air says nothing
  EXPECT_EQ(exploration_.touchedSite(), 4);
  press(4, 0.0, 1);
  EXPECT_EQ(exploration_.touchedSite(), 0);
}

}  // namespace
}  // namespace palpate::training
