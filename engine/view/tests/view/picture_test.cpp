// What pictures must show, told without kept ones: parallax, equal eyes, legends that can be read back, overlays that
// appear.
#include "palpate/view/picture.h"

#include <gtest/gtest.h>

#include "palpate/view/overlays/legend.h"
#include "pictures/image_compare.h"
#include "support/changed_body.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kPictureSize{480, 270, 1};

/// Straight at the flat skin's middle, from 600 mm.
PictureSettings settingsFor(StereoMode mode) {
  PictureSettings settings;
  settings.camera.centre = {50.0, 50.0, 0.0};
  settings.camera.distance_mm = 600.0;
  settings.camera.height_rad = 0.3;
  settings.stereo.mode = mode;
  settings.labels = LabelSettings::none();
  settings.look.shading = Shading::gouraud;
  return settings;
}

/// A ball in the air.
FingerMark ballAt(const Vec3& place) {
  FingerMark mark;
  mark.contact = contact::FingerOutput{
      .tip = place, .proxy = place, .anchor = place, .hold = place, .normal = Vec3::Zero(), .force = Vec3::Zero()};
  mark.radius_mm = 6.0;
  mark.haptic_radius_mm = mark.radius_mm;  // its tip is the ball's middle
  return mark;
}

struct Half {
  int first, end;
};
constexpr Half kLeftHalf{0, 240};
constexpr Half kRightHalf{240, 480};

/// Middle of the blue pixels of a half, pixels from the half's left edge.
double blueMiddle(const Image& image, const Half& half) {
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = half.first; x < half.end; ++x) {
      const Pixel& p = image.at(x, y);
      if (p[2] < p[0] + 40) continue;
      sum += x - half.first + 0.5;
      ++count;
    }
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

TEST(Picture, ShowsAPlaceToBothEyesWithTheParallaxOfItsDistance) {
  const auto world = flatWorld();
  const deform::DeformedSurface rest(*world->deformable);
  PictureSettings settings = settingsFor(StereoMode::sbs_full);
  settings.look.finger = FingerShape::ball;  // all of it is blue, round its middle
  Studio studio(world);
  for (const double above : {10.0, 60.0, 100.0}) {
    const FingerMark ball[] = {ballAt({50.0, 50.0, above})};
    const Image image = studio.capture(rest, {ball, 0.0}, settings, kPictureSize).image;
    const double pixels_per_mm = 270.0 / (2.0 * 600.0 * std::tan(0.15));
    const double expected = pixels_per_mm * 63.0 * (1.0 - 600.0 / (600.0 - above));
    EXPECT_NEAR(blueMiddle(image, kRightHalf) - blueMiddle(image, kLeftHalf), expected, 0.5) << above;
  }
}

TEST(Picture, OfABodyInMapCoordinatesIsThatOfTheSameBodyNearby) {
  const auto pictureAt = [](const Vec3& place) {
    mesh::TriangleMesh sheet = zoo::grid(50, 100.0);
    for (Vec3& position : sheet.positions) position += place - Vec3(50.0, 50.0, 0.0);
    const auto world = meshWorld(std::move(sheet));
    const FingerMark finger = pressedFinger(*world, place, 8.0, Vec3(6.0, 0.0, 0.0));
    PictureSettings settings;
    settings.camera.centre = place;
    settings.camera.yaw_rad = 0.4;
    settings.camera.distance_mm = 300.0;
    settings.labels = LabelSettings::none();
    settings.look.show(Overlay::section);
    return picture(world, deformedBy(*world, {&finger, 1}), {{&finger, 1}, 0.0}, settings, kPictureSize);
  };
  const Image nearby = pictureAt(Vec3::Zero());
  for (const Vec3& place : {Vec3(4e8, 4e8, 0.0), Vec3(5e8, 4.08e9, 1e6)}) {
    const support::Comparison found = support::compare(nearby, pictureAt(place));
    EXPECT_TRUE(found.same) << found.words();
  }
}

TEST(Picture, ChangesNothingOutsideOfItsLens) {
  const auto world = flatWorld();
  Studio studio(world);
  PictureSettings settings;
  settings.camera.centre = {50.0, 50.0, 0.0};
  settings.labels = LabelSettings::none();
  const FingerMark finger[] = {pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0)};
  const deform::DeformedSurface surface = deformedBy(*world, finger);
  const PictureSize size{800, 600, 1};
  const Image without = studio.capture(surface, {finger, 0.0}, settings, size).image;
  settings.look.lens = true;
  const Image with = studio.capture(surface, {finger, 0.0}, settings, size).image;
  int changed = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (with.at(x, y) == without.at(x, y)) continue;
      ++changed;
      EXPECT_TRUE(x < 300 && y > 300) << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 5000);
  EXPECT_EQ(studio.capture(surface, {{}, 0.0}, settings, size).image.pixels, studio
                                                                                 .capture(
                                                                                     surface, {{}, 0.0},
                                                                                     [&] {
                                                                                       auto s = settings;
                                                                                       s.look.lens = false;
                                                                                       return s;
                                                                                     }(),
                                                                                     size)
                                                                                 .image.pixels)
      << "without a finger there is none";
}

