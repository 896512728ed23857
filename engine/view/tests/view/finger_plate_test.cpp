// The numbers of a finger stand beside what is drawn of it, a whole hand too.
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <utility>

#include "palpate/engine/living_skin.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "view/tests/view/pixel_difference.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kPlatePicture{800, 600, 1};

class FingerPlate : public testing::Test {
 protected:
  /// Pixels of the drawn finger that a plate covers, and all of them.
  std::pair<int, int> coveredOf(FingerShape shape, double distance_mm) {
    const Vec3 over(40.0, 60.0, 1000.0);
    const Vec3 place =
        tree::firstFrontCrossing(world_->surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
    FingerMark finger = pressedFinger(*world_, place, 6.0);
    const std::span<const FingerMark> fingers(&finger, 1);
    engine::LivingSkin skin(*world_, {.strain = false, .fingers = 1});
    skin.follow(std::span<const contact::FingerOutput>(&finger.contact, 1));
    PictureSettings settings = pictureSettings(*world_, 4.0 / 3.0);
    settings.camera.centre = place;
    settings.camera.distance_mm = distance_mm;
    const auto capture = [&](FingerShape drawn, bool numbers) {
      settings.look.finger = drawn;
      settings.labels = LabelSettings::none();
      settings.labels.numbers = numbers;
      return studio_.capture(skin.surface(), {.fingers = fingers, .time_s = 0.0}, settings, kPlatePicture).image;
    };
    const Image bare = capture(FingerShape::none, false), drawn = capture(shape, false),
                labelled = capture(shape, true);
    int covered = 0, all = 0;
    for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
      if (difference(bare.pixels[i], drawn.pixels[i]) < 40) continue;  // its shadow may be written on
      ++all;
      covered += difference(drawn.pixels[i], labelled.pixels[i]) > 8 ? 1 : 0;
    }
    return {covered, all};
  }

  const std::shared_ptr<const scene::World> world_ = scene::build(scene::Scene{});
  Studio studio_{world_};
};

TEST_F(FingerPlate, HidesNothingOfAFingerOrAHand) {
  for (const FingerShape shape : {FingerShape::ball, FingerShape::finger, FingerShape::hand}) {
    for (const double distance_mm : {250.0, 500.0, 1500.0}) {
      const auto [covered, all] = coveredOf(shape, distance_mm);
      EXPECT_GT(all, 20);
      // The line to the tip is drawn over it.
      EXPECT_LT(covered, 60 + all / 50) << static_cast<int>(shape) << " from " << distance_mm << " mm, of " << all;
    }
  }
}

}  // namespace
}  // namespace palpate::view
