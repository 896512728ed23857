// A larger finger is pushed back harder: the radius as an axis of solved stacks, of tables and of the law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_library.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

ForceLaw libraryLaw() {
  return {.kind = ForceLaw::Kind::layered, .layers = LayeredTissue(libraryNodes(8.0)).forceRows()};
}

LayeredTable solvedTable() {
  LayeredTable table;
  table.stack = libraryStack(30.0, 0.25);
  table.radii_mm = {0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0};
  for (const double depth : {2.0, 5.0, 8.0}) {
    PressedShape shape;
    shape.depth_mm = shape.surface_mm = depth;
    shape.force_n = 0.1 * depth * depth;
    for (const double r : table.radii_mm) {
      shape.down.push_back(std::exp(-r * r / 100.0));
      shape.outward.push_back(0.0);
    }
    table.shapes.push_back(shape);
  }
  return table;
}

TEST(FingerRadius, OfShippedStacksAFingertipFeelsWhatItDidAndOthersMoreTheLargerTheyAre) {
  std::vector<LayeredNode> without = libraryNodes(8.0);
  for (LayeredNode& node : without) node.fingers.clear();
  const LayeredTissue before(std::move(without));
  const LayeredTissue tissue(libraryNodes(8.0));
  EXPECT_FALSE(before.knowsRadius());
  EXPECT_TRUE(tissue.knowsRadius());
  for (const double thickness : {9.0, 14.0, 31.0, 62.0}) {
    for (const double depth : {0.3, 2.0, 5.5, 10.0, 16.0}) {
      const double fingertip = before.secantAt(thickness, depth);
      EXPECT_EQ(tissue.secantAt(thickness, depth), fingertip) << "to the bit";
      EXPECT_EQ(before.secantAt(thickness, depth, 16.0), fingertip) << "which knows no radius";
      double smaller = 0.0;
      for (const double radius : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 24.0}) {
        const double secant = tissue.secantAt(thickness, depth, radius);
        EXPECT_GT(secant, smaller) << thickness << " mm, depth " << depth << ", finger " << radius;
        smaller = secant;
      }
      EXPECT_EQ(tissue.secantAt(thickness, depth, 100.0), smaller);
    }
  }
}

TEST(CappedForce, IsTheIntegralOfTheSlopeHeldAtTheCap) {
  const ForceLaw law = libraryLaw();
  constexpr double kStep = 0.002;
  for (const PressedPlace place : {PressedPlace{9.0, 8.0}, PressedPlace{14.5, 10.0}, PressedPlace{40.0, 3.0}}) {
    const double stiffness = 0.4;
    for (const double cap : {0.1, 0.3, 0.6, 1.2, 50.0}) {
      double integral = 0.0;
      double before = 0.0;
      for (double depth = kStep; depth < 20.0; depth += kStep) {
        integral += std::min(cap, tangentStiffness(law, stiffness, depth - 0.5 * kStep, place)) * kStep;
        const double force = cappedForce(law.layers, stiffness, depth, place, cap);
        ASSERT_NEAR(force, integral, 1e-3 * (1.0 + integral)) << place.tissue_mm << " mm, " << depth << ", " << cap;
        ASSERT_LE(force, (1.0 + 1e-12) * normalForce(law, stiffness, depth, place)) << depth;
        ASSERT_LE(force - before, cap * kStep * (1.0 + 1e-6)) << depth;
        before = force;
      }
    }
  }
}

/// Solved apart: 35 mm with 8 mm of fat, which lies between the shipped stacks.
TEST(FingerRadius, OfShippedStacksIsThatOfFiniteElements) {
  const LayeredTissue tissue(libraryNodes(8.0));
  struct Solved {
    double finger_mm, depth_mm, force_n;
  };
  for (const auto& [finger, depth, force] : {Solved{2, 2, 0.202},
                                             {2, 5, 0.661},
                                             {4, 5, 0.932},
                                             {4, 8, 1.885},
                                             {12, 2, 0.380},
                                             {12, 5, 1.785},
                                             {12, 10, 6.021},
                                             {16, 5, 2.203},
                                             {16, 10, 7.726},
                                             {24, 10, 11.27}}) {
    EXPECT_NEAR(depth * tissue.secantAt(35.0, depth, finger) / force, 1.0, 0.03) << finger << " mm at " << depth;
  }
}

