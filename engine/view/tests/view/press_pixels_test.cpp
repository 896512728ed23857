// How much of a press is seen when the whole body is: pixels of the skin that a press changes and no drawn finger
// hides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/presets.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "view/tests/view/pixel_difference.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

/// Of the whole body as `palpate render --size 1600x1000` takes it, the part round a press: the same millimetres a
/// pixel (which decide how much a small dent is helped), and a sixth of the pixels to draw.
constexpr PictureSize kRoundThePress{640, 400, 2};
constexpr double kShareOfHeight = 400.0 / 1000.0;
constexpr double kWholeBodyAspect = 1.6;
constexpr double kPressMm = 6.0;
/// A difference that is seen, levels of 256; and so many pixels of them that a user sees the dent.
constexpr int kSeenLevels = 3;
constexpr int kEnoughPixels = 400;

Vec3 trunkSkinAt(const scene::World& world, double x_mm, double y_mm) {
  const Vec3 over(x_mm, y_mm, 1000.0);
  return tree::firstFrontCrossing(world.surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
}

/// One body and one drawing context for all tests of the suite.
class PressPixels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = scene::build(scene::Scene{});
    studio_ = std::make_unique<Studio>(world_);
  }
  static void TearDownTestSuite() {
    studio_.reset();
    world_.reset();
  }

  static Image capture(const Vec3& place, const Look& look, const deform::DeformedSurface& surface,
                       std::span<const FingerMark> fingers) {
    PictureSettings settings = pictureSettings(*world_, kWholeBodyAspect);
    settings.camera.centre.head<2>() = place.head<2>();  // as far from the eye as the whole body is
    settings.camera.height_rad = 2.0 * std::atan(kShareOfHeight * std::tan(0.5 * settings.camera.height_rad));
    settings.look = look;
    settings.labels = LabelSettings::none();
    return studio_->capture(surface, {.fingers = fingers, .time_s = 0.0}, settings, kRoundThePress).image;
  }

  /// The finger is left out of the pictures at rest and pressed, so that neither it nor its shadow counts.
  static Look fingerless() {
    Look look = pictureSettings(*world_, kWholeBodyAspect).look;
    look.finger = FingerShape::none;
    return look;
  }

  /// The finger's own pixels against `bare`: without skin, nothing else differs. The part in its dent counts as hiding
  /// too.
  static std::vector<bool> hiddenBy(FingerShape shape, const Vec3& place, const Image& bare,
                                    const deform::DeformedSurface& surface, std::span<const FingerMark> fingers) {
    Look look = fingerless();
    look.skin_opacity = 0.0;
    look.finger = shape;
    const Image drawn = capture(place, look, surface, fingers);
    std::vector<bool> hidden(bare.pixels.size());
    for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] = bare.pixels[i] != drawn.pixels[i];
    return hidden;
  }

  static int countVisibleChanges(const Image& rest, const Image& pressed, const std::vector<bool>& hidden) {
    int seen = 0;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      if (!hidden[i] && difference(rest.pixels[i], pressed.pixels[i]) > kSeenLevels) ++seen;
    }
    return seen;
  }

  inline static std::shared_ptr<const scene::World> world_;
  inline static std::unique_ptr<Studio> studio_;
};

TEST_F(PressPixels, AreEnoughWhenTheWholeBodyIsSeen) {
  for (const auto& [x, y] : {std::pair{-40.0, 60.0}, {60.0, 130.0}, {-55.0, -60.0}, {0.0, 20.0}}) {
    const Vec3 place = trunkSkinAt(*world_, x, y);
    const FingerMark finger = pressedFinger(*world_, place, kPressMm);
    const std::span<const FingerMark> fingers(&finger, 1);
    engine::LivingSkin skin(*world_, {.strain = false, .fingers = 1});
    const Image rest = capture(place, fingerless(), skin.surface(), {});
    skin.follow(std::span<const contact::FingerOutput>(&finger.contact, 1));
    const Image pressed = capture(place, fingerless(), skin.surface(), fingers);
    Look skinless = fingerless();
    skinless.skin_opacity = 0.0;
    const Image bare = capture(place, skinless, skin.surface(), fingers);
    for (const FingerShape shape : {FingerShape::automatic, FingerShape::ball}) {
      const int seen = countVisibleChanges(rest, pressed, hiddenBy(shape, place, bare, skin.surface(), fingers));
      EXPECT_GE(seen, kEnoughPixels) << wordFor(shape) << " at " << x << ", " << y;
    }
  }
}

TEST_F(PressPixels, AreOfTheShadingOfDentsThatCanBeTurnedOff) {
  const Vec3 place = trunkSkinAt(*world_, -40.0, 60.0);
  const FingerMark finger = pressedFinger(*world_, place, kPressMm);
  engine::LivingSkin skin(*world_, {.strain = false, .fingers = 1});
  skin.follow(std::span<const contact::FingerOutput>(&finger.contact, 1));
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    Look look = fingerless();
    look.shading = shading;
    const Image shaded = capture(place, look, skin.surface(), std::span(&finger, 1));
    look.dent_contrast = 0.0;
    const Image plain = capture(place, look, skin.surface(), std::span(&finger, 1));
    int differing = 0;
    for (std::size_t i = 0; i < shaded.pixels.size(); ++i) {
      if (difference(shaded.pixels[i], plain.pixels[i]) > kSeenLevels) ++differing;
    }
    EXPECT_GE(differing, kEnoughPixels) << wordFor(shading);
  }
}

/// How many pixels of a picture of the whole body the help for small dents changes, with the fingers of a scene at this
/// moment of its run.
int helpedPixels(const std::string& preset, double at_s) {
  const std::shared_ptr<const scene::World> world = scene::build(scene::presetScene(preset));
  const device::FingerPaths paths = device::pathsOf(*world);
  servo::Rig rig = servo::scriptedRig(*world, paths);
  std::vector<FingerMark> fingers;
  engine::LivingSkin skin(*world, {.strain = false, .fingers = world->scene.fingers.size()});
  const auto ticks = static_cast<std::uint64_t>(at_s * 1000.0);
  servo::runHeadless(rig, ticks, [&](std::span<const trace::Sample> samples) {
    if (samples.front().tick + 1 < ticks) return;
    skin.follow(samples);
    for (const trace::Sample& sample : samples) fingers.push_back({.contact = sample.contact});
  });
  Studio studio(world);
  const auto picture = [&](double contrast) {
    PictureSettings settings = pictureSettings(*world, kWholeBodyAspect);
    settings.look.skin_opacity = 1.0;
    settings.look.finger = FingerShape::none;
    settings.look.dent_contrast = contrast;
    settings.labels = LabelSettings::none();
    return studio.capture(skin.surface(), {.fingers = fingers, .time_s = 0.0}, settings, {800, 500, 2}).image;
  };
  const Image helped = picture(1.0), plain = picture(0.0);
  int changed = 0;
  for (std::size_t i = 0; i < helped.pixels.size(); ++i) {
    if (difference(helped.pixels[i], plain.pixels[i]) > kSeenLevels) ++changed;
  }
  return changed;
}

// Two dents of 50 mm; the drag of 16 mm moves skin 300 mm across, whose contours would be 5,000 pixels.
TEST(DentContours, AreOfAPressAndNotOfItsDrag) {
  const int changed = helpedPixels("vhb", 4.5);
  EXPECT_GT(changed, 500);
  EXPECT_LT(changed, 4300);
}

TEST(DentContours, AreNotOfAPressThatMovesTheWholeBack) { EXPECT_EQ(helpedPixels("vhb-literal", 4.5), 0); }

}  // namespace
}  // namespace palpate::view
