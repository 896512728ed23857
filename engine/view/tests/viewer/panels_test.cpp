// Every panel, drawn without a window, and used by the names of its controls.
#include "stage.h"

#include <imgui.h>

#include <algorithm>

#include "support/contrast.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/plots/plot_drawing.h"

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
    const view::Image closed = stage.picture();
    stage.click(std::string("panel/") + panel.name);
    EXPECT_TRUE(widgetPlaces().size() > before || panel.name == std::string_view("Performance")) << panel.name;
    EXPECT_GT(changed(closed, stage.picture()), 0.003) << panel.name;
  }
}

TEST(Panels, PagesAndDialogsShowAndHide) {
  Stage stage;
  for (const window::Key key : {window::functionKey(1), window::functionKey(4), window::Key::tab}) {
    const view::Image before = stage.picture();
    stage.key(key);
    EXPECT_GT(changed(before, stage.picture()), 0.01) << window::nameOf({key, {}});
    stage.key(key);
    EXPECT_LT(changed(before, stage.picture()), 0.02);
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
  stage.click("show/engine");
  stage.click("show/wireframe");
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe));
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe));
}

TEST(Panels, ASliderOfTheSceneReachesTheServoAndTheFile) {
  Stage stage;
  stage.frame();
  ASSERT_TRUE(widgetPlaces().contains("friction/static"));
  const auto [left, top, right, below] = widgetPlaces().at("friction/static");
  const double before = stage.state().scene.contact.finger.mu_static;
  stage.move(Vec2(left + 0.75 * (right - left) * 0.5, 0.5 * (top + below)));
  stage.button(true);
  stage.button(false);
  EXPECT_NE(stage.state().scene.contact.finger.mu_static, before);
}

/// The brightest of a place on the screen; letters of the dark theme have 235.
int brightestIn(const view::Image& image, const std::array<float, 4>& place) {
  int most = 0;
  for (int y = static_cast<int>(place[1]); y < static_cast<int>(place[3]); ++y) {
    for (int x = static_cast<int>(place[0]); x < static_cast<int>(place[2]); ++x) {
      most = std::max<int>(most, image.at(x, y)[1]);
    }
  }
  return most;
}

TEST(Panels, NoDigitLiesUnderTheGrabOfASlider) {
  Stage stage;
  for (const double depth : {0.0, 6.0, 12.5, 25.0}) {
    stage.state().state.touch.depth_mm = depth;
    stage.frame();
    std::array<float, 4> track = widgetPlaces().at("touch/depth");
    const view::Image image = stage.picture();
    EXPECT_LT(brightestIn(image, track), 200) << depth;
    EXPECT_GT(brightestIn(image, {track[0] - 62.0f, track[1], track[0], track[3]}), 220) << "the number beside it";
  }
}

support::SeenColour seen(const ImVec4& colour, const support::SeenColour& below) {
  return support::blended(below, {255.0 * colour.x, 255.0 * colour.y, 255.0 * colour.z}, colour.w);
}

TEST(Panels, LettersOfEveryThemeStandOutFromWhatTheyLieOn) {
  Stage stage;
  for (const window::Theme theme : {window::Theme::dark, window::Theme::light, window::Theme::contrast}) {
    stage.state().state.theme = theme;
    stage.frame();
    stage.frame();
    const ImVec4* colours = ImGui::GetStyle().Colors;
    const support::SeenColour behind = {120.0, 110.0, 105.0};  // the body, behind what is not quite opaque
    const auto window = seen(colours[ImGuiCol_WindowBg], behind);
    for (const ImGuiCol ground : {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_FrameBg, ImGuiCol_Button,
                                  ImGuiCol_Header, ImGuiCol_MenuBarBg}) {
      const auto below = seen(colours[ground], window);
      EXPECT_GT(support::contrastOf(seen(colours[ImGuiCol_Text], below), below), 4.5)
          << static_cast<int>(theme) << " " << ImGui::GetStyleColorName(ground);
    }
    for (const ImVec4& ink :
         {colours[ImGuiCol_TextDisabled], ImGui::ColorConvertU32ToFloat4(fingerInk(0)),
          ImGui::ColorConvertU32ToFloat4(fingerInk(1)), ImGui::ColorConvertU32ToFloat4(limitInk())}) {
      EXPECT_GT(support::contrastOf(seen(ink, window), window), 4.5) << static_cast<int>(theme);
    }
  }
}

TEST(Panels, ThemesAndTextSizesDraw) {
  Stage stage;
  const view::Image dark = stage.picture();
  stage.state().state.theme = window::Theme::light;
  stage.frame();
  stage.frame();
  EXPECT_GT(changed(dark, stage.picture()), 0.1);
  stage.state().state.theme = window::Theme::contrast;
  stage.state().state.text_size = 1.5;
  stage.frame();
  stage.frame();
  EXPECT_GT(changed(dark, stage.picture()), 0.1);
}

TEST(Panels, EveryStereoModeDrawsThemForBothEyes) {
  for (std::size_t mode = 0; mode < view::kStereoModeNames.size(); ++mode) {
    ViewState state = Stage::quiet();
    state.stereo.mode = static_cast<view::StereoMode>(mode);
    Stage stage(state);
    stage.frame();
    EXPECT_EQ(stage.picture().width, kStageWidth) << view::kStereoModeNames[mode];
  }
}

}  // namespace
}  // namespace palpate::viewer
