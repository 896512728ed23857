// How skin, bones, dents and hands look, in numbers: no stored picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/tree/triangle_tree.h"
#include "palpate/view/layers/skin_tint.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "palpate/view/skin_tone.h"
#include "support/changed_body.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr PictureSize kLookSize{480, 360, 1};
constexpr double kLookAspect = 4.0 / 3.0;

double luminance(const Pixel& p) { return (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) / 255.0; }

std::shared_ptr<const scene::World> torsoWorld() {
  static const std::shared_ptr<const scene::World> torso = [] {
    scene::Scene scene;
    scene.body.kind = scene::BodyKind::torso;
    scene.body.triangles = 8163;
    return scene::build(scene);
  }();
  return torso;
}

Vec3 skinAt(const scene::World& world, double x_mm, double y_mm) {
  const Vec3 over(x_mm, y_mm, 1000.0);
  return tree::firstFrontCrossing(world.surface.geometry->tree, over, over - 2000.0 * Vec3::UnitZ()).point;
}

/// Pictures of one world without labels, on black, so that what is drawn can be told from what is not.
class SkinLook : public testing::Test {
 protected:
  PictureSettings settings(const scene::ViewSettings& view = {}) const {
    PictureSettings settings = pictureSettings(*world_, view, kLookAspect);
    settings.labels = LabelSettings::none();
    settings.look.plain_background = 0.0;
    return settings;
  }

  Image capture(const PictureSettings& settings, std::span<const FingerMark> fingers = {}) {
    return studio_.capture(deformedBy(*world_, fingers), {.fingers = fingers, .time_s = 0.0}, settings, kLookSize)
        .image;
  }

  std::vector<double> luminances(const Image& image) const {
    std::vector<double> values;
    for (const Pixel& pixel : image.pixels) {
      if (luminance(pixel) > 0.02) values.push_back(luminance(pixel));
    }
    return values;
  }

  std::shared_ptr<const scene::World> world_ = torsoWorld();
  Studio studio_{world_};
};

