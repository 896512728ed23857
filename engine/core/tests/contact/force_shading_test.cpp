#include "palpate/contact/surface_walk.h"

#include <algorithm>

#include "core/tests/contact/finger_track.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

namespace {

/// Largest change of force per tick on a circle 2 mm under the skin of a coarse ball of 20 mm.
double roughness(const Surface& ball, bool shading) {
  FingerSettings settings;
  settings.mu_static = settings.mu_dynamic = 0.0;
  settings.force_shading = shading;
  FingerTrack finger(ball, settings);
  const auto at = [](double angle, double radius) {
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 3.0);
  };
  finger.to(at(0, 25));
  FingerOutput last = finger.slide(at(0, 17), 0.1);
  double worst = 0.0;
  for (double angle = 0.01; angle < 6.0; angle += 0.01) {
    const FingerOutput now = finger.to(at(angle, 17));
    worst = std::max(worst, (now.force - last.force).norm());
    last = now;
  }
  return worst;
}

}  // namespace

TEST(ForceShading, MakesACoarseBallSmooth) {
  const Surface ball = surfaceOf(zoo::sphere(20.0, 2));
  const double faceted = roughness(ball, false);
  const double shaded = roughness(ball, true);
  EXPECT_LT(shaded, 0.5 * faceted) << faceted << " N without";
  EXPECT_LT(shaded, 0.05);
}

TEST(ForceShading, FindsThePlaceWhoseNormalMeetsTheTip) {
  const Surface ball = surfaceOf(zoo::sphere(20.0, 2));
  for (const Vec3& direction : {Vec3(1, 2, 3), Vec3(-3, 0.5, 1), Vec3(0.2, 0.1, -1)}) {
    const Vec3 tip = 17.0 * direction.normalized();
    const auto nearest = nearestPoint(ball.geometry->tree, tip, 30.0);
    const auto shaded = shadedProxy(ball, {nearest.closest.point, nearest.triangle, nearest.closest.feature}, tip);
    ASSERT_TRUE(shaded.has_value());
    EXPECT_NEAR((shaded->position - shaded->depth_mm * shaded->normal - tip).norm(), 0, 1e-9);
    EXPECT_GT(shaded->normal.dot(direction.normalized()), 0.999) << "nearly radial, unlike the facet's";
  }
}

TEST(ForceShading, FallsBackToTheFacetsAtABorder) {
  const Surface plate = surfaceOf(zoo::grid(4, 100.0));
  FingerSettings settings;
  settings.force_shading = true;
  FingerTrack finger(plate, settings);
  finger.to({50, 50, 5});
  const FingerOutput inside = finger.to({50, 50, -5});
  EXPECT_NEAR((inside.force - Vec3(0, 0, 2.5)).norm(), 0, 1e-9) << "a flat plate is what it was";
  const FingerOutput beyond = finger.slide({102, 50, -5}, 0.5);
  EXPECT_NE(beyond.status & kAtBorder, 0u);
}

}  // namespace palpate::contact
