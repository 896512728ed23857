// How much of a press is seen when the whole body is: pixels of the skin that a press changes and no drawn finger
// hides.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "palpate/engine/living_skin.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "view/tests/view/pixel_difference.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

/// As `palpate render --size 1600x1000` takes them.
constexpr PictureSize kWholeBody{1600, 1000, 2};
constexpr double kWholeBodyAspect = 1.6;
constexpr double kPressMm = 6.0;
/// A difference that is seen, levels of 256; and so many pixels of them that a user sees the dent.
constexpr int kSeenLevels = 3;
constexpr int kEnoughPixels = 400;

Vec3 trunkSkinAt(const scene::World& world, double x_mm, double y_mm) {
  const Vec3 over(x_mm, y_mm, 1000.0);
  return tree::firstFrontCrossing(world.surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
}

class PressPixels : public testing::Test {
 protected:
  Image take(const Look& look, const deform::DeformedSurface& surface, std::span<const FingerMark> fingers) {
    PictureSettings settings = pictureSettings(*world_, kWholeBodyAspect);
    settings.look = look;
    settings.labels = LabelSettings::none();
    return studio_.take(surface, {.fingers = fingers, .time_s = 0.0}, settings, kWholeBody).image;
  }

  /// The finger's own pixels: without skin, nothing else differs. The part in its dent counts as hiding too.
  std::vector<bool> hiddenBy(FingerShape shape, const deform::DeformedSurface& surface,
                             std::span<const FingerMark> fingers) {
    Look look = pictureSettings(*world_, kWholeBodyAspect).look;
    look.skin_opacity = 0.0;
    look.finger = FingerShape::none;
    const Image bare = take(look, surface, fingers);
    look.finger = shape;
    const Image drawn = take(look, surface, fingers);
    std::vector<bool> hidden(bare.pixels.size());
    for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] = bare.pixels[i] != drawn.pixels[i];
    return hidden;
  }

  /// The finger is left out of both pictures, so that neither it nor its shadow counts.
  int seenOf(FingerShape shape, const Vec3& place) {
    FingerMark finger = pressedFinger(*world_, place, kPressMm);
    engine::LivingSkin skin(*world_, {.strain = false, .fingers = 1});
    Look look = pictureSettings(*world_, kWholeBodyAspect).look;
    look.finger = FingerShape::none;
    const Image rest = take(look, skin.surface(), {});
    skin.follow(std::span<const contact::FingerOutput>(&finger.contact, 1));
    const std::span<const FingerMark> fingers(&finger, 1);
    const Image pressed = take(look, skin.surface(), fingers);
    const std::vector<bool> hidden = hiddenBy(shape, skin.surface(), fingers);
    int seen = 0;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      if (!hidden[i] && difference(rest.pixels[i], pressed.pixels[i]) > kSeenLevels) ++seen;
    }
    return seen;
  }

  std::shared_ptr<const scene::World> world_ = scene::build(scene::Scene{});
  Studio studio_{world_};
};

TEST_F(PressPixels, AreEnoughWhenTheWholeBodyIsSeen) {
  for (const auto& [x, y] : {std::pair{-40.0, 60.0}, {60.0, 130.0}, {-55.0, -60.0}, {0.0, 20.0}}) {
    for (const FingerShape shape : {FingerShape::automatic, FingerShape::ball}) {
      EXPECT_GE(seenOf(shape, trunkSkinAt(*world_, x, y)), kEnoughPixels) << wordFor(shape) << " at " << x << ", " << y;
    }
  }
}

TEST_F(PressPixels, AreOfTheShadingOfDentsThatCanBeTurnedOff) {
  const FingerMark finger = pressedFinger(*world_, trunkSkinAt(*world_, -40.0, 60.0), kPressMm);
  engine::LivingSkin skin(*world_, {.strain = false, .fingers = 1});
  skin.follow(std::span<const contact::FingerOutput>(&finger.contact, 1));
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    Look look = pictureSettings(*world_, kWholeBodyAspect).look;
    look.shading = shading;
    look.finger = FingerShape::none;
    const Image shaded = take(look, skin.surface(), {});
    look.dent_contrast = 0.0;
    const Image plain = take(look, skin.surface(), {});
    int differing = 0;
    for (std::size_t i = 0; i < shaded.pixels.size(); ++i) {
      if (difference(shaded.pixels[i], plain.pixels[i]) > kSeenLevels) ++differing;
    }
    EXPECT_GE(differing, kEnoughPixels) << wordFor(shading);
  }
}

}  // namespace
}  // namespace palpate::view