TEST(Picture, ShowsBothEyesTheSameWithoutEyeDistance) {
  const auto world = flatWorld();
  const FingerMark fingers[] = {pressedFinger(*world, {50, 50, 0}, 5.0)};
  PictureSettings settings = settingsFor(StereoMode::sbs_full);
  settings.stereo.eye_distance_mm = 0.0;
  settings.labels = {};
  const Image image = picture(world, deformedBy(*world, fingers), {fingers, 0.0}, settings, kPictureSize);
  for (int y = 0; y < 270; ++y) {
    for (int x = 0; x < 240; ++x) ASSERT_EQ(image.at(x, y), image.at(x + 240, y)) << x << " " << y;
  }
}

TEST(Picture, InterlacesWholeRowsOfEachEyeWhenSupersampled) {
  const auto world = flatWorld();
  const FingerMark fingers[] = {pressedFinger(*world, {50, 50, 0}, 5.0)};
  const auto surface = deformedBy(*world, fingers);
  const PictureSize fine{240, 135, 2};
  Studio studio(world);
  const auto capture = [&](StereoMode mode, const PictureSize& size) {
    return studio.capture(surface, {fingers, 0.0}, settingsFor(mode), size).image;
  };
  const Image rows = capture(StereoMode::interlaced, fine);
  // Top and bottom "full" of twice the height holds the same two pictures whole.
  const Image whole = capture(StereoMode::tb_full, {240, 270, 2});
  for (int y = 0; y < rows.height; ++y) {
    for (int x = 0; x < rows.width; ++x) {
      ASSERT_EQ(rows.at(x, y), whole.at(x, y + (y % 2 == 0 ? 0 : 135))) << x << " " << y;
    }
  }
}

TEST(Picture, IsTheSameEveryTime) {
  const auto world = flatWorld();
  const FingerMark fingers[] = {pressedFinger(*world, {50, 50, 0}, 5.0)};
  const auto surface = deformedBy(*world, fingers);
  PictureSettings settings = settingsFor(StereoMode::mono);
  settings.look.shading = Shading::skin;
  settings.labels = {};
  const Image first = picture(world, surface, {fingers, 0.0}, settings, kPictureSize);
  EXPECT_EQ(first.pixels, picture(world, surface, {fingers, 0.0}, settings, kPictureSize).pixels);
}

TEST(Picture, MarksTheFingersValueOnTheLegend) {
  const auto world = flatWorld();
  const FingerMark finger = pressedFinger(*world, {50, 50, 0}, 5.0);
  Look look;
  look.colouring = Colouring::stiffness;
  const auto value = valueUnder(*world, deformedBy(*world, {&finger, 1}), look, finger.contact);
  ASSERT_TRUE(value);
  EXPECT_NEAR(*value, kTestStiffness, 1e-12);
  FingerMark away = finger;
  away.contact.touch = contact::Touch::free;
  EXPECT_FALSE(valueUnder(*world, deformedBy(*world, {}), look, away.contact));
}

TEST(Picture, HasDarkLettersOnPaperAndOnALightGround) {
  const auto world = flatWorld();
  Studio studio(world);
  const auto surface = deformedBy(*world, {});
  for (const bool white : {true, false}) {
    PictureSettings settings = settingsFor(StereoMode::mono);
    settings.camera.centre = {1e4, 1e4, 0.0};  // nothing but the ground
    settings.look.white_background = white;
    settings.look.light_background = true;
    const Image bare = studio.capture(surface, {}, settings, kPictureSize).image;
    settings.labels.title = "Title";
    settings.labels.orientation = settings.labels.scale_bar = true;
    const Image lettered = studio.capture(surface, {}, settings, kPictureSize).image;
    int letters = 0;
    for (int y = 0; y < kPictureSize.height; ++y) {
      for (int x = 0; x < kPictureSize.width; ++x) {
        EXPECT_GT(bare.at(x, y)[0], 170) << "a light ground";
        letters += lettered.at(x, y)[0] < 80 ? 1 : 0;
      }
    }
    EXPECT_GT(letters, 300) << "dark pixels of letters and lines";
  }
}

TEST(Picture, ChangesWithEveryOverlay) {
  const auto named = std::make_shared<scene::World>(*flatWorld());
  support::changeBody(*named, [](scene::Body& body) {
    body.anatomy.landmarks = {{"spinous_T6", "T6", {20.0, 20.0, 0.0}, Vec3::UnitZ(), {20.0, 20.0, -10.0}}};
  });
  const std::shared_ptr<const scene::World> world = named;
  const FingerMark fingers[] = {pressedFinger(*world, {50, 50, 0}, 6.0, {3, 0, 0})};
  const auto surface = deformedBy(*world, fingers);
  Studio studio(world);
  PictureSettings settings = settingsFor(StereoMode::mono);
  settings.labels.section = true;
  const Image without = studio.capture(surface, {fingers, 0.0}, settings, kPictureSize).image;
  for (std::size_t i = 0; i < kOverlays; ++i) {
    const auto overlay = static_cast<Overlay>(i);
    if (overlay == Overlay::pressure || overlay == Overlay::lumps)
      continue;                                 // of worlds with lumps: lump_pictures_test
    if (overlay == Overlay::muscles) continue;  // of the trunk: body_names_test
    settings.look.overlays.reset();
    settings.look.overlays.set(i);
    const Image with = studio.capture(surface, {fingers, 0.0}, settings, kPictureSize).image;
    EXPECT_NE(with.pixels, without.pixels) << kOverlayNames[i];
  }
}

}  // namespace
}  // namespace palpate::view