TEST(FingerRadius, TheLawIsThatOfTheTissueForEveryFinger) {
  const LayeredTissue tissue(libraryNodes(8.0));
  const ForceLaw law = libraryLaw();
  check(law);
  for (const double thickness : {9.0, 13.0, 22.0, 45.0, 62.0}) {
    const double map = tissue.secantAt(thickness, kReferenceDepthMm);
    for (const double radius : {1.0, 2.0, 3.0, 4.0, 8.0, 11.0, 16.0, 24.0, 50.0}) {
      for (const double depth : {0.5, 2.0, 5.0, 7.5, 10.0}) {
        const double force = depth * tissue.secantAt(thickness, depth, radius);
        EXPECT_NEAR(normalForce(law, map, depth, {thickness, radius}) / force, 1.0, 0.02)
            << thickness << " mm, depth " << depth << ", finger " << radius;
      }
    }
  }
}

TEST(FingerRadius, APointIsFeltAsTheFingertipUnlessTheLawSaysOtherwise) {
  ForceLaw law = libraryLaw();
  for (const double depth : {0.2, 3.0, 8.0, 13.0, 25.0}) {
    const double point = normalForce(law, 0.5, depth, 27.0);
    EXPECT_EQ(point, normalForce(law, 0.5, depth, {27.0, kFingertipMm}));
    law.layers.point_mm = 1.0;
    EXPECT_EQ(normalForce(law, 0.5, depth, 27.0), normalForce(law, 0.5, depth, {27.0, 1.0}));
    EXPECT_LT(normalForce(law, 0.5, depth, 27.0), 0.7 * point);
    law.layers.point_mm = kFingertipMm;
  }
  law.layers.knows_radius = false;
  EXPECT_EQ(normalForce(law, 0.5, 5.0, {27.0, 16.0}), normalForce(law, 0.5, 5.0, 27.0));
  law.layers.point_mm = 0.0;
  EXPECT_NE(support::thrownMessage([&] { check(law); }).find("radius of a point"), std::string::npos);
}

TEST(FingerRadius, NoFingersForceFallsAndNoneRisesSteeperThanTheLawSays) {
  std::vector<LayeredNode> nodes = libraryNodes(8.0);
  for (LayeredNode& node : nodes) node = softenedTo(kStiffestTissue, std::move(node));
  const LayeredTissue tissue(std::move(nodes));
  const ForceLaw law{.kind = ForceLaw::Kind::layered, .layers = tissue.forceRows()};
  for (const double radius : {1.0, 3.0, 4.0, 8.0, 14.0, 24.0}) {
    const double steepest = steepestFactor(law, 40.0, radius);
    for (const double thickness : {9.0, 14.0, 33.0, 62.0}) {
      const double map = tissue.secantAt(thickness, kReferenceDepthMm);
      double before = 0.0;
      for (double depth = 0.02; depth < 20.0; depth += 0.02) {
        const PressedPlace place{thickness, radius};
        const double force = normalForce(law, map, depth, place);
        EXPECT_GE(force, before) << radius << " mm on " << thickness << " mm at " << depth;
        EXPECT_LE(force - before, map * steepest * 0.02 * (1.0 + 1e-6));
        EXPECT_LE(force - before, 1.04 * kStiffestTissue * 0.02) << radius << " mm on " << thickness << " at " << depth;
        before = force;
      }
      const double slope =
          (normalForce(law, map, 5.2 + 1e-6, {thickness, radius}) - normalForce(law, map, 5.2, {thickness, radius})) /
          1e-6;
      EXPECT_NEAR(tangentStiffness(law, map, 5.2, {thickness, radius}), slope, 1e-3);
      EXPECT_NEAR(depthOf(law, normalForce(law, 1.0, 5.2, {thickness, radius}), PressedPlace{thickness, radius}), 5.2,
                  1e-9);
    }
  }
}

