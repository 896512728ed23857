#include "palpate/view/stereo.h"

#include <gtest/gtest.h>

#include "support/error_message.h"

namespace palpate::view {
namespace {

constexpr double kScreenAspect = 16.0 / 9.0;

Camera cameraAt(double distance_mm) {
  Camera camera;
  camera.distance_mm = distance_mm;
  return camera;
}

StereoSettings settingsOf(StereoMode mode) {
  StereoSettings settings;
  settings.mode = mode;
  return settings;
}

/// Horizontal shift from the left eye's picture to the right eye's, mm on the screen.
double parallaxOf(const Camera& camera, const StereoSettings& settings, const Vec3& place) {
  const Eyes eyes = placeEyes(camera, settings, kScreenAspect);
  const double width_mm = (eyes.screen.lower_right - eyes.screen.lower_left).norm();
  const DepthRange range{1.0, 1e5};
  return width_mm * (seenAt(makeFrustum(eyes, Eye::right, range), place).x() -
                     seenAt(makeFrustum(eyes, Eye::left, range), place).x());
}

TEST(Eyes, SeeEachPlaceWithTheParallaxOfItsDistance) {
  Camera camera = cameraAt(600.0);
  camera.yaw_rad = 0.5;
  for (const double convergence : {0.0, 450.0, 900.0}) {
    StereoSettings settings = settingsOf(StereoMode::sbs_full);
    settings.convergence_mm = convergence;
    const double screen = convergence > 0.0 ? convergence : 600.0;
    for (const double z : {400.0, 600.0, 1500.0}) {
      const Vec3 place = camera.eye() - z * camera.backward() + 40.0 * camera.right() + 25.0 * camera.up();
      EXPECT_NEAR(parallaxOf(camera, settings, place), 63.0 * (1.0 - screen / z), 0.01) << convergence << " " << z;
    }
  }
}

TEST(Eyes, CoincideInMonoAndAtNoEyeDistance) {
  StereoSettings settings = settingsOf(StereoMode::tb_half);
  settings.eye_distance_mm = 0.0;
  EXPECT_EQ(placeEyes(cameraAt(700.0), settings, kScreenAspect).left,
            placeEyes(cameraAt(700.0), settings, kScreenAspect).right);
  const Eyes mono = placeEyes(cameraAt(700.0), settingsOf(StereoMode::mono), kScreenAspect);
  EXPECT_EQ(mono.left, mono.right);
}

TEST(Eyes, OfATrackedHeadStandBeforeAScreenOfTrueSize) {
  StereoSettings settings = settingsOf(StereoMode::sbs_full);
  settings.head = TrackedHead{{120.0, 80.0, 500.0}, 290.0};
  Camera camera;
  camera.centre = {10.0, 20.0, 90.0};
  const Eyes eyes = placeEyes(camera, settings, kScreenAspect);
  EXPECT_NEAR((eyes.screen.upper_left - eyes.screen.lower_left).norm(), 290.0, 1e-9);
  EXPECT_TRUE(eyes.middle.isApprox(camera.centre + Vec3(120.0, 80.0, 500.0)));
  EXPECT_TRUE(eyes.right.isApprox(eyes.middle + Vec3(31.5, 0.0, 0.0)));
  // What lies in the plane of the screen stays there, wherever the head is.
  const Frustum frustum = makeFrustum(eyes, Eye::left, {1.0, 1e4});
  EXPECT_LT((seenAt(frustum, camera.centre) - Vec2(0.5, 0.5)).norm(), 1e-5);
  EXPECT_LT((seenAt(frustum, eyes.screen.upper_left)).norm(), 1e-5);
}

TEST(Eyes, OfATrackedHeadMustBeBeforeTheScreen) {
  StereoSettings settings;
  settings.head = TrackedHead{{0.0, 0.0, -10.0}, 290.0};
  EXPECT_EQ(support::thrownMessage([&] { placeEyes(Camera{}, settings, kScreenAspect); }),
            "the tracked head must be in front of its screen");
}

TEST(DepthRange, HoldsTheBoxAndNothingTooNear) {
  const Eigen::AlignedBox3d box(Vec3(-200, -300, -100), Vec3(200, 300, 120));
  const Eyes eyes = placeEyes(cameraAt(1200.0), {}, kScreenAspect);
  const DepthRange range = computeClipRange(eyes, box);
  EXPECT_LT(range.near_mm, 1080.0);
  EXPECT_GT(range.far_mm, 1300.0);
  EXPECT_DOUBLE_EQ(computeClipRange(placeEyes(cameraAt(150.0), {}, kScreenAspect), box).near_mm, 6.0);
  StereoSettings two_eyes;
  two_eyes.mode = StereoMode::sbs_half;
  EXPECT_DOUBLE_EQ(computeClipRange(placeEyes(cameraAt(150.0), two_eyes, kScreenAspect), box).near_mm, 45.0);
}

TEST(EyePicture, KeepsTheShapeOfTheWindowWhereItIsSqueezed) {
  const EyePicture half = eyePictureIn(StereoMode::sbs_half, 1280, 720);
  EXPECT_EQ(half.width, 640);
  EXPECT_DOUBLE_EQ(half.aspect(), 1280.0 / 720.0);
  const EyePicture full = eyePictureIn(StereoMode::sbs_full, 1280, 720);
  EXPECT_EQ(full.width, 640);
  EXPECT_DOUBLE_EQ(full.aspect(), 640.0 / 720.0);
  EXPECT_EQ(eyePictureIn(StereoMode::tb_half, 1280, 721).height, 360);
  EXPECT_EQ(eyePictureIn(StereoMode::anaglyph_half, 1280, 720).width, 1280);
}

TEST(EyePicture, LiesWhereTheModeSays) {
  const auto x = [](StereoMode mode, Eye eye) { return pictureCorner(eye, settingsOf(mode), 101, 60).x; };
  EXPECT_EQ(x(StereoMode::sbs_half, Eye::left), 0);
  EXPECT_EQ(x(StereoMode::sbs_half, Eye::right), 51);
  EXPECT_EQ(x(StereoMode::sbs_cross, Eye::right), 0);
  EXPECT_EQ(pictureCorner(Eye::left, settingsOf(StereoMode::tb_full), 100, 61).y, 31) << "the left eye is on top";
  StereoSettings swapped = settingsOf(StereoMode::sbs_full);
  swapped.swap_eyes = true;
  EXPECT_EQ(pictureCorner(Eye::right, swapped, 100, 60).x, 0);
}

TEST(EyePicture, TakesTheMouseFromWhicheverHalfItIsIn) {
  EXPECT_TRUE(placeInEye(StereoMode::sbs_half, {0.75, 0.3}).isApprox(Vec2(0.5, 0.3)));
  EXPECT_TRUE(placeInEye(StereoMode::tb_full, {0.75, 0.3}).isApprox(Vec2(0.75, 0.6)));
  EXPECT_TRUE(placeInEye(StereoMode::interlaced, {0.75, 0.3}).isApprox(Vec2(0.75, 0.3)));
}

TEST(StereoMode, IsKnownByItsName) {
  EXPECT_EQ(stereoModeNamed("tb-full"), StereoMode::tb_full);
  EXPECT_EQ(support::thrownMessage([] { stereoModeNamed("3d"); }).substr(0, 32), "stereo mode '3d': must be one of");
}

TEST(Comfort, IsTheClosedFormAtTheReadingDistance) {
  // At 600 mm one degree is reached 120 mm behind the screen and 86 mm before it.
  const Eyes eyes = placeEyes(cameraAt(600.0), settingsOf(StereoMode::sbs_full), kScreenAspect);
  const Eigen::AlignedBox3d box(Vec3(-10, -10, -120), Vec3(10, 10, 86));
  const Comfort comfort = computeComfort(eyes, 63.0, box);
  EXPECT_NEAR(comfort.behind_deg, 1.0, 0.01);
  EXPECT_NEAR(comfort.front_deg, 1.0, 0.01);
}

TEST(Comfort, WarnsAboveOneDegreeAndHoldsTheEyesWithinTwo) {
  const auto notes_for = [](double depth_mm) {
    const Eigen::AlignedBox3d box(Vec3(-10, -10, -depth_mm), Vec3(10, 10, 0));
    return comfortable(cameraAt(600.0), settingsOf(StereoMode::sbs_full), kScreenAspect, box);
  };
  EXPECT_EQ(notes_for(100.0).note, "");
  EXPECT_NE(notes_for(200.0).note.find("tires the eyes"), std::string::npos);
  EXPECT_EQ(notes_for(200.0).settings.eye_distance_mm, 63.0);
  const ComfortableStereo reduced = notes_for(400.0);
  EXPECT_NE(reduced.note.find("eye distance reduced from 63 to "), std::string::npos);
  EXPECT_NEAR(63.0 / 600.0 * 0.4 * (reduced.settings.eye_distance_mm / 63.0) * 180.0 / M_PI, kFusibleDeg, 1e-9);
}

TEST(QuadBuffer, FallsBackWithAMessage) {
  EXPECT_EQ(usableMode(StereoMode::quad_buffer, true).mode, StereoMode::quad_buffer);
  const UsableMode fallen = usableMode(StereoMode::quad_buffer, false, StereoMode::interlaced);
  EXPECT_EQ(fallen.mode, StereoMode::interlaced);
  EXPECT_NE(fallen.note.find("drawing interlaced instead"), std::string::npos);
}

}  // namespace
}  // namespace palpate::view
