// A body that breathes is drawn where it is: judged by its outline in the picture.
#include <gtest/gtest.h>

#include "palpate/scene/scene_file.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"

namespace palpate::view {
namespace {

constexpr PictureSize kSize{480, 480, 1};

/// Last pixel of a row that is not background, which is black.
int findLastBodyPixel(const Image& image, int row) {
  int last = 0;
  for (int x = 0; x < image.width; ++x) {
    if (image.at(x, row)[0] > 40) last = x;
  }
  return last;
}

TEST(BreathingPicture, ShowsTheOutlineMovedByTheBreathOverTheRibsAndNotOverThePelvis) {
  const auto world = scene::build(scene::parse(R"(
[body]
triangles = 12000
[breathing]
on = true
depth_mm = 10
[view]
side = "left"
zoom = 2
[[finger]]
name = "index"
at = "T6"
script = [{ do = "hold" }]
)",
                                               "breathing.toml"));
  PictureSettings settings = pictureSettings(*world, 1.0);
  settings.labels = LabelSettings::none();
  settings.look.shading = Shading::gouraud;
  settings.look.plain_background = 0.0;
  settings.camera.centre = Vec3(0, -150, 60);
  const deform::DeformedSurface rest(*world->deformable);
  Studio studio(world);
  const Image out = studio.capture(rest, {}, settings, kSize).image;
  const Image in = studio.capture(rest, {.fingers = {}, .lift_mm = 10.0}, settings, kSize).image;
  const double pixels_per_mm =
      kSize.height / (2.0 * settings.camera.distance_mm * std::tan(0.5 * settings.camera.height_rad));
  const auto row = [&](const char* name) {
    for (const auto& landmark : world->body->anatomy.landmarks) {
      if (landmark.name == name) {
        return static_cast<int>(kSize.height * 0.5 -
                                pixels_per_mm * (landmark.position.y() - settings.camera.centre.y()));
      }
    }
    return 0;
  };
  const int ribs = row("spinous_T10");
  const int pelvis = row("spinous_L5") + 10;
  ASSERT_GT(findLastBodyPixel(out, ribs), 100);
  EXPECT_NEAR(findLastBodyPixel(in, ribs) - findLastBodyPixel(out, ribs), 10.0 * pixels_per_mm, 1.5);
  EXPECT_EQ(findLastBodyPixel(in, pelvis), findLastBodyPixel(out, pelvis));
}

}  // namespace
}  // namespace palpate::view
