// Every panel, drawn without a window, and used by the names of its controls.
#include "stage.h"

#include "apps/viewer/panels/gui_layout.h"

namespace palpate::viewer {
namespace {

/// Share of the pixels that differ between two pictures of one size.
double changed(const view::Image& a, const view::Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

TEST(Panels, EveryOneOpensAndDrawsItsControls) {
  for (const PanelEntry& panel : panelList()) {
    Stage stage;
    stage.click("panel/Touch");  // the first one is open: closed now
    const std::size_t before = widgetPlaces().size();
    const view::Image closed = stage.viewer->target().read();
    stage.click(std::string("panel/") + panel.name);
    EXPECT_TRUE(widgetPlaces().size() > before || panel.name == std::string_view("Performance")) << panel.name;
    EXPECT_GT(changed(closed, stage.viewer->target().read()), 0.003) << panel.name;
  }
}

TEST(Panels, PagesAndDialogsShowAndHide) {
  Stage stage;
  for (const window::Key key : {window::functionKey(1), window::functionKey(4), window::Key::tab}) {
    const view::Image before = stage.viewer->target().read();
    stage.key(key);
    EXPECT_GT(changed(before, stage.viewer->target().read()), 0.01) << window::nameOf({key, {}});
    stage.key(key);
    EXPECT_LT(changed(before, stage.viewer->target().read()), 0.02);
  }
  stage.key(window::key('O'), {true, false});
  stage.frame();
  EXPECT_TRUE(widgetPlaces().contains("open/open"));
  stage.key(window::Key::escape);
  stage.frame();
  EXPECT_FALSE(widgetPlaces().contains("open/open"));
}

TEST(Panels, ACheckboxAndItsKeyAreTheSameSwitch) {
  Stage stage;
  stage.click("panel/Touch");
  stage.click("panel/Show");
  stage.click("show/wireframe");
  EXPECT_TRUE(stage.session().state.look.shows(view::Overlay::wireframe));
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.session().state.look.shows(view::Overlay::wireframe));
}

TEST(Panels, ASliderOfTheSceneReachesTheServoAndTheFile) {
  Stage stage;
  stage.frame();
  ASSERT_TRUE(widgetPlaces().contains("friction/static"));
  const auto [left, top, right, below] = widgetPlaces().at("friction/static");
  const double before = stage.session().scene.contact.finger.mu_static;
  stage.move(Vec2(left + 0.75 * (right - left) * 0.5, 0.5 * (top + below)));
  stage.button(true);
  stage.button(false);
  EXPECT_NE(stage.session().scene.contact.finger.mu_static, before);
}

TEST(Panels, ThemesAndTextSizesDraw) {
  Stage stage;
  const view::Image dark = stage.viewer->target().read();
  stage.session().state.theme = window::Theme::light;
  stage.frame();
  stage.frame();
  EXPECT_GT(changed(dark, stage.viewer->target().read()), 0.1);
  stage.session().state.theme = window::Theme::contrast;
  stage.session().state.text_size = 1.5;
  stage.frame();
  stage.frame();
  EXPECT_GT(changed(dark, stage.viewer->target().read()), 0.1);
}

TEST(Panels, EveryStereoModeDrawsThemForBothEyes) {
  for (std::size_t mode = 0; mode < view::kStereoModeNames.size(); ++mode) {
    ViewState state = Stage::quiet();
    state.stereo.mode = static_cast<view::StereoMode>(mode);
    Stage stage(state);
    stage.frame();
    EXPECT_EQ(stage.viewer->target().read().width, kStageWidth) << view::kStereoModeNames[mode];
  }
}

}  // namespace
}  // namespace palpate::viewer
