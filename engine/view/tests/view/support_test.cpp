// The table and the seat: their shape, and how they are seen with the body on them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "palpate/view/support_shape.h"
#include "support/changed_body.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kSupportPicture{320, 240, 1};

/// A ball of 200 mm that lies on, or sits on, a plane that touches it.
std::shared_ptr<const scene::World> ballOn(const std::optional<Vec3>& up) {
  auto world = std::make_shared<scene::World>(*meshWorld(zoo::sphere(100.0, 4, {10.0, 20.0, 30.0})));
  support::changeBody(*world, [&](scene::Body& body) {
    body.closed = true;
    if (up) body.anatomy.support = body::Support{Vec3(10.0, 20.0, 30.0) - 100.0 * *up, *up};
  });
  return world;
}

TEST(SupportShape, ATableIsWideAndASeatIsSmallAndBothLieJustOutsideTheBody) {
  for (const bool sits : {false, true}) {
    const Vec3 up = sits ? Vec3::UnitY() : Vec3::UnitZ();
    const auto world = ballOn(up);
    const auto slab = supportSlab(*world);
    ASSERT_TRUE(slab);
    EXPECT_EQ(slab->up, up);
    const double below = -slab->middle.dot(up) + world->body->anatomy.support->point.dot(up);
    EXPECT_GT(below, 0.05);
    EXPECT_LT(below, 1.0);
    const Vec3 size = slab->box().sizes();
    EXPECT_NEAR(size.x(), sits ? 480.0 : 700.0, 1e-9);
    EXPECT_GT(sits ? size.z() : size.y(), 200.0) << "longer than the body";
    EXPECT_LT(sits ? size.y() : size.z(), 100.0) << "as thin as padding is";
    EXPECT_TRUE(slab->box().contains(Vec3(10.0, 20.0, 30.0) - 130.0 * up)) << "below the body";
  }
  EXPECT_FALSE(supportSlab(*ballOn(std::nullopt)));
}

TEST(SupportShape, IsClosedAndFacesOutward) {
  const auto world = ballOn(Vec3::UnitZ());
  const auto slab = supportSlab(*world);
  const SupportShape shape = supportShape(*slab, *world);
  double volume = 0.0;
  for (const Triangle& t : shape.triangles) {
    const Vec3 a = shape.vertices[t[0]].place.cast<double>(), b = shape.vertices[t[1]].place.cast<double>(),
               c = shape.vertices[t[2]].place.cast<double>();
    volume += (a - slab->middle).dot((b - slab->middle).cross(c - slab->middle)) / 6.0;
  }
  const Vec3 size = slab->box().sizes();
  EXPECT_GT(volume, 0.93 * size.prod()) << "a box with round edges, turned outward";
  EXPECT_LT(volume, size.prod());
  for (const SupportVertex& vertex : shape.vertices) {
    EXPECT_NEAR(vertex.normal.norm(), 1.0f, 1e-4f);
    EXPECT_LE(vertex.place.z(), slab->middle.z() + 1e-3) << "nothing above its top";
  }
}

TEST(SupportShape, IsDarkestBelowTheBodyAndLightAtItsRim) {
  const auto world = ballOn(Vec3::UnitZ());
  const auto slab = supportSlab(*world);
  double under = 1.0, beside = 0.0, rim = 0.0;
  for (const SupportVertex& vertex : supportShape(*slab, *world).vertices) {
    const Vec3 off = vertex.place.cast<double>() - slab->middle;
    if (off.head<2>().norm() < 60.0 && vertex.normal.z() > 0.9f) under = std::min(under, double{vertex.sky});
    const bool aside = off.head<2>().norm() > 60.0 && off.head<2>().norm() < 90.0;  // the ball is 20 mm above and more
    if (aside && vertex.normal.z() > 0.9f) beside = std::max(beside, double{vertex.sky});
    if (off.x() > 320.0 && vertex.normal.z() > 0.9f) rim = std::max(rim, double{vertex.sky});
  }
  EXPECT_LT(under, 0.3);
  EXPECT_LT(beside, 0.6);
  EXPECT_GT(rim, 0.9);
}

PictureSettings lookingFrom(double yaw_deg, double pitch_deg) {
  PictureSettings settings;
  settings.camera.centre = {10.0, 20.0, 30.0};
  settings.camera.yaw_rad = kRadPerDeg * yaw_deg;
  settings.camera.pitch_rad = kRadPerDeg * pitch_deg;
  settings.camera.distance_mm = 1200.0;
  settings.camera.height_rad = 0.5;
  settings.labels = LabelSettings::none();
  return settings;
}

