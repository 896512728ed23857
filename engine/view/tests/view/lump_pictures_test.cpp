// Lumps, the pressure over them and the body cut open, against pictures that a person has looked at (image_compare.h).
#include <gtest/gtest.h>

#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "pictures/image_compare.h"
#include "view/tests/view/lump_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kLumpPictureSize{640, 400, 2};

PictureSettings closeTo(const scene::World& world, double x_mm, double y_mm, std::initializer_list<Overlay> show) {
  scene::ViewSettings view;
  view.look_at_mm = backAt(world, x_mm, y_mm);
  view.zoom = 4.0;
  view.show = show;
  view.finger = FingerShape::finger;
  return pictureSettings(world, view, 1.6);
}

/// `finger`: null: nobody touches.
void expectTaken(const std::string& name, const std::shared_ptr<const scene::World>& world, const FingerMark* finger,
                 const PictureSettings& settings) {
  const std::span<const FingerMark> fingers(finger, finger != nullptr ? 1 : 0);
  Studio studio(world);
  const TakenPicture taken = studio.capture(deformedBy(*world, fingers), {fingers, 0.0}, settings, kLumpPictureSize);
  EXPECT_TRUE(taken.notes.empty());
  support::expectPicture(name, taken.image, taken.drawn_by);
}

TEST(LumpPictures, OfThePressureOverALumpOfFiveMillimetres) {
  scene::LumpSettings small = lumpAt(kLumpX, kLumpY);
  small.diameter_mm = 5.0;
  const auto world = lumpyTorso({small});
  FingerMark finger = fingertipAt(*world, kLumpX + 1.0, kLumpY, 5.0);
  finger.pad.taxels = 8;
  expectTaken("lump_pressure", world, &finger, closeTo(*world, kLumpX, kLumpY, {Overlay::pressure}));
}

TEST(LumpPictures, OfACutAwayThroughAMobileLump) {
  const MovedLump made = movedLump(6.0, 2.5);
  expectTaken("lump_cut", made.world, &made.finger,
              closeTo(*made.world, kLumpX, kLumpY, {Overlay::cut, Overlay::pressure, Overlay::lumps}));
}

TEST(LumpPictures, OfLumpsUnderTranslucentSkin) {
  scene::LumpSettings flat = lumpAt(-45.0, 40.0);
  flat.name = "flat";
  flat.half_axes_mm = Vec3(9.0, 9.0, 2.5);
  const auto world = lumpyTorso({lumpAt(kLumpX, kLumpY), flat});
  expectTaken("lump_bodies", world, nullptr, closeTo(*world, 0.0, 20.0, {Overlay::lumps}));
}

TEST(LumpPictures, OfASwellingAtRest) {
  scene::LumpSettings swollen = lumpAt(kLumpX, kLumpY);
  swollen.diameter_mm = 16.0;
  swollen.raise_mm = 8.0;
  const auto world = lumpyTorso({swollen});
  PictureSettings settings = closeTo(*world, kLumpX, kLumpY, {});
  settings.camera.yaw_rad += 0.9;
  expectTaken("lump_swelling", world, nullptr, settings);
}

}  // namespace
}  // namespace palpate::view
