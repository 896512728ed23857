// Overlays as data: the lines and patches before they are drawn.
#include "palpate/view/overlays/overlays.h"

#include <gtest/gtest.h>

#include <set>

#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/section.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

std::size_t paintedWith(const std::vector<PaintedPoint>& points, Paint paint) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const auto& point) { return point.paint == paint; }));
}

TEST(ContactMarks, DrawTenMillimetresAnNewtonAndBreakAtSixty) {
  contact::FingerOutput contact{};
  contact.touch = contact::Touch::stick;
  contact.tip = contact.proxy = contact.anchor = Vec3::Zero();
  contact.normal = Vec3::UnitZ();
  const auto reach_of = [&](double newton) {
    contact.force = newton * Vec3::UnitZ();
    Lines lines;
    addContactMarks(contact, lines);
    double highest = 0.0;
    for (const auto& point : lines.points) {
      if (point.paint == kForcePaint) highest = std::max(highest, point.place.z());
    }
    return std::pair{highest, paintedWith(lines.points, kForcePaint)};
  };
  EXPECT_NEAR(reach_of(2.5).first, 25.0, 1e-4);
  EXPECT_NEAR(reach_of(30.0).first, 60.0, 1e-4);
  EXPECT_GT(reach_of(30.0).second, reach_of(2.5).second) << "the cap is drawn as a break";
}

TEST(EllipseMarks, LieOnFlatSkinAtTheEllipsesOwnSize) {
  const auto world = flatWorld();
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  const Vec3 centre(50.0, 50.0, 0.0);
  const Outline outline = outlineOf(*world, {{30.0, 0.0, 0.0}, 0.5}, centre, Vec3::UnitZ());
  ASSERT_EQ(outline.size(), 1u);
  for (const SkinSpot& spot : outline.front()) {
    const Vec3 offset = placeOf(spot, skin) - centre;
    EXPECT_NEAR(offset.z(), 0.0, 1e-6);
    EXPECT_NEAR(std::hypot(offset.x() / 30.0, offset.y() / 15.0), 1.0, 1e-5);
  }
}

TEST(EllipseMarks, EndWhereTheSkinEnds) {
  const auto world = flatWorld();
  const Outline outline = outlineOf(*world, {{30.0, 0.0, 0.0}, 1.0}, {0.0, 50.0, 0.0}, Vec3::UnitZ());
  std::size_t spots = 0;
  for (const auto& piece : outline) spots += piece.size();
  EXPECT_GT(spots, 40u);
  EXPECT_LT(spots, 60u) << "half of it";
}

TEST(PartitionMarks, HoldEveryTriangleWhoseBoxMeetsTheDetectingBox) {
  const auto world = flatWorld();
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  ShownPartition shown = makeShownPartition(*world);
  shown.partition = std::make_shared<hdb::Partition>(hdb::buildPartition(world->body->skin, {.threshold = 64}));
  shown.box_edges_mm = Vec3::Constant(20.0);
  contact::FingerOutput contact{};
  contact.proxy = {40.0, 60.0, 0.0};
  Patches patches;
  addHapticTriangles(shown, *world, skin, contact, patches);
  const auto in_floats = [](const Vec3& p) { return std::array{static_cast<float>(p.x()), static_cast<float>(p.y())}; };
  std::set<std::array<float, 2>> corners;
  for (const auto& point : patches.points) corners.insert(in_floats(point.place));
  for (const Vec3& p : world->body->skin.positions) {
    if ((p - contact.proxy).head<2>().lpNorm<Eigen::Infinity>() < 10.0) {
      EXPECT_TRUE(corners.contains(in_floats(p)));
    }
  }
  EXPECT_LT(patches.points.size(), 3 * world->body->skin.triangles.size()) << "and not the whole skin";
}

TEST(PartitionMarks, ColourPlanesByTheirAxis) {
  const auto world = meshWorld(zoo::sphere(50.0));
  const auto tree = hdb::buildPartition(world->body->skin, {.tree = hdb::TreeKind::Octree, .threshold = 400});
  Lines lines;
  Patches patches;
  addPlanes(tree, lines, patches);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(paintedWith(lines.points, kPlanePaints[axis]), 8u) << "four edges of the root's plane " << axis;
  }
}

TEST(SkinMarks, DrawOneArrowInEachCubeThatMoved) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {&finger, 1}));
  Lines fine, coarse;
  addDisplacements(*world, skin, 4.0, fine);
  addDisplacements(*world, skin, 12.0, coarse);
  EXPECT_GT(coarse.points.size(), 0u);
  EXPECT_GT(fine.points.size(), 4 * coarse.points.size());
  Lines none;
  skin.copyAll(deformedBy(*world, {}));
  addDisplacements(*world, skin, 4.0, none);
  EXPECT_TRUE(none.points.empty()) << "nothing moved";
}

TEST(SkinMarks, ShowTheArrowsOfAStraightPressToAnEyeThatLooksAlongThem) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 8.0);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {&finger, 1}));
  Lines arrows;
  addDisplacements(*world, skin, 6.0, arrows);
  ASSERT_FALSE(arrows.points.empty());
  // Every stroke of the largest arrow, seen along z: how far it reaches from the arrow's middle.
  double widest = 0.0;
  for (std::size_t i = 0; i < arrows.points.size(); i += 2) {
    const Vec3 stroke = arrows.points[i + 1].place - arrows.points[i].place;
    widest = std::max(widest, stroke.head<2>().norm());
  }
  EXPECT_GT(widest, 4.0) << "mm across; the barbs alone have less than 2";
}

