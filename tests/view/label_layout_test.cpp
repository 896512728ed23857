#include "palpate/view/overlays/plates.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpate::view {
namespace {

const LabelBox kPage{{14.0f, 14.0f}, {386.0f, 466.0f}};
const Vec2f kLabelSize(88.0f, 50.0f);

TEST(LabelLayout, PutsAPlateToTheRightAndAboveWhereThereIsRoom) {
  const Vec2f tip(150.0f, 200.0f);
  const LabelBox plate = placePlate(tip, kLabelSize, kPage, {});
  EXPECT_GT(plate.corner.x(), tip.x());
  EXPECT_LT(plate.opposite.y(), tip.y());
  EXPECT_EQ(plate.opposite - plate.corner, kLabelSize);
}

TEST(LabelLayout, KeepsPlatesOnThePageWhereverTheFingerIs) {
  for (const Vec2f& tip : {Vec2f(0, 0), Vec2f(400, 0), Vec2f(0, 480), Vec2f(400, 480), Vec2f(390, 240)}) {
    const LabelBox plate = placePlate(tip, kLabelSize, kPage, {});
    EXPECT_TRUE((plate.corner.array() >= kPage.corner.array()).all()) << tip.transpose();
    EXPECT_TRUE((plate.opposite.array() <= kPage.opposite.array()).all()) << tip.transpose();
  }
}

TEST(LabelLayout, NoPlateLiesOnAnother) {
  // A section below on the left, a legend on the right, and two fingers between: as in a narrow picture.
  std::vector<LabelBox> taken = {{{14.0f, 271.0f}, {164.0f, 434.0f}}, {{300.0f, 0.0f}, {400.0f, 320.0f}}};
  for (const Vec2f& tip : {Vec2f(168.0f, 118.0f), Vec2f(221.0f, 307.0f)}) {
    const LabelBox plate = placePlate(tip, kLabelSize, kPage, taken);
    for (const LabelBox& box : taken) EXPECT_EQ(overlapOf(plate, box), 0.0f) << tip.transpose();
    taken.push_back(plate);
  }
}

TEST(LabelLayout, HidesAsLittleAsPossibleWhereEverythingIsTaken) {
  const std::vector<LabelBox> taken = {{{0.0f, 0.0f}, {400.0f, 300.0f}}, {{0.0f, 310.0f}, {400.0f, 480.0f}}};
  const LabelBox plate = placePlate({200.0f, 280.0f}, kLabelSize, kPage, taken);
  const float hidden = overlapOf(plate, taken[0]) + overlapOf(plate, taken[1]);
  EXPECT_LT(hidden, kLabelSize.x() * kLabelSize.y());
}

TEST(LabelLayout, ALineStartsAtTheNearestCorner) {
  const LabelBox plate{{100.0f, 100.0f}, {180.0f, 140.0f}};
  EXPECT_EQ(nearestCorner(plate, {50.0f, 300.0f}), Vec2f(100.0f, 140.0f));
  EXPECT_EQ(nearestCorner(plate, {500.0f, 0.0f}), Vec2f(180.0f, 100.0f));
}

}  // namespace
}  // namespace palpate::view
