// Two eyes before the window: what is not offered, the tracked head, the cursor in halves of a picture.
#include "view/viewer/eyesight.h"

#include <fmt/format.h>

#include "palpate/base/text.h"
#include "palpate/scene/scene_file.h"
#include "stage.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/state/home_view.h"

namespace palpate::viewer {
namespace {

using view::StereoMode;

TEST(Eyesight, QuadBufferIsTakenBackWithAWordWhereItIsNotOffered) {
  ViewerState viewer;
  Eyesight eyesight(false);
  viewer.state.stereo.mode = StereoMode::anaglyph_dubois;
  EXPECT_EQ(eyesight.settings(viewer, viewer).mode, StereoMode::anaglyph_dubois);
  viewer.state.stereo.mode = StereoMode::quad_buffer;
  EXPECT_EQ(eyesight.settings(viewer, viewer).mode, StereoMode::anaglyph_dubois) << "the last mode that could be shown";
  EXPECT_EQ(viewer.state.stereo.mode, StereoMode::anaglyph_dubois);
  ASSERT_EQ(viewer.messages.all().size(), 1u);
  EXPECT_EQ(viewer.messages.all().back().text,
            "quad-buffer stereo is not offered here (it needs a window on a stereo visual); drawing anaglyph-dubois "
            "instead; a screen for shutter glasses needs `--stereo quad-buffer`");
  eyesight.settings(viewer, viewer);
  EXPECT_EQ(viewer.messages.all().size(), 1u) << "said once";
}

TEST(Eyesight, QuadBufferStaysWhereItIsOffered) {
  ViewerState viewer;
  Eyesight eyesight(true);
  viewer.state.stereo.mode = StereoMode::quad_buffer;
  EXPECT_EQ(eyesight.settings(viewer, viewer).mode, StereoMode::quad_buffer);
  EXPECT_TRUE(viewer.messages.all().empty());
}

TEST(Eyesight, TheStereoKeyGoesRoundWithoutQuadBuffer) {
  Stage stage;
  for (std::size_t i = 0; i + 1 < view::kStereoModeNames.size(); ++i) {
    EXPECT_EQ(stage.state().state.stereo.mode, static_cast<StereoMode>(i));
    stage.key(window::key('K'));
  }
  EXPECT_EQ(stage.state().state.stereo.mode, StereoMode::mono);
}

/// The middle of the picture, where nothing tells the time.
std::vector<view::Pixel> bodyIn(const view::Image& image) {
  std::vector<view::Pixel> pixels;
  for (int y = 100; y < 500; ++y) {
    for (int x = 500; x < 1000; ++x) pixels.push_back(image.at(x, y));
  }
  return pixels;
}

TEST(Eyesight, TheHeadMovesThePictureOnlyWhenItIsSwitchedOn) {
  Stage stage;
  stage.state().state.head.on = true;
  stage.frame();
  const auto before = bodyIn(stage.picture());
  for (int i = 0; i < 30; ++i) {
    stage.viewer->headAt({200.0, 100.0, 500.0}, stage.now_s);
    stage.frame();
  }
  EXPECT_NEAR(stage.state().head.eyes_mm.x(), 200.0, 1.0);
  EXPECT_EQ(stage.state().head.state, window::HeadTracker::State::tracking);
  EXPECT_NE(bodyIn(stage.picture()), before);
  stage.state().state.head.on = false;
  stage.frame();
  const auto off = bodyIn(stage.picture());
  stage.viewer->headAt({-300.0, 0.0, 500.0}, stage.now_s);
  stage.frame();
  EXPECT_TRUE(bodyIn(stage.picture()) == off);
}

TEST(Eyesight, PanelsAreUsedInEitherHalfOfAPicture) {
  for (const StereoMode mode : {StereoMode::sbs_half, StereoMode::tb_half}) {
    for (const Vec2& half : {Vec2(0.0, 0.0), Vec2(0.5, 0.5)}) {
      Stage stage;
      stage.state().state.stereo.mode = mode;
      stage.frame();
      const auto place = widgetPlaces().at("panel/Tissue");
      const Vec2 middle(0.5 * (place[0] + place[2]), 0.5 * (place[1] + place[3]));
      const bool beside = mode == StereoMode::sbs_half;
      const Vec2 whole(kStageWidth, kStageHeight);
      const Vec2 squeeze = beside ? Vec2(0.5, 1.0) : Vec2(1.0, 0.5);
      const Vec2 shift = beside ? Vec2(half.x(), 0.0) : Vec2(0.0, half.y());
      stage.move(middle.cwiseProduct(squeeze) + shift.cwiseProduct(whole));
      stage.button(true);
      stage.button(false);
      stage.frame();
      EXPECT_TRUE(widgetPlaces().contains("stiffness/source")) << "the section is open";
    }
  }
}

TEST(SceneLook, AScenesOwnViewIsTakenWhenItIsOpened) {
  Stage stage;
  const auto mesh = stage.folder / "sheet.ply";
  writeFile(
      stage.folder / "rig.toml",
      "[body]\nkind = \"mesh\"\nfile = \"sheet.ply\"\n[view]\ncolours = \"stiffness\"\nstereo = \"anaglyph-grey\"\n"
      "head_mm = [50, 20, 450]\nscreen_height_mm = 240\nyaw_deg = 30\n[[finger]]\nname = \"a\"\n"
      "script = [{ do = \"lift\" }]\n");
  stage.drop(stage.folder / "rig.toml");
  ASSERT_TRUE(stage.until([&] { return stage.state().state.head.on; })) << stage.lastMessage();
  const ViewState& state = stage.state().state;
  EXPECT_EQ(state.look.colouring, view::Colouring::stiffness);
  EXPECT_EQ(state.stereo.mode, StereoMode::anaglyph_grey);
  EXPECT_EQ(state.head.expected_mm, Vec3(50, 20, 450));
  EXPECT_EQ(state.head.screen_height_mm, 240.0);
  EXPECT_TRUE(stage.until([&] { return std::abs(stage.state().camera.yaw_rad - 0.5236) < 1e-3; }));
}

TEST(SceneLook, AScenesOwnViewShowsTheWholeBodyBesidePanelAndPlots) {
  Stage stage;
  for (const char* words : {"yaw_deg = 40", "yaw_deg = -30\npitch_deg = 50", "side = \"above\""}) {
    writeFile(stage.folder / "turned.toml",
              fmt::format("[body]\nkind = \"mesh\"\nfile = \"sheet.ply\"\n[view]\n{}\n[[finger]]\nname = \"a\"\n"
                          "script = [{{ do = \"lift\" }}]\n",
                          words));
    const auto world = scene::build(scene::load(stage.folder / "turned.toml"));
    ViewerState viewer;
    for (const bool panel : {true, false}) {
      viewer.state.shown.panel = panel;
      ASSERT_TRUE(applySceneLook(*world, viewer, Vec2(kStageWidth, kStageHeight)));
      const FreeArea free = freeArea(viewer.state.shown, kStageWidth, kStageHeight);
      const view::Screen screen = view::cameraScreen(viewer.camera, double{kStageWidth} / kStageHeight);
      const view::Frustum frustum = view::makeFrustum(screen, viewer.camera.eye(), 1.0, 1e5);
      for (const Vec3& place : world->body->skin.positions) {
        const Vec2 seen = view::seenAt(frustum, place).cwiseProduct(Vec2(kStageWidth, kStageHeight));
        ASSERT_TRUE(seen.x() >= free.left && seen.x() <= free.right && seen.y() >= free.top && seen.y() <= free.below)
            << words << ": " << seen.transpose();
      }
    }
  }
}

TEST(SceneLook, WhatASceneDoesNotSayStaysTheUsers) {
  Stage stage;
  stage.state().state.look.colouring = view::Colouring::strain;
  writeFile(stage.folder / "plain.toml",
            "[body]\nkind = \"mesh\"\nfile = \"sheet.ply\"\n[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n");
  stage.drop(stage.folder / "plain.toml");
  ASSERT_TRUE(stage.until([&] { return stage.state().document.file.filename() == "plain.toml"; }))
      << stage.lastMessage();
  for (int i = 0; i < 5; ++i) stage.frame();
  EXPECT_EQ(stage.state().state.look.colouring, view::Colouring::strain);
  EXPECT_FALSE(stage.state().state.head.on);
}

}  // namespace
}  // namespace palpate::viewer
