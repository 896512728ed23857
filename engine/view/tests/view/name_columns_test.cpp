// Where the plates of names go: never over each other, never over what is taken, in the order of their places.
#include "palpate/view/overlays/plates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "palpate/base/random.h"

namespace palpate::view {
namespace {

const LabelBox kNamesPage{{14.0f, 14.0f}, {1266.0f, 706.0f}};
const Vec2f kPlateSize(90.0f, 17.0f);

/// A body in the middle of the page, from x = 440 to 840.
NameGround bodyOnPage(std::span<const LabelBox> taken = {}) {
  return {.page = kNamesPage, .body_left = 440.0f, .body_right = 840.0f, .taken = taken};
}

std::vector<NameTag> scatteredTags(std::size_t count, std::uint64_t seed, const LabelBox& within) {
  Random random(seed);
  std::vector<NameTag> tags;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2f share(static_cast<float>(random.uniform(0.0, 1.0)), static_cast<float>(random.uniform(0.0, 1.0)));
    const Vec2f dot = within.corner + share.cwiseProduct(within.opposite - within.corner);
    const auto width = static_cast<float>(random.uniform(20.0, 150.0));
    tags.push_back({dot, {width, 17.0f}, static_cast<int>(i % 4), i % 4 == 0});
  }
  return tags;
}

bool liesWithin(const LabelBox& box, const LabelBox& page) {
  return (box.corner.array() >= page.corner.array()).all() && (box.opposite.array() <= page.opposite.array()).all();
}

/// What lies on what it must not; empty: nothing.
std::string findLayoutFault(std::span<const NameTag> tags, const std::vector<NamePlate>& plates,
                            const NameGround& ground) {
  for (std::size_t i = 0; i < plates.size(); ++i) {
    if (!liesWithin(plates[i].box, ground.page)) return "a plate off the page";
    for (std::size_t k = 0; k < i; ++k) {
      if (overlapArea(plates[i].box, plates[k].box) > 0.0f) return "a plate on a plate";
    }
    for (const LabelBox& box : ground.taken) {
      if (overlapArea(plates[i].box, box) > 0.0f) return "a plate on what is taken";
    }
    for (const NamePlate& other : plates) {
      const Vec2f dot = tags[other.tag].dot;
      if (overlapArea(plates[i].box, {dot - Vec2f::Ones(), dot + Vec2f::Ones()}) > 0.0f) return "a plate on a dot";
    }
  }
  return {};
}

TEST(NameColumns, NothingLiesOnAnythingWhereverThePlacesAre) {
  const std::vector<LabelBox> taken = {
      {{14.0f, 14.0f}, {190.0f, 130.0f}}, {{14.0f, 650.0f}, {220.0f, 720.0f}}, {{1100.0f, 0.0f}, {1280.0f, 330.0f}}};
  const std::vector<LabelBox> spreads = {{{450.0f, 20.0f}, {830.0f, 700.0f}},    // on the body
                                         {{0.0f, 0.0f}, {1280.0f, 720.0f}},      // all over the page
                                         {{600.0f, 300.0f}, {640.0f, 330.0f}}};  // all in one place
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    for (const LabelBox& spread : spreads) {
      const std::vector<NameTag> tags = scatteredTags(5 + 4 * seed, seed, spread);
      NameGround ground = bodyOnPage(taken);
      if (seed % 3 == 0) ground.body_left = -500.0f, ground.body_right = 1900.0f;  // closer than the page is wide
      const std::vector<NamePlate> plates = nameColumns(tags, ground);
      EXPECT_EQ(findLayoutFault(tags, plates, ground), "") << "seed " << seed;
      EXPECT_FALSE(plates.empty());
    }
  }
}

TEST(NameColumns, StandOutsideTheBodyEachOnTheSideOfItsPlace) {
  const std::vector<NameTag> tags = {
      {{500.0f, 200.0f}, kPlateSize}, {{700.0f, 300.0f}, kPlateSize}, {{460.0f, 400.0f}, kPlateSize}};
  const std::vector<NamePlate> plates = nameColumns(tags, bodyOnPage());
  ASSERT_EQ(plates.size(), 3u);
  for (const NamePlate& plate : plates) {
    const bool left = tags[plate.tag].dot.x() < 640.0f;
    EXPECT_TRUE(left ? plate.box.opposite.x() < 440.0f : plate.box.corner.x() > 840.0f);
    EXPECT_EQ(plate.line_from.x(), left ? plate.box.opposite.x() : plate.box.corner.x());
    EXPECT_NEAR(plate.line_from.y(), tags[plate.tag].dot.y(), 1.0f) << "room enough: level with its place";
  }
}

