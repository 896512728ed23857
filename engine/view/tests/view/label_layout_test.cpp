#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "palpate/view/overlays/labels.h"
#include "palpate/view/overlays/plates.h"
#include "support/contrast.h"
#include "view/tests/view/small_world.h"

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
    for (const LabelBox& box : taken) EXPECT_EQ(overlapArea(plate, box), 0.0f) << tip.transpose();
    taken.push_back(plate);
  }
}

TEST(LabelLayout, HidesAsLittleAsPossibleWhereEverythingIsTaken) {
  const std::vector<LabelBox> taken = {{{0.0f, 0.0f}, {400.0f, 300.0f}}, {{0.0f, 310.0f}, {400.0f, 480.0f}}};
  const LabelBox plate = placePlate({200.0f, 280.0f}, kLabelSize, kPage, taken);
  const float hidden = overlapArea(plate, taken[0]) + overlapArea(plate, taken[1]);
  EXPECT_LT(hidden, kLabelSize.x() * kLabelSize.y());
}

TEST(LabelLayout, ALineStartsAtTheNearestCorner) {
  const LabelBox plate{{100.0f, 100.0f}, {180.0f, 140.0f}};
  EXPECT_EQ(nearestCorner(plate, {50.0f, 300.0f}), Vec2f(100.0f, 140.0f));
  EXPECT_EQ(nearestCorner(plate, {500.0f, 0.0f}), Vec2f(180.0f, 100.0f));
}

using support::contrastOf;
using support::SeenColour;

SeenColour over(const SeenColour& ground, const Ink& ink) {
  return support::blended(ground, {double(ink.colour[0]), double(ink.colour[1]), double(ink.colour[2])}, ink.opacity);
}

TEST(LabelInks, AreReadOnTheirGroundAndOnTheirPlatesWhateverLiesBehind) {
  constexpr SeenColour kDark{40, 41, 44}, kLight{215, 216, 218}, kPaper{255, 255, 255};
  constexpr SeenColour kSkin{190, 150, 120}, kShade{95, 60, 48};
  for (const auto& [ground, white, light] :
       {std::tuple{kDark, false, false}, {kLight, false, true}, {kPaper, true, false}}) {
    Look look;
    look.white_background = white;
    look.light_background = light;
    const LabelInks& inks = inksFor(look);
    EXPECT_GT(contrastOf(over(ground, inks.letter), ground), 10.0);
    for (const auto& behind : {ground, kSkin, kShade}) {
      const auto plate = over(behind, inks.plate);
      EXPECT_GT(contrastOf(over(plate, inks.letter), plate), 5.5);
      EXPECT_GT(contrastOf(over(plate, inks.deformed), plate), 3.0) << "a curve";
      EXPECT_GT(contrastOf(over(plate, inks.rest), plate), 3.0) << "a curve";
      const auto rim = over(behind, inks.rim);
      EXPECT_GT(contrastOf(over(rim, inks.letter), rim), 5.5) << "letters on the picture have a rim";
    }
  }
}

TEST(FingerWords, SayHowDeepTheSkinIsDrawnWhereTheFingerIsDeeper) {
  const auto world = flatWorld();
  using Lines = std::vector<std::string>;
  FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0);
  EXPECT_EQ(fingerLabelLines(*world, finger, "left"), (Lines{"left", "depth 6.0 mm", "force 3.00 N"}));
  finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 14.4);
  EXPECT_EQ(fingerLabelLines(*world, finger, ""), (Lines{"depth 14.4 mm", "force 7.20 N", "skin drawn 10 mm deep"}));
}

TEST(FingerWords, TellTheWholeForceNotItsNormalPart) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0, {2.0, 0.0, 0.0});
  EXPECT_GT(finger.contact.force.norm(), finger.contact.force.z() + 0.05) << "it pulls";
  EXPECT_EQ(fingerLabelLines(*world, finger, "").back(), fmt::format("force {:.2f} N", finger.contact.force.norm()));
}

}  // namespace
}  // namespace palpate::view
