// Tables of stacks become curves and the rows of a force law; blends between them keep what must not be lost.
#include "palpate/tissue/layered_tissue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"

namespace palpate::tissue {
namespace {

/// A stack whose answers are closed forms: softer and wider the thicker it is.
LayeredTable tableOf(double thickness_mm, std::vector<double> depths = {1, 2, 4, 6, 8, 10}) {
  LayeredTable table;
  table.stack.layers = {{"skin", 2.0, 150.0}, {"muscle", thickness_mm - 2.0, 27.0}};
  for (int i = 0; i <= 120; ++i) table.radii_mm.push_back(i);
  for (const double depth : depths) {
    PressedShape shape;
    shape.depth_mm = shape.surface_mm = depth;
    shape.force_n = 12.0 / thickness_mm * std::pow(depth / 8.0, 1.6) * 8.0;
    shape.contact_radius_mm = 4.0;
    const double width = 8.0 + 0.1 * thickness_mm + 0.3 * depth;
    for (const double r : table.radii_mm) {
      shape.down.push_back(std::exp(-r * r / (width * width)));
      shape.outward.push_back(-0.1 * r / width * std::exp(0.5 - 0.5 * r * r / (width * width)));
    }
    table.shapes.push_back(shape);
  }
  table.drag = DragShape{0.83, 14.0, 8.0, 0.6 + 0.01 * thickness_mm, {}, {}};
  return table;
}

LayeredTissue tissueOf(std::initializer_list<double> thicknesses) {
  std::vector<LayeredNode> nodes;
  for (const double thickness : thicknesses) nodes.push_back(nodeOf(tableOf(thickness)));
  return LayeredTissue(std::move(nodes));
}

double downAt(const PressCurves& curves, double r) {
  const double q = r / curves.radius_mm;
  return curveAt(curves.down, kPressBend, q * q).value;
}

TEST(LayeredTissueOfTables, GivesBackATableAtItsOwnThicknessAndDepths) {
  const LayeredTissue tissue = tissueOf({12, 40});
  const LayeredTable table = tableOf(40);
  for (const PressedShape& shape : table.shapes) {
    const PressCurves curves = tissue.pressAt(40, shape.depth_mm);
    for (std::size_t i = 0; i < table.radii_mm.size(); ++i) {
      const double r = table.radii_mm[i];
      const double q = r / curves.radius_mm;
      EXPECT_NEAR(downAt(curves, r), shape.down[i], 0.01) << shape.depth_mm << " mm, r " << r;
      EXPECT_NEAR(q * curveAt(curves.outward, kPressBend, q * q).value, shape.outward[i], 0.01) << r;
    }
    EXPECT_NEAR(tissue.secantAt(40, shape.depth_mm), shape.force_n / shape.depth_mm, 1e-12);
  }
}

TEST(LayeredTissueOfTables, BlendsBetweenThicknessesAndDepths) {
  const LayeredTissue tissue = tissueOf({12, 20, 30, 45});
  for (const double thickness : {15.0, 25.0, 37.0}) {
    const LayeredTable solved = tableOf(thickness, {5});
    const PressCurves curves = tissue.pressAt(thickness, 5);
    for (std::size_t i = 0; i < 40; ++i)
      EXPECT_NEAR(downAt(curves, static_cast<double>(i)), solved.shapes[0].down[i], 0.025);
    EXPECT_NEAR(tissue.secantAt(thickness, 5) / (solved.shapes[0].force_n / 5), 1.0, 0.03);
    EXPECT_NEAR(tissue.tangentialAt(thickness), solved.drag->tangential_over_normal, 0.01);
  }
}

TEST(LayeredTissueOfTables, TheMiddleAlwaysFollowsAndTheRimNeverMoves) {
  const LayeredTissue tissue = tissueOf({12, 40});
  for (const double thickness : {5.0, 12.0, 17.3, 40.0, 80.0}) {
    for (const double depth : {0.0, 0.3, 3.3, 10.0, 30.0}) {
      const PressCurves curves = tissue.pressAt(thickness, depth);
      EXPECT_NEAR(downAt(curves, 0.0), 1.0, 1e-9);
      EXPECT_EQ(downAt(curves, curves.radius_mm), 0.0);
      EXPECT_NEAR(downAt(curves, curves.radius_mm * (1 - 1e-6)), 0.0, 1e-9);
    }
    EXPECT_NEAR(curveAt(tissue.dragAt(thickness).share, kDragBend, 0.0).value, 1.0, 1e-9);
  }
}

TEST(LayeredTissueOfTables, ADragHasATenthLeftWhereItSays) {
  const DragCurve drag = tissueOf({40}).dragAt(40);
  EXPECT_NEAR(curveAt(drag.share, kDragBend, drag.tenth_q * drag.tenth_q).value, 0.1, 1e-9);
  const double tenth_mm = 14.0 * std::sqrt(std::pow(10.0, 1.0 / 0.83) - 1.0);
  EXPECT_NEAR(drag.tenth_q * drag.along_mm, tenth_mm, 0.1 * tenth_mm) << "the tail is faded out beyond";
}

TEST(LayeredForceRows, AreTheForcesOfTheTissue) {
  const LayeredTissue tissue = tissueOf({9, 15, 27, 60});
  ForceLaw law;
  law.kind = ForceLaw::Kind::layered;
  law.layers = tissue.forceRows();
  check(law);
  for (const double thickness : {9.0, 11.0, 15.0, 22.0, 27.0, 41.0, 60.0}) {
    const double map = tissue.secantAt(thickness, kReferenceDepthMm);
    for (const double depth : {0.5, 2.0, 3.25, 5.0, 7.5, 8.0, 10.0}) {
      const double force = tissue.secantAt(thickness, depth) * depth;
      EXPECT_NEAR(normalForce(law, map, depth, thickness) / force, 1.0, 0.02) << thickness << " mm, depth " << depth;
    }
    EXPECT_NEAR(normalForce(law, 0.5, kReferenceDepthMm, thickness), 4.0, 1e-9) << "whatever the map says";
  }
}

TEST(LayeredForceRows, RiseSteadilyAndNoSteeperThanTheySay) {
  ForceLaw law;
  law.kind = ForceLaw::Kind::layered;
  law.layers = tissueOf({9, 60}).forceRows();
  const double steepest = steepestFactor(law, 40.0);
  for (const double thickness : {5.0, 9.0, 14.0, 33.0, 60.0, 200.0}) {
    double before = 0.0;
    for (double depth = 0.01; depth < 40.0; depth += 0.01) {
      const double force = normalForce(law, 1.0, depth, thickness);
      EXPECT_GE(force, before);
      EXPECT_LE(force - before, steepest * 0.01 * (1 + 1e-6)) << thickness << " mm, depth " << depth;
      const double tangent = (normalForce(law, 1.0, depth + 1e-6, thickness) - force) / 1e-6;
      EXPECT_NEAR(tangentStiffness(law, 1.0, depth + 5e-7, thickness), tangent, 1e-3);
      before = force;
    }
  }
}

TEST(LayeredForceRows, WithoutLayersTheLawIsHookes) {
  ForceLaw law;
  law.kind = ForceLaw::Kind::layered;
  EXPECT_EQ(normalForce(law, 0.5, 6.0, 20.0), 3.0);
  EXPECT_EQ(respond(law, 0.5, 6.0, 20.0).tangential, 1.0);
  EXPECT_EQ(steepestFactor(law, 40.0), 1.0);
}

TEST(LayeredForceRows, OfASoftenedNodeRiseNoSteeperThanWasAsked) {
  const LayeredNode stiff = nodeOf(tableOf(9, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  const LayeredTissue tissue({softenedTo(0.9, stiff)});
  double before = 0.0;
  for (double depth = 0.01; depth < 14.0; depth += 0.01) {
    const double force = tissue.secantAt(9, depth) * depth;
    EXPECT_LE(force - before, 0.9 * 0.01 * (1 + 1e-6)) << depth;
    before = force;
  }
  EXPECT_EQ(tissue.secantAt(9, 1), stiff.secants[0]) << "what is soft enough stays";
}

TEST(LayeredTissueOfTables, RefusesWhatIsNoTissue) {
  EXPECT_THROW(LayeredTissue({}), Error);
  EXPECT_THROW(tissueOf({20, 20}), Error);
  LayeredTable few = tableOf(20);
  few.radii_mm = {0.0};
  EXPECT_THROW(nodeOf(few), Error);
}

}  // namespace
}  // namespace palpate::tissue
