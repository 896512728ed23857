#include "palpate/view/camera.h"

#include <gtest/gtest.h>

#include "support/error_message.h"

namespace palpate::view {
namespace {

constexpr double kWideAspect = 16.0 / 9.0;

TEST(Camera, SeesTheBackFromBehindWithTheHeadUp) {
  const Camera camera;
  EXPECT_TRUE(camera.backward().isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(camera.up().isApprox(Vec3::UnitY()));
  EXPECT_TRUE(camera.right().isApprox(Vec3::UnitX())) << "the patient's right is on the right";
}

TEST(Camera, AStandardViewLooksFromItsSide) {
  const Eigen::AlignedBox3d box(Vec3(-200, -300, -100), Vec3(200, 260, 130));
  const auto from = [&](StandardView side) { return fitted(box, kWideAspect, side).backward(); };
  EXPECT_TRUE(from(StandardView::back).isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(from(StandardView::left).isApprox(-Vec3::UnitX()));
  EXPECT_TRUE(from(StandardView::right).isApprox(Vec3::UnitX()));
  EXPECT_TRUE(from(StandardView::front).isApprox(-Vec3::UnitZ()));
  EXPECT_TRUE(from(StandardView::below).isApprox(-Vec3::UnitY(), 2e-3)) << "a hair beside it";
  EXPECT_TRUE(from(StandardView::above).isApprox(Vec3::UnitY(), 2e-3)) << "a hair beside it";
}

TEST(Camera, FromBesideATableABodyLiesOnItsFrontWithItsHeadToTheLeft) {
  const Eigen::AlignedBox3d box(Vec3(-200, -300, -100), Vec3(200, 260, 130));
  const Camera camera = fitted(box, kWideAspect, StandardView::table);
  EXPECT_TRUE(camera.right().isApprox(-Vec3::UnitY())) << "the head is to the left";
  EXPECT_GT(camera.up().z(), 0.7) << "the back is up";
  EXPECT_LT(camera.backward().x(), -0.5) << "from the body's left";
  EXPECT_GT(camera.backward().z(), 0.5) << "and from above";
}

TEST(Camera, FitsABoxFromEverySide) {
  const Eigen::AlignedBox3d box(Vec3(-200, -300, -100), Vec3(200, 260, 130));
  for (const auto side : {StandardView::back, StandardView::left, StandardView::right, StandardView::above,
                          StandardView::front, StandardView::table, StandardView::below}) {
    const Camera camera = fitted(box, kWideAspect, side);
    const Frustum frustum = makeFrustum(cameraScreen(camera, kWideAspect), camera.eye(), 1.0, 5000.0);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec2 seen = seenAt(frustum, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
      EXPECT_TRUE((seen.array() >= 0.0).all() && (seen.array() <= 1.0).all())
          << kStandardViewNames[static_cast<int>(side)] << " " << seen.transpose();
    }
  }
}

TEST(Camera, FitsABoxHoweverItIsTurned) {
  const Eigen::AlignedBox3d box(Vec3(-180.0, -260.0, -110.0), Vec3(170.0, 250.0, 100.0));
  for (const double aspect : {0.6, 1.0, kWideAspect}) {
    for (const double yaw : {0.0, 0.5, 1.2, 2.5}) {
      for (const double pitch : {-1.0, 0.0, 0.7}) {
        const Camera camera = fitted(box, aspect, Camera{.yaw_rad = yaw, .pitch_rad = pitch, .height_rad = 0.3});
        const Frustum frustum = makeFrustum(cameraScreen(camera, aspect), camera.eye(), 1.0, 9000.0);
        for (int corner = 0; corner < 8; ++corner) {
          const Vec2 seen = seenAt(frustum, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
          EXPECT_TRUE((seen.array() >= 0.0).all() && (seen.array() <= 1.0).all())
              << aspect << " " << yaw << " " << pitch << ": " << seen.transpose();
        }
      }
    }
  }
}

TEST(Frustum, OfAnEyeBeforeTheMiddleOfTheScreenIsThePlainPerspective) {
  Camera camera;
  camera.distance_mm = 600.0;
  const Frustum frustum = makeFrustum(cameraScreen(camera, kWideAspect), camera.eye(), 10.0, 2000.0);
  const float cotangent = static_cast<float>(1.0 / std::tan(0.5 * camera.height_rad));
  EXPECT_NEAR(frustum.projection(1, 1), cotangent, 1e-5);
  EXPECT_NEAR(frustum.projection(0, 0), cotangent / kWideAspect, 1e-5);
  EXPECT_NEAR(frustum.projection(0, 2), 0.0, 1e-6);
}

TEST(Frustum, OfAnEyeAsideKeepsTheScreenWhereItIs) {
  const Camera camera;
  const Screen screen = cameraScreen(camera, kWideAspect);
  for (const double aside : {-31.5, 0.0, 31.5}) {
    const Frustum frustum = makeFrustum(screen, camera.eye() + aside * camera.right(), 10.0, 5000.0);
    EXPECT_TRUE(seenAt(frustum, screen.lower_left).isApprox(Vec2(0.0, 1.0), 1e-4) ||
                (seenAt(frustum, screen.lower_left) - Vec2(0.0, 1.0)).norm() < 1e-4);
    EXPECT_LT((seenAt(frustum, screen.lower_right) - Vec2(1.0, 1.0)).norm(), 1e-4);
    EXPECT_LT((seenAt(frustum, camera.centre) - Vec2(0.5, 0.5)).norm(), 1e-4);
  }
}

TEST(Frustum, ShiftsAPointByTheParallaxOfItsDistance) {
  Camera camera;
  camera.distance_mm = 600.0;
  const Screen screen = cameraScreen(camera, kWideAspect);
  const double width = (screen.lower_right - screen.lower_left).norm();
  constexpr double kEyes = 63.0;
  const Vec3 half = 0.5 * kEyes * camera.right();
  const Frustum left = makeFrustum(screen, camera.eye() - half, 10.0, 5000.0);
  const Frustum right = makeFrustum(screen, camera.eye() + half, 10.0, 5000.0);
  for (const double beyond : {-120.0, 0.0, 300.0}) {
    const Vec3 point = camera.centre - beyond * camera.backward();
    const double parallax = width * (seenAt(right, point).x() - seenAt(left, point).x());
    EXPECT_NEAR(parallax, kEyes * (1.0 - 600.0 / (600.0 + beyond)), 1e-3) << beyond;
  }
}

TEST(Frustum, NeedsAnEyeBeforeTheScreen) {
  const Camera camera;
  const Vec3 behind = camera.centre - camera.backward();
  EXPECT_EQ(support::thrownMessage([&] { makeFrustum(cameraScreen(camera, 1.0), behind, 1.0, 10.0); }),
            "the eye must be in front of the screen");
}

TEST(Ray, ThroughAPlaceOfTheScreenMeetsWhatIsSeenThere) {
  Camera camera;
  camera.yaw_rad = 0.4;
  camera.pitch_rad = 0.2;
  const Screen screen = cameraScreen(camera, kWideAspect);
  const Frustum frustum = makeFrustum(screen, camera.eye(), 10.0, 5000.0);
  const Ray ray = rayThrough(screen, camera.eye(), 0.3, 0.8);
  EXPECT_LT((seenAt(frustum, ray.origin + 700.0 * ray.direction) - Vec2(0.3, 0.8)).norm(), 1e-5);
}

}  // namespace
}  // namespace palpate::view
