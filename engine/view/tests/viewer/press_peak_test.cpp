#include "view/viewer/frame_painter.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

contact::FingerOutput pressed(double depth_mm, double force_n) {
  contact::FingerOutput contact{};
  contact.touch = contact::Touch::stick;
  contact.depth_mm = depth_mm;
  contact.force = Vec3(0, 0, force_n);
  return contact;
}

TEST(PressPeak, TellsTheMostOfAPressForASecondAfterIt) {
  const contact::FingerOutput free{};
  PressPeak peak;
  peak.follow(free, 0.0);
  EXPECT_FALSE(peak.shown(0.0)) << "nothing was pressed yet";
  peak.follow(pressed(3.0, 2.0), 1.0);
  peak.follow(pressed(7.0, 4.5), 1.1);
  peak.follow(pressed(5.0, 2.5), 1.2);
  EXPECT_FALSE(peak.shown(1.2)) << "the numbers are those of now";
  peak.follow(free, 1.3);
  ASSERT_TRUE(peak.shown(2.2));
  EXPECT_EQ(peak.shown(2.2)->depth_mm, 7.0);
  EXPECT_EQ(peak.shown(2.2)->force_n, 4.5);
  EXPECT_FALSE(peak.shown(2.4));
  peak.follow(pressed(1.0, 0.5), 3.0);
  peak.follow(free, 3.1);
  EXPECT_EQ(peak.shown(3.2)->depth_mm, 1.0) << "each press has its own";
}

}  // namespace
}  // namespace palpate::viewer