/// Of the deformed and of the resting curve of a cut, as drawn.
std::array<Lines, 2> cutLines(const scene::World& world, const FingerMark& finger) {
  DrawnSkin skin;
  skin.copyAll(deformedBy(world, {&finger, 1}));
  Lines both;
  addSection(world, skin, finger.contact, both);
  std::array<Lines, 2> lines;
  for (const PaintedPoint& point : both.points) {
    lines[point.paint == kDeformedSectionPaint ? 0 : 1].points.push_back(point);
  }
  return lines;
}

TEST(SectionMarks, DrawNoLineInTheSkinNorTwoInOnePlace) {
  const auto world = flatWorld();
  const auto [deformed, rest] = cutLines(*world, pressedFinger(*world, {51.0, 49.0, 0.0}, 6.0));
  ASSERT_FALSE(deformed.points.empty());
  ASSERT_FALSE(rest.points.empty());
  double farthest = 0.0;
  for (const PaintedPoint& point : rest.points) farthest = std::max(farthest, std::abs(point.place.x() - 51.0));
  EXPECT_LT(farthest, 30.0) << "at rest only over the dent, not where both lines are one";
  for (const PaintedPoint& point : deformed.points) {
    if (std::abs(point.place.x() - 51.0) < 30.0) continue;
    EXPECT_NEAR(point.place.z(), 0.5, 1e-3) << "out of the skin";
  }
}

TEST(SectionMarks, ReachAsFarAsTheirChartAndShowTheDeepestFingerAlone) {
  const auto world = flatWorld();
  const std::array fingers = {pressedFinger(*world, {30.0, 20.0, 0.0}, 3.0),
                              pressedFinger(*world, {50.0, 70.0, 0.0}, 8.0)};
  EXPECT_EQ(sectionFinger(fingers), &fingers[1]);
  EXPECT_EQ(sectionFinger({}), nullptr);
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, fingers));
  Look look;
  look.show(Overlay::section);
  Overlays overlays(*world);
  const OverlayShapes& shapes = overlays.shapes(look, skin, fingers);
  double low = 100.0, high = 0.0;
  for (const PaintedPoint& point : shapes.bold.points) {
    EXPECT_NEAR(point.place.y(), 70.0f, 1.0f);
    low = std::min(low, point.place.x());
    high = std::max(high, point.place.x());
  }
  EXPECT_NEAR(low, 10.0f, 2.5f);
  EXPECT_NEAR(high, 90.0f, 2.5f);
}

TEST(OverlayKey, ExplainsEveryColourThatAnOverlayDraws) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0, {4.0, 0.0, 0.0});
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {&finger, 1}));
  for (std::size_t i = 0; i < kOverlays; ++i) {
    Look look;
    look.overlays.set(i);
    std::set<std::array<std::uint8_t, 3>> explained;
    for (const KeyEntry& entry : overlayKey(look)) {
      explained.insert({entry.paint[0], entry.paint[1], entry.paint[2]});
      EXPECT_FALSE(entry.words.empty());
    }
    EXPECT_FALSE(explained.empty()) << kOverlayNames[i];
    Overlays overlays(*world);
    const OverlayShapes& shapes = overlays.shapes(look, skin, {&finger, 1});
    for (const auto* points : {&shapes.patches.points, &shapes.thin.points, &shapes.bold.points}) {
      for (const PaintedPoint& point : *points) {
        EXPECT_TRUE(explained.contains({point.paint[0], point.paint[1], point.paint[2]})) << kOverlayNames[i];
      }
    }
  }
  EXPECT_TRUE(overlayKey({}).empty());
}

TEST(OverlayKey, SaysWhenDentsAreShadedMoreThanLightWould) {
  Look look;
  look.dent_contrast = 2.0;
  ASSERT_EQ(overlayKey(look).size(), 1u);
  EXPECT_EQ(overlayKey(look)[0].words, "dent contrast x2");
  look.colouring = Colouring::strain;
  EXPECT_TRUE(overlayKey(look).empty()) << "colours that mean something know no dent contrast";
}

TEST(OverlayKey, SaysHowDeepTheContoursOfADentAre) {
  ASSERT_EQ(overlayKey({}, true).size(), 1u);
  EXPECT_EQ(overlayKey({}, true)[0].words, "dent 0.5, 2.5, 4.5 ... mm deep");
}

/// Steps along edges from the nearest corner of a triangle, for every vertex.
std::vector<int> stepsFrom(const scene::World& world, Index triangle) {
  std::vector<int> steps(world.body->skin.positions.size(), 1000);
  for (const Index v : world.body->skin.triangles[triangle]) steps[v] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : world.body->skin.triangles) {
      for (int i = 0; i < 6; ++i) {
        const Index from = t[i % 3];
        const Index to = t[(i + 1 + i / 3) % 3];
        if (steps[from] + 1 < steps[to]) {
          steps[to] = steps[from] + 1;
          changed = true;
        }
      }
    }
  }
  return steps;
}

TEST(SkinMarks, DrawTheEdgesWithinEachRingOfNeighbours) {
  const auto world = flatWorld();
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  constexpr Index kTriangle = 2500;
  constexpr int kRings = 3;
  const std::vector<int> steps = stepsFrom(*world, kTriangle);
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : world->body->skin.triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      if (steps[low] == steps[high] && steps[low] <= kRings) edges.insert({low, high});
    }
  }
  Lines lines;
  addRings(*world, skin, kTriangle, kRings, lines);
  EXPECT_EQ(lines.points.size(), 2 * edges.size());
  EXPECT_GT(edges.size(), 20u);
}

}  // namespace
}  // namespace palpate::view
