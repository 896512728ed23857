#include "palpate/deform/region_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/deform/stage.h"
#include "palpate/base/gaussian.h"
#include "support/golden.h"

namespace palpate::deform {

using test::literally;
using test::vec3;

maps::SurfaceEllipse ellipseOfRow(const nlohmann::json& c) {
  return {vec3(c["OA"]), c["aspect_minor_over_major"].get<double>()};
}

double frameRatio(const RegionFrame& frame, const Vec3& offset) { return locate(frame, inPlane(frame, offset)).q; }

TEST(RegionFrame, TrueEllipseOfTheReference) {
  for (const auto& c : test::goldenRows("ellipse_q", "cases")) {
    const RegionFrame frame = ellipseFrame(ellipseOfRow(c), Vec3::UnitZ(), {});
    EXPECT_NEAR(frameRatio(frame, vec3(c["OD"])), c["q_ellipse"], 1e-12) << c;
  }
}

TEST(RegionFrame, PrintedRatioOfTheReference) {  // E14
  for (const auto& c : test::goldenRows("ellipse_q", "cases")) {
    const RegionFrame frame = ellipseFrame(ellipseOfRow(c), Vec3::UnitZ(), literally({Erratum::E14_location_ratio}));
    EXPECT_NEAR(frameRatio(frame, vec3(c["OD"])), c["q_printed_4_13"], 1e-12) << c;
  }
}

TEST(RegionFrame, ProjectsAlongTheNormal) {
  for (const auto& c : test::goldenRows("projection", "cases")) {
    const Vec3 normal = vec3(c["N"]);
    const maps::SurfaceEllipse circle{normal.unitOrthogonal(), 1.0};
    const RegionFrame frame = ellipseFrame(circle, normal, {});
    EXPECT_NEAR(frameRatio(frame, vec3(c["J"]) - vec3(c["O"])), (vec3(c["D"]) - vec3(c["O"])).norm(), 1e-12) << c;
  }
}

// The measured ratio (major/minor) put where (4.13) wants minor/major: the long side turns by 90 degrees.
TEST(RegionFrame, RatioTheWrongWayRoundTurnsTheLongSide) {  // E15
  const maps::SurfaceEllipse ellipse{Vec3(100, 0, 0), 0.5};
  for (const FormSettings& forms :
       {literally({Erratum::E15_aspect}), literally({Erratum::E14_location_ratio, Erratum::E15_aspect})}) {
    const RegionFrame frame = ellipseFrame(ellipse, Vec3::UnitZ(), forms);
    EXPECT_NEAR(frameRatio(frame, Vec3(100, 0, 0)), 1.0, 1e-12);
    EXPECT_NEAR(frameRatio(frame, Vec3(0, 200, 0)), 1.0, 1e-12) << "4 times the area";
  }
}

TEST(RegionFrame, PedalCurveReachesBeyondTheEllipse) {  // E14
  const maps::SurfaceEllipse ellipse{Vec3(100, 0, 0), 1.0 / 1.357};
  const RegionFrame exact = ellipseFrame(ellipse, Vec3::UnitZ(), {});
  const RegionFrame printed = ellipseFrame(ellipse, Vec3::UnitZ(), literally({Erratum::E14_location_ratio}));
  double reach = 0.0;
  for (double angle = 0.0; angle < 6.3; angle += 0.01) {
    const Vec3 offset(std::cos(angle), std::sin(angle), 0.0);
    reach = std::max(reach, frameRatio(exact, offset) / frameRatio(printed, offset));
  }
  EXPECT_NEAR(reach, (1.357 + 1.0 / 1.357) / 2.0, 1e-4) << "4.7 % at P4";
}

TEST(RegionFrame, CentreIsZeroInEveryShape) {
  const maps::SurfaceEllipse ellipse{Vec3(100, 0, 0), 0.5};
  EXPECT_EQ(frameRatio(ellipseFrame(ellipse, Vec3::UnitZ(), {}), Vec3::Zero()), 0.0);
  EXPECT_EQ(frameRatio(ellipseFrame(ellipse, Vec3::UnitZ(), literally({Erratum::E14_location_ratio})), Vec3::Zero()),
            0.0);
  const auto contour = maps::contourOf(std::vector<double>{10, 20, 30});
  EXPECT_EQ(frameRatio(contourFrame({contour, Vec3::UnitX(), Vec3::UnitY()}, Vec3::UnitZ()), Vec3::Zero()), 0.0);
}

TEST(RegionFrame, ContourIsThatOfTheMaps) {
  const maps::PolarContour contour = maps::contourOf(std::vector<double>{10, 20, 15, 30, 12});
  Random random(3);
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0.3, 0.2, 0.9), Vec3(0.2, -0.1, -1)}) {
    const auto surface = maps::contourOnSurface(contour, normal);
    const RegionFrame frame = contourFrame(surface, normal.normalized());
    for (int i = 0; i < 100; ++i) {
      const Vec3 offset = random.uniform(-30, 30) * surface.axis_x + random.uniform(-30, 30) * surface.axis_y;
      EXPECT_NEAR(frameRatio(frame, offset + 3.0 * normal), maps::locationRatio(surface, offset), 1e-9);
    }
  }
}

