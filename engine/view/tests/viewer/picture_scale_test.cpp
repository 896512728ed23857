#include "view/viewer/picture_scale.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

/// A machine whose pictures cost something whatever their size, and something a pixel.
struct Machine {
  double fixed_s;
  double full_s;
  double frame(const PictureScale& scale) const { return fixed_s + full_s * scale.share() * scale.share(); }
};

void touch(PictureScale& scale, const Machine& machine, double seconds) {
  for (double t = 0.0; t < seconds; t += machine.frame(scale)) scale.frame(machine.frame(scale));
}

TEST(PictureScale, KeepsAllPixelsWherePicturesAreQuick) {
  PictureScale scale;
  touch(scale, {0.005, 0.040}, 60.0);
  EXPECT_EQ(scale.share(), 1.0);
}

TEST(PictureScale, ComesToTwentyPicturesASecondWithinASecond) {
  for (const double full_s : {0.06, 0.10, 0.14}) {
    PictureScale scale;
    const Machine machine{0.012, full_s};
    touch(scale, machine, 1.0);
    EXPECT_LT(machine.frame(scale), 1.0 / 20.0) << full_s;
    EXPECT_LT(scale.share(), 1.0);
  }
}

TEST(PictureScale, GivesUpNoMoreThanIsNeeded) {
  PictureScale scale;
  const Machine machine{0.010, 0.045};
  touch(scale, machine, 20.0);
  EXPECT_GE(scale.share(), 0.75);
}

TEST(PictureScale, HasAtLeastHalfOfThePixelsAlongEachSide) {
  PictureScale scale;
  touch(scale, {0.5, 0.5}, 20.0);
  EXPECT_EQ(scale.share(), kMinPictureShare);
}

TEST(PictureScale, ForgivesAHitch) {
  PictureScale scale;
  for (int i = 0; i < 200; ++i) scale.frame(i % 5 == 0 ? 0.3 : 0.02);
  EXPECT_EQ(scale.share(), 1.0);
}

TEST(PictureScale, TakesPixelsBackWhenThereIsTimeToSpare) {
  PictureScale scale;
  touch(scale, {0.012, 0.12}, 2.0);
  ASSERT_LT(scale.share(), 0.75);
  touch(scale, {0.004, 0.012}, 12.0);
  EXPECT_EQ(scale.share(), 1.0);
}

TEST(PictureScale, DoesNotSwayBackAndForth) {
  PictureScale scale;
  // A step more brings pictures that are too slow, though it did not look so before.
  int changes = 0;
  for (double t = 0.0; t < 600.0;) {
    const double before = scale.share();
    const double between = before > 0.6 ? 0.06 : 0.02;
    scale.frame(between);
    changes += scale.share() != before ? 1 : 0;
    t += between;
  }
  EXPECT_LE(changes, 36) << "in ten minutes";
}

TEST(PictureScale, BeginsWithAllPixelsAgain) {
  PictureScale scale;
  touch(scale, {0.5, 0.5}, 5.0);
  scale.reset();
  EXPECT_EQ(scale.share(), 1.0);
}

}  // namespace
}  // namespace palpate::viewer
