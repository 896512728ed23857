#include "palpate/view/scene_view.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "palpate/scene/scene_file.h"
#include "support/error_message.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

scene::ViewSettings parsed(const std::string& lines) {
  const std::string finger = "\n[[finger]]\nname = \"a\"\nscript = [{ do = \"hold\" }]\n";
  return scene::parse("[view]\n" + lines + finger, "test.toml").view;
}

const scene::World& smallWorld() {
  static const scene::World world = [] {
    scene::World small = *flatWorld();
    auto stiffness_n_per_mm = std::make_shared<std::vector<double>>(*small.surface.stiffness_n_per_mm);
    stiffness_n_per_mm->front() = 0.4;
    stiffness_n_per_mm->back() = 1.0;
    small.surface.stiffness_n_per_mm = std::move(stiffness_n_per_mm);
    return small;
  }();
  return world;
}

template <class Names>
void expectAllKnown(const Names& names, const std::string& key, const std::string& form = "{} = \"{}\"") {
  for (const std::string_view name : names) {
    const scene::ViewSettings view = parsed(fmt::format(fmt::runtime(form), key, name));
    EXPECT_NO_THROW(pictureSettings(smallWorld(), view, 1.5)) << key << " " << name;
  }
}

TEST(SceneView, KnowsEveryNameOfTheRoomsThatDraw) {
  expectAllKnown(kStandardViewNames, "side");
  expectAllKnown(kShadingNames, "shading");
  expectAllKnown(kColouringNames, "colours");
  expectAllKnown(kOverlayNames, "show", "{} = [\"{}\"]");
  expectAllKnown(kFingerShapeNames, "finger");
  expectAllKnown(kStereoModeNames, "stereo");
}

TEST(SceneView, BecomesTheSettingsOfThePicture) {
  const PictureSettings settings =
      pictureSettings(smallWorld(),
                      parsed("yaw_deg = 30\nzoom = 2\nlook_at_mm = [10, 20, 0]\nshow = [\"wireframe\", \"contact\"]\n"
                             "colours = \"stiffness\"\nopacity = 0.4\nstereo = \"tb-half\"\neye_distance_mm = 58\n"
                             "head_mm = [5, 6, 700]\nscreen_height_mm = 280"),
                      1.5);
  EXPECT_NEAR(settings.camera.yaw_rad, std::numbers::pi / 6.0, 1e-12);
  EXPECT_TRUE(settings.camera.centre.isApprox(Vec3(10, 20, 0)));
  EXPECT_NEAR(std::tan(0.5 * settings.camera.height_rad), 0.5 * std::tan(0.5 * Camera{}.height_rad), 1e-12);
  EXPECT_TRUE(settings.look.shows(Overlay::wireframe) && settings.look.shows(Overlay::contact));
  EXPECT_FALSE(settings.look.shows(Overlay::rings));
  EXPECT_EQ(settings.look.colouring, Colouring::stiffness);
  EXPECT_EQ(settings.look.range().low, 0.4);
  EXPECT_EQ(settings.look.range().high, 1.0);
  EXPECT_EQ(settings.stereo.mode, StereoMode::tb_half);
  EXPECT_EQ(settings.stereo.head->eyes_mm, Vec3(5, 6, 700));
  EXPECT_EQ(settings.stereo.head->screen_height_mm, 280.0);
}

TEST(SceneView, RefusesAHeadBehindItsScreen) {
  EXPECT_EQ(support::thrownMessage([] { parsed("head_mm = [0, 0, -1]"); }),
            "test.toml:1: [view] head_mm must be in front of the screen: third number > 0");
}

TEST(SceneView, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(support::thrownMessage([] { parsed("show = [\"wirefame\"]"); }).find("\"wireframe\""), std::string::npos);
  EXPECT_EQ(support::thrownMessage([] { parsed("side = \"inside\""); }),
            "test.toml:2: [view] side must be \"back\" or \"left\" or \"right\" or \"above\" or \"front\" or \"table\" "
            "or \"below\", not \"inside\"");
}

}  // namespace
}  // namespace palpate::view