TEST(NameColumns, ASpineStaysInOneRowFromAboveToBelow) {
  std::vector<NameTag> tags;
  for (int i = 0; i < 17; ++i) {
    const float sway = i % 2 == 0 ? -9.0f : 9.0f;
    tags.push_back({{640.0f + sway, 100.0f + 12.0f * static_cast<float>(i)}, {30.0f, 17.0f}, 0, true});
  }
  const std::vector<NamePlate> plates = nameColumns(tags, bodyOnPage());
  ASSERT_EQ(plates.size(), tags.size());
  for (std::size_t i = 0; i < plates.size(); ++i) {
    EXPECT_EQ(plates[i].tag, i);
    EXPECT_GT(plates[i].box.corner.x(), 840.0f);
    if (i > 0) {
      EXPECT_GT(plates[i].box.corner.y(), plates[i - 1].box.corner.y());
    }
  }
}

TEST(NameColumns, ASpineThatLiesAcrossThePageGoesToTheNearerSide) {
  std::vector<NameTag> tags;
  for (int level = 0; level < 12; ++level) {
    const float along = static_cast<float>(level);
    tags.push_back({{465.0f + 30.0f * along, 350.0f + 2.0f * along}, kPlateSize, 0, true});
  }
  const std::vector<NamePlate> plates = nameColumns(tags, bodyOnPage());
  ASSERT_EQ(plates.size(), tags.size());
  for (const NamePlate& plate : plates) {
    EXPECT_EQ(plate.box.corner.x() > 640.0f, tags[plate.tag].dot.x() > 640.0f) << plate.tag;
  }
}

TEST(NameColumns, LinesOfNeighboursDoNotCross) {
  // The lower one lies much nearer to the column: by height alone their lines would cross.
  const std::vector<NameTag> tags = {{{650.0f, 300.0f}, kPlateSize},
                                     {{830.0f, 304.0f}, kPlateSize},
                                     {{650.0f, 308.0f}, kPlateSize},
                                     {{830.0f, 296.0f}, kPlateSize}};
  const std::vector<NamePlate> plates = nameColumns(tags, bodyOnPage());
  const auto side = [](const Vec2f& a, const Vec2f& b, const Vec2f& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  ASSERT_EQ(plates.size(), 4u);
  for (std::size_t i = 0; i + 1 < plates.size(); ++i) {
    const Vec2f a = plates[i].line_from, b = tags[plates[i].tag].dot;
    const Vec2f c = plates[i + 1].line_from, d = tags[plates[i + 1].tag].dot;
    EXPECT_FALSE(side(a, b, c) * side(a, b, d) < 0.0f && side(c, d, a) * side(c, d, b) < 0.0f) << i;
  }
}

TEST(NameColumns, GiveUpTheHighestRankAsAWholeOnBothSides) {
  std::vector<NameTag> tags = {{{500.0f, 300.0f}, kPlateSize, 3, false}};  // the left column has room
  for (int i = 0; i < 60; ++i) {
    tags.push_back({{700.0f, 100.0f + 9.0f * static_cast<float>(i)}, kPlateSize, i % 3 == 0 ? 0 : 3, false});
  }
  std::set<int> ranks;
  for (const NamePlate& plate : nameColumns(tags, bodyOnPage())) ranks.insert(tags[plate.tag].rank);
  EXPECT_EQ(ranks, std::set<int>{0});
  EXPECT_EQ(nameColumns(tags, bodyOnPage()).size(), 20u);
}

TEST(NameColumns, LeaveOutWhatLiesOffThePageOrUnderSomethingElse) {
  const std::vector<LabelBox> taken = {{{600.0f, 100.0f}, {700.0f, 200.0f}}};
  const std::vector<NameTag> tags = {{{650.0f, 150.0f}, kPlateSize},
                                     {{650.0f, -40.0f}, kPlateSize},
                                     {Vec2f::Constant(std::numeric_limits<float>::quiet_NaN()), kPlateSize},
                                     {{650.0f, 400.0f}, kPlateSize}};
  const std::vector<NamePlate> plates = nameColumns(tags, bodyOnPage(taken));
  ASSERT_EQ(plates.size(), 1u);
  EXPECT_EQ(plates[0].tag, 3u);
}

}  // namespace
}  // namespace palpate::view
