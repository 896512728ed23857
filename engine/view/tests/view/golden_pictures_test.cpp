// Every overlay, every colouring, every stereo mode against pictures that a person has looked at (image_compare.h).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "palpate/tree/triangle_tree.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "pictures/image_compare.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kGoldenSize{480, 270, 2};

/// Made once a test program.
const std::shared_ptr<const scene::World>& torso() {
  static const std::shared_ptr<const scene::World> world = [] {
    scene::Scene scene;
    scene.body.kind = scene::BodyKind::torso;
    scene.body.triangles = 8163;
    return scene::build(scene);
  }();
  return world;
}

/// On the back, seen from behind.
Vec3 skinAt(const scene::World& world, double x_mm, double y_mm) {
  const Vec3 over(x_mm, y_mm, 1000.0);
  return tree::firstFrontCrossing(world.surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
}

/// The torso with two fingers: one presses, one presses and drags.
class GoldenPictures : public testing::Test {
 protected:
  GoldenPictures()
      : world_(torso()),
        fingers_{pressedFinger(*world_, skinAt(*world_, -30.0, 40.0), 7.0, {0.0, -4.0, 0.0}),
                 pressedFinger(*world_, skinAt(*world_, 45.0, 10.0), 9.0)},
        surface_(deformedBy(*world_, fingers_)),
        studio_(world_) {
    fingers_[1].colour = kRightFinger;
    fingers_[1].left = false;
  }

  /// Near enough to see triangles.
  PictureSettings closeUp() const {
    scene::ViewSettings view;
    view.look_at_mm = skinAt(*world_, 8.0, 25.0);
    view.zoom = 4.0;
    view.shading = Shading::gouraud;
    PictureSettings settings = pictureSettings(*world_, view, 16.0 / 9.0);
    settings.labels.finger_names = {"left", "right"};
    return settings;
  }

  PictureSettings whole(Shading shading) const {
    scene::ViewSettings view;
    view.shading = shading;
    return pictureSettings(*world_, view, 16.0 / 9.0);
  }

  void expect(const std::string& name, const PictureSettings& settings) {
    const TakenPicture taken = studio_.capture(surface_, {fingers_, 0.0}, settings, kGoldenSize);
    support::expectPicture(name, taken.image, taken.drawn_by);
  }

  std::shared_ptr<const scene::World> world_;
  std::array<FingerMark, 2> fingers_;
  deform::DeformedSurface surface_;
  Studio studio_;
};

TEST_F(GoldenPictures, OfTheBodyInBothShadings) {
  for (const auto& [name, shading] : WordsOf<Shading>::kAll) {
    expect(fmt::format("shading_{}", name), whole(shading));
  }
}

TEST_F(GoldenPictures, OfBonesUnderTheSkin) {
  PictureSettings settings = whole(Shading::skin);
  settings.look.skin_opacity = 0.35;
  expect("opacity", settings);
}

TEST_F(GoldenPictures, OfEveryColouring) {
  for (const auto colouring : {Colouring::strain, Colouring::stiffness, Colouring::ellipses}) {
    PictureSettings settings = closeUp();
    settings.look.colouring = colouring;
    expect(fmt::format("colours_{}", kColouringNames[static_cast<std::size_t>(colouring)]), settings);
  }
}

TEST_F(GoldenPictures, OfEveryOverlay) {
  for (std::size_t i = 0; i < kOverlays; ++i) {
    PictureSettings settings = closeUp();
    settings.look.overlays.set(i);
    settings.labels.numbers = false;
    expect(fmt::format("show_{}", kOverlayNames[i]), settings);
  }
}

TEST_F(GoldenPictures, OfEveryStereoMode) {
  for (const std::string_view mode : kStereoModeNames) {
    if (mode == "mono" || mode == "quad-buffer") continue;  // drawn by the other tests; needs a window
    PictureSettings settings = closeUp();
    settings.stereo.mode = stereoModeNamed(mode);
    expect(fmt::format("stereo_{}", mode), settings);
  }
}

TEST_F(GoldenPictures, OfAFingerThatWasLeftWhereItIs) {
  fingers_[0].outline = 1.5;
  expect("outline", closeUp());
}

TEST_F(GoldenPictures, OfATrackedHead) {
  PictureSettings settings = closeUp();
  settings.stereo.head = TrackedHead{{150.0, 60.0, 500.0}, 160.0};
  expect("tracked_head", settings);
}

}  // namespace
}  // namespace palpate::view