Image ballPicture(const std::shared_ptr<const scene::World>& world, const PictureSettings& settings) {
  return picture(world, deform::DeformedSurface(*world->deformable), {}, settings, kSupportPicture);
}

/// Pixels that differ; `in_body`: of those that the ball alone covers, seen from straight behind.
struct BallDifferences {
  int in_body = 0;
  int elsewhere = 0;
};
BallDifferences ballDifferences(const Image& a, const Image& b) {
  const double pixels_per_mm = kSupportPicture.height / (2.0 * 1200.0 * std::tan(0.25));
  BallDifferences found;
  for (int y = 0; y < kSupportPicture.height; ++y) {
    for (int x = 0; x < kSupportPicture.width; ++x) {
      if (a.at(x, y) == b.at(x, y)) continue;
      const bool body =
          std::hypot(x - 0.5 * kSupportPicture.width, y - 0.5 * kSupportPicture.height) < 97.0 * pixels_per_mm;
      (body ? found.in_body : found.elsewhere) += 1;
    }
  }
  return found;
}

TEST(SupportInPictures, LiesBehindTheBodyAndNeverOnIt) {
  const PictureSettings behind = lookingFrom(0.0, 0.0);
  const BallDifferences seen =
      ballDifferences(ballPicture(ballOn(Vec3::UnitZ()), behind), ballPicture(ballOn({}), behind));
  EXPECT_EQ(seen.in_body, 0);
  EXPECT_GT(seen.elsewhere, 20000);
}

TEST(SupportInPictures, DoesNotHideTheBodyFromBelow) {
  const PictureSettings below = lookingFrom(180.0, 0.0);
  const BallDifferences seen =
      ballDifferences(ballPicture(ballOn(Vec3::UnitZ()), below), ballPicture(ballOn({}), below));
  EXPECT_EQ(seen.in_body + seen.elsewhere, 0);
}

TEST(SupportInPictures, IsSeenThroughSkinAndInBothEyesButNotInCutOuts) {
  const auto with = ballOn(Vec3::UnitZ());
  const auto without = ballOn({});
  PictureSettings settings = lookingFrom(40.0, 25.0);
  settings.look.skin_opacity = 0.4;
  EXPECT_GT(ballDifferences(ballPicture(with, settings), ballPicture(without, settings)).in_body, 500);
  settings.stereo.mode = StereoMode::sbs_half;
  EXPECT_GT(ballDifferences(ballPicture(with, settings), ballPicture(without, settings)).elsewhere, 5000);
  settings.look.plain_background = 1.0;
  const BallDifferences cut = ballDifferences(ballPicture(with, settings), ballPicture(without, settings));
  EXPECT_EQ(cut.in_body + cut.elsewhere, 0);
}

TEST(SupportInPictures, IsWholeFromTheSideWhereItsEdgeIsNearest) {
  // Its edge is nearer to the eye than the body by more than what the near plane leaves for balls and marks.
  PictureSettings side = lookingFrom(90.0, 0.0);
  side.camera.distance_mm = 480.0;
  side.camera.height_rad = 1.4;
  const Vec2 size(kSupportPicture.width, kSupportPicture.height);
  const Frustum frustum = makeFrustum(cameraScreen(side.camera, size.x() / size.y()), side.camera.eye(), 1.0, 1e4);
  const Vec2 edge = seenAt(frustum, Vec3(335.0, 20.0, -70.3)).cwiseProduct(size);
  const Image with = ballPicture(ballOn(Vec3::UnitZ()), side);
  const Image without = ballPicture(ballOn({}), side);
  const int x = static_cast<int>(edge.x()), y = static_cast<int>(edge.y());
  EXPECT_NE(with.at(x, y), without.at(x, y));
}

TEST(SupportInPictures, LeavesTheCameraAsItIs) {
  const scene::ViewSettings view;
  for (const double aspect : {0.7, 1.8}) {
    const Camera with = pictureSettings(*ballOn(Vec3::UnitZ()), view, aspect).camera;
    const Camera without = pictureSettings(*ballOn({}), view, aspect).camera;
    EXPECT_EQ(with.centre, without.centre);
    EXPECT_EQ(with.distance_mm, without.distance_mm);
    EXPECT_EQ(with.height_rad, without.height_rad);
  }
}

}  // namespace
}  // namespace palpate::view