TEST(FingerRadius, ATableTakesItsOwnFingersOrElseThoseOfTheShippedStackLikeIt) {
  LayeredTable table = solvedTable();
  const LayeredTissue like({nodeOf(table)});
  const LayeredTissue library(libraryNodes(7.0));
  EXPECT_DOUBLE_EQ(like.secantAt(30.0, 5.0), 0.5);
  EXPECT_NEAR(like.secantAt(30.0, 5.0, 16.0) / 0.5, library.secantAt(30.0, 5.0, 16.0) / library.secantAt(30.0, 5.0),
              1e-9);
  table.fingers = {{4.0, {2.0, 5.0}, {0.2, 1.0}}, {16.0, {2.0, 5.0, 8.0}, {0.8, 5.0, 12.8}}};
  const LayeredTissue own({nodeOf(table)});
  EXPECT_DOUBLE_EQ(own.secantAt(30.0, 5.0), 0.5);
  EXPECT_DOUBLE_EQ(own.secantAt(30.0, 5.0, 16.0), 1.0);
  EXPECT_DOUBLE_EQ(own.secantAt(30.0, 5.0, 6.0), 0.35) << "halfway between 4 and 8 mm";
  EXPECT_DOUBLE_EQ(own.secantAt(30.0, 5.0, 1.0), 0.2) << "as the smallest";
  EXPECT_GT(8.0 * own.secantAt(30.0, 8.0, 4.0), 1.0) << "goes on where the solver did not";
  table.indenter_radius_mm = 16.0;
  table.fingers = {{8.0, {2.0, 5.0}, {0.2, 1.0}}};
  EXPECT_DOUBLE_EQ(LayeredTissue({nodeOf(table)}).secantAt(30.0, 5.0), 0.2) << "the map means a fingertip";
}

TEST(FingerRadius, ATableIsReadAsItWasWrittenAndAFaultInItNamed) {
  LayeredTable table = solvedTable();
  table.fingers = {{4.0, {2.0, 5.0}, {0.2, 1.0 / 3.0}}, {16.0, {2.0}, {0.8}}};
  const LayeredTable back = parseLayeredTable(layeredTableText(table), "t.json");
  ASSERT_EQ(back.fingers.size(), 2u);
  EXPECT_EQ(back.fingers[0].radius_mm, 4.0);
  EXPECT_EQ(back.fingers[0].depths_mm, table.fingers[0].depths_mm);
  EXPECT_EQ(back.fingers[0].force_n, table.fingers[0].force_n);
  const auto fault = [&](std::vector<FingerForces> fingers) {
    table.fingers = std::move(fingers);
    return support::thrownMessage([&] { check(table); });
  };
  EXPECT_EQ(fault({{8.0, {2.0}, {0.2}}}), "finger 1: radius_mm must differ from indenter_radius_mm, 8");
  EXPECT_EQ(fault({{4.0, {2.0}, {0.2}}, {2.0, {2.0}, {0.2}}}), "finger 2: radius_mm must increase, but 2 follows 4");
  EXPECT_EQ(fault({{4.0, {}, {}}}), "finger 1: depths_mm: at least one value is required");
  EXPECT_EQ(fault({{4.0, {2.0}, {}}}), "finger 1: force_n has 0 numbers for 1 depths");
  EXPECT_EQ(fault({{4.0, {2.0, 2.0}, {0.2, 0.3}}}), "finger 1: depths_mm must increase");
  EXPECT_EQ(fault({{4.0, {2.0, 3.0}, {0.2, 0.1}}}), "finger 1: force_n must not decrease");
  EXPECT_NE(fault({{4.0, {2.0}, {0.0}}}).find("finger 1: force_n, number 1, = 0"), std::string::npos);
}

}  // namespace
}  // namespace palpate::tissue