double shareAbove(const std::vector<double>& values, double limit) {
  const auto above = std::count_if(values.begin(), values.end(), [&](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

double meanValue(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

TEST_F(SkinLook, HasNoPlasticHighlights) {
  for (const double tone : {1.0, 3.0, 6.0}) {
    for (const double yaw_deg : {0.0, 40.0, -40.0}) {
      scene::ViewSettings view;
      view.skin_tone = tone;
      view.yaw_deg = yaw_deg;
      const std::vector<double> values = luminances(capture(settings(view)));
      ASSERT_GT(values.size(), 20000u);
      EXPECT_LT(shareAbove(values, 0.97), 0.0005) << tone << " " << yaw_deg;
      // A highlight is much brighter than the skin round it, and small.
      EXPECT_LT(shareAbove(values, std::min(0.95, meanValue(values) * 1.6 + 0.12)), 0.02) << tone << " " << yaw_deg;
    }
  }
}

TEST_F(SkinLook, IsDarkerFromToneToTone) {
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    double before = 1.0;
    for (double tone = 1.0; tone <= 6.0; tone += 0.5) {
      scene::ViewSettings view;
      view.skin_tone = tone;
      view.shading = shading;
      const double mean = meanValue(luminances(capture(settings(view))));
      EXPECT_LT(mean, before - 0.015) << tone;
      before = mean;
    }
    EXPECT_LT(before, 0.35);
    EXPECT_GT(before, 0.12) << "dark skin is not black";
  }
}

TEST(SkinTones, AreWarm) {
  for (double tone = 0.0; tone <= 7.0; tone += 0.25) {
    const Vec3f colour = interpolateSkinTone(tone).colour;
    EXPECT_GT(colour.x(), colour.y());
    EXPECT_GT(colour.y(), colour.z());
  }
}

/// The largest difference between a pixel and the mean of its neighbours, as a share, on the middle of a picture.
double roughnessOf(const Image& image) {
  double sum = 0.0;
  int count = 0;
  for (int y = image.height / 3; y < 2 * image.height / 3; ++y) {
    for (int x = image.width / 3; x < 2 * image.width / 3; ++x) {
      const double here = luminance(image.at(x, y));
      const double round = 0.25 * (luminance(image.at(x - 1, y)) + luminance(image.at(x + 1, y)) +
                                   luminance(image.at(x, y - 1)) + luminance(image.at(x, y + 1)));
      sum += (here - round) * (here - round);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST_F(SkinLook, ShowsItsLinesOnlyFromNearBy) {
  for (const double zoom : {1.0, 2.0, 40.0}) {
    scene::ViewSettings view;
    view.look_at_mm = skinAt(*world_, 45.0, 40.0);
    view.zoom = zoom;
    const double with_lines = roughnessOf(capture(settings(view)));
    view.detail = false;
    const double without = roughnessOf(capture(settings(view)));
    if (zoom < 3.0) {
      EXPECT_LT(with_lines, without + 0.0005) << "no peel of an orange at zoom " << zoom;
    } else {
      EXPECT_GT(with_lines, without + 0.001) << "lines at zoom " << zoom;
    }
  }
}

/// The mean luminance of the ring from 10 to 16 mm round a place.
double luminanceRound(const Image& image, const PictureSettings& settings, const Vec3& place) {
  const Frustum frustum = makeFrustum(cameraScreen(settings.camera, kLookAspect), settings.camera.eye(), 10.0, 5000.0);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 48; ++i) {
    for (const double radius : {10.0, 12.0, 14.0, 16.0}) {
      const double angle = i * std::numbers::pi / 24.0;
      const Vec2 at = seenAt(frustum, place + radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
      sum += luminance(image.at(static_cast<int>(at.x() * image.width), static_cast<int>(at.y() * image.height)));
      ++count;
    }
  }
  return sum / count;
}

TEST_F(SkinLook, ShowsADentWhenTheWholeBodyIsSeen) {
  const Vec3 place = skinAt(*world_, 40.0, 60.0);
  const std::vector<FingerMark> fingers = {pressedFinger(*world_, place, 9.0)};
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    double before = -1.0;
    for (const double contrast : {0.0, 1.0, 2.0, 4.0}) {
      scene::ViewSettings view;
      view.shading = shading;
      view.finger = FingerShape::none;
      view.dent_contrast = contrast;
      const double rest = luminanceRound(capture(settings(view)), settings(view), place);
      const double pressed = luminanceRound(capture(settings(view), fingers), settings(view), place);
      const double darker = 1.0 - pressed / rest;
      EXPECT_GT(darker, before) << "contrast " << contrast;
      if (contrast == 1.0) {
        EXPECT_GT(darker, 0.05);
      }
      before = darker;
    }
    EXPECT_GT(before, 0.15) << "exaggerated";
  }
}

TEST_F(SkinLook, ShowsTheShadowOfAFingerThatComesNear) {
  const Vec3 place = skinAt(*world_, 40.0, 60.0);
  const auto finger = [&](double height_mm) {
    FingerMark mark;
    mark.contact.tip = place + height_mm * Vec3::UnitZ();
    mark.haptic_radius_mm = 8.0;
    return std::vector<FingerMark>{mark};
  };
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    scene::ViewSettings view;
    view.shading = shading;
    const Image bare = capture(settings(view));
    double far_darkest = 0.0;
    for (const double height_mm : {40.0, 12.0}) {
      const Image shaded = capture(settings(view), finger(height_mm));
      double darkest = 0.0;
      for (int y = 0; y < bare.height; ++y) {
        for (int x = 0; x < bare.width; ++x) {
          const Pixel& pixel = shaded.at(x, y);
          if (pixel[2] > pixel[0]) continue;  // the ball
          darkest = std::max(darkest, luminance(bare.at(x, y)) - luminance(pixel));
        }
      }
      EXPECT_GT(darkest, 0.05) << height_mm;
      EXPECT_GT(darkest, far_darkest) << "nearer is darker";
      far_darkest = darkest;
    }
  }
}

/// On black, without labels.
Image bareSideOf(const std::shared_ptr<const scene::World>& world, double opacity) {
  scene::ViewSettings view;
  view.side = StandardView::left;  // the ribs stand out of the open torso
  view.opacity = opacity;
  PictureSettings settings = pictureSettings(*world, view, kLookAspect);
  settings.labels = LabelSettings::none();
  settings.look.plain_background = 0.0;
  return picture(world, deformedBy(*world, {}), {}, settings, kLookSize);
}

TEST(BoneLook, IsHiddenByClosedSkinFromOutsideAndSeenFromWithin) {
  scene::Scene scene;
  scene.body.triangles = 12000;
  const std::shared_ptr<const scene::World> world = scene::build(scene);
  auto boneless = std::make_shared<scene::World>(*world);
  support::changeBody(*boneless, [](scene::Body& body) { body.anatomy.bones.clear(); });
  const auto differ = [&](const PictureSettings& settings) {
    const Image with_bones = picture(world, deformedBy(*world, {}), {}, settings, kLookSize);
    return with_bones.pixels != picture(boneless, deformedBy(*world, {}), {}, settings, kLookSize).pixels;
  };
  scene::ViewSettings view;
  for (const StandardView side : {StandardView::back, StandardView::left, StandardView::front, StandardView::above}) {
    view.side = side;
    PictureSettings settings = pictureSettings(*world, view, kLookAspect);
    settings.labels = LabelSettings::none();
    EXPECT_FALSE(differ(settings)) << static_cast<int>(side);
  }
  PictureSettings within = pictureSettings(*world, view, kLookAspect);
  within.labels = LabelSettings::none();
  within.camera.centre = Vec3(0, 0, 0);
  within.camera.distance_mm = 30;
  EXPECT_TRUE(differ(within)) << "inside the chest";
}

TEST(BoneLook, IsOfOneIvory) {
  const std::shared_ptr<const scene::World> world = torsoWorld();
  auto boneless = std::make_shared<scene::World>(*world);
  support::changeBody(*boneless, [](scene::Body& body) { body.anatomy = {}; });
  for (const double opacity : {0.0, 0.15, 1.0}) {
    const Image with_bones = bareSideOf(world, opacity);
    const Image without = bareSideOf(boneless, opacity);
    std::vector<double> warmth;
    for (std::size_t i = 0; i < with_bones.pixels.size(); ++i) {
      const Pixel& pixel = with_bones.pixels[i];
      if (luminance(without.pixels[i]) > 0.01 || luminance(pixel) < 0.15) continue;
      warmth.push_back(static_cast<double>(pixel[0]) / std::max<int>(1, pixel[2]));
    }
    ASSERT_GT(warmth.size(), 500u);
    std::sort(warmth.begin(), warmth.end());
    EXPECT_LT(warmth[warmth.size() * 98 / 100], 1.45) << "ivory, not terracotta, at opacity " << opacity;
    EXPECT_LT(warmth[warmth.size() * 98 / 100] - warmth[warmth.size() / 50], 0.30) << opacity;
  }
}

TEST_F(SkinLook, IsNotCutWhereItsHandComesNearTheEye) {
  const std::vector<FingerMark> fingers = {pressedFinger(*world_, skinAt(*world_, 40.0, 60.0), 5.0)};
  for (const double distance_mm : {0.0, 900.0, 500.0, 250.0}) {
    for (const double zoom : {1.0, 4.0}) {
      scene::ViewSettings view;
      view.look_at_mm = skinAt(*world_, 30.0, 40.0);
      view.distance_mm = distance_mm;
      view.zoom = zoom;
      view.finger = FingerShape::none;
      const Image bare = capture(settings(view), fingers);
      view.finger = FingerShape::hand;
      const Image hand = capture(settings(view), fingers);
      std::size_t changed = 0;
      std::size_t black = 0;
      for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
        changed += bare.pixels[i] != hand.pixels[i] ? 1 : 0;
        black += luminance(hand.pixels[i]) < 0.02 && luminance(bare.pixels[i]) > 0.1 ? 1 : 0;
      }
      EXPECT_GT(changed, bare.pixels.size() / 100) << distance_mm << " mm, zoom " << zoom;
      EXPECT_EQ(black, 0u) << "nobody looks into a hand that is cut open";
    }
  }
}

TEST_F(SkinLook, HasAHandThatIsOpaqueFromFarAway) {
  const std::vector<FingerMark> fingers = {pressedFinger(*world_, skinAt(*world_, 40.0, 60.0), 5.0)};
  for (const double distance_mm : {0.0, 2500.0, 6000.0}) {
    scene::ViewSettings view;
    view.look_at_mm = skinAt(*world_, 0.0, 0.0);
    view.distance_mm = distance_mm;
    view.zoom = std::max(1.0, distance_mm / 1200.0);
    view.finger = FingerShape::hand;
    const Image image = capture(settings(view), fingers);
    const auto band = std::count_if(image.pixels.begin(), image.pixels.end(),
                                    [](const Pixel& pixel) { return pixel[2] > pixel[0] + 60; });
    EXPECT_GT(band, 60) << "the band round its wrist is blue, " << distance_mm << " mm";
  }
}

TEST_F(SkinLook, HoldsTheWholeForearmBetweenItsPlanes) {
  // A hand pressed anywhere on the back reaches so far from it.
  const PictureSettings whole = settings();
  const Eyes eyes = placeEyes(whole.camera, whole.stereo, kLookAspect);
  const DepthRange range = computeClipRange(eyes, mesh::boundingBox(world_->body->skin), kRoomForHandsMm);
  const double highest_skin = mesh::boundingBox(world_->body->skin).max().z();
  EXPECT_LT(range.near_mm, whole.camera.eye().z() - highest_skin - 400.0);
  EXPECT_GT(range.near_mm, 0.0);
}

TEST(SkinShade, IsDarkInAFoldAndNotOnAPlane) {
  const auto flat = meshWorld(zoo::grid(40, 400.0));
  for (const float open : skyLeft(*flat->deformable)) EXPECT_FLOAT_EQ(open, 1.0f);
  // A valley of a right angle: half of the sky at its ground, all of it on its crests.
  mesh::TriangleMesh valley = zoo::grid(40, 400.0);
  for (Vec3& p : valley.positions) p.z() = std::abs(p.x() - 200.0);
  const auto folded = meshWorld(valley);
  const std::vector<float> open = skyLeft(*folded->deformable);
  for (std::size_t v = 0; v < open.size(); ++v) {
    const Vec3& p = folded->body->skin.positions[v];
    if (std::abs(p.y() - 200.0) > 80.0) continue;
    if (std::abs(p.x() - 200.0) < 1.0) {
      EXPECT_LT(open[v], 0.75f);
      EXPECT_GT(open[v], 0.3f);
    }
    if (std::abs(p.x() - 200.0) > 190.0) {
      EXPECT_GT(open[v], 0.8f);
    }
  }
}

}  // namespace
}  // namespace palpate::view