TEST(RegionFrame, SlopeIsTheDerivativeInEveryShape) {
  const maps::SurfaceEllipse ellipse{Vec3(40, 10, 0), 0.6};
  const auto contour = maps::contourOf(std::vector<double>{30, 20, 35, 25, 28, 40, 22, 31});
  const RegionFrame frames[] = {
      ellipseFrame(ellipse, Vec3::UnitZ(), {}),
      ellipseFrame(ellipse, Vec3::UnitZ(), literally({Erratum::E14_location_ratio})),
      ellipseFrame(ellipse, Vec3::UnitZ(), literally({Erratum::E14_location_ratio, Erratum::E15_aspect})),
      contourFrame({contour, Vec3::UnitX(), Vec3::UnitY()}, Vec3::UnitZ())};
  Random random(8);
  constexpr double kStep = 1e-5;
  for (const RegionFrame& frame : frames) {
    for (int i = 0; i < 200; ++i) {
      const Vec2 at = random.uniform2(-40, 40);
      if (at.norm() < 1.0) continue;
      for (int axis = 0; axis < 2; ++axis) {
        const Vec2 step = kStep * Vec2::Unit(axis);
        const double expected = (locate(frame, at + step).q - locate(frame, at - step).q) / (2 * kStep);
        EXPECT_NEAR(locate(frame, at).slope[axis], expected, 1e-6);
      }
    }
  }
}

TEST(RegionFrame, DegenerateRegionsHoldNothing) {
  const RegionFrame none = ellipseFrame({Vec3::Zero(), 1.0}, Vec3::UnitZ(), {});
  EXPECT_FALSE(none.acts());
  EXPECT_GE(locate(none, Vec2::Zero()).q, 1.0);
  EXPECT_FALSE(ellipseFrame({Vec3(0, 0, 5), 1.0}, Vec3::UnitZ(), {}).acts()) << "an axis along the normal";
  EXPECT_FALSE(contourFrame({}, Vec3::UnitZ()).acts());
}

Contact contactWithEllipse() {
  Contact contact;
  contact.normal_region = normalRegion(contact.normal, 5.0, {});
  contact.tangential_region = {Vec3(100, 0, 0), 0.7};
  contact.tangential_contour = maps::contourOnSurface(maps::contourOf(std::vector<double>{10, 20, 30}), contact.normal);
  return contact;
}

TEST(FormedRegions, DefaultLeavesTheContactAsItIs) {
  const Contact contact = formedRegions(contactWithEllipse(), {});
  EXPECT_EQ(contact.normal_region.half_major, contactWithEllipse().normal_region.half_major);
  EXPECT_EQ(contact.tangential_region.half_major, Vec3(100, 0, 0));
}

TEST(FormedRegions, ConstantDoesNotGrowWithDepth) {
  FormSettings forms;
  forms.region = NormalRegion::constant;
  EXPECT_NEAR(formedRegions(contactWithEllipse(), forms).normal_region.half_major.norm(), 13.2, 1e-12);
}

TEST(FormedRegions, OneEllipseForBothPartsByChoiceOrAsPrinted) {  // E21
  FormSettings shared;
  shared.region = NormalRegion::shared;
  for (const FormSettings& forms : {shared, literally({Erratum::E21_press_region})}) {
    const Contact contact = formedRegions(contactWithEllipse(), forms);
    EXPECT_EQ(contact.normal_region.half_major, Vec3(100, 0, 0));
    EXPECT_EQ(contact.normal_region.aspect, 0.7);
  }
}

// With a 20 mm drag, the half Gaussian is worth 2 mm where the boundary was measured (E20).
TEST(FormedRegions, TwoMillimetreBoundaryPutsTwoMillimetresThere) {
  FormSettings forms;
  forms.boundary = Boundary::two_mm;
  const Contact contact = formedRegions(contactWithEllipse(), forms);
  EXPECT_NEAR(contact.tangential_region.half_major.norm() / 100.0, 1.635, 5e-4);
  EXPECT_NEAR(20.0 * halfGaussian(100.0 / contact.tangential_region.half_major.norm()), 2.0, 1e-9);
  EXPECT_NEAR(maps::radiusAt(contact.tangential_contour.contour, 0.0), 16.35, 5e-3);
}

}  // namespace palpate::deform
