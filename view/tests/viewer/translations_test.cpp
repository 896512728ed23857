// Each panel, menu and dialog in each language in the smallest window that is promised, 640x480: no text is cut and
// none lies over another. Training and the measuring window have tests of their own, of the same kind.
#include "palpate/base/language.h"
#include "stage.h"
#include "text_fit.h"
#include "view/viewer/panels/gui_layout.h"

namespace palpate::viewer {
namespace {

class Translations : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { useLanguage(GetParam()); }
  void TearDown() override { useLanguage("en"); }

  /// In the state in which it stands now.
  static void expectFits(Stage& stage, const std::string& what) {
    for (int i = 0; i < 3; ++i) stage.smallFrame();  // windows that fit their contents know them after a frame
    expectTextsFit(GetParam(), what);
  }
};

TEST_P(Translations, OfEveryPanelFit) {
  for (const PanelEntry& panel : panelList()) {
    Stage stage;
    stage.state().scene.dysfunctions.push_back({.x_mm = 10.0, .y_mm = 20.0, .radius_mm = 15.0, .change_percent = 60.0});
    stage.click("panel/Touch");  // it is open at first
    stage.click(std::string("panel/") + panel.name);
    if (panel.name == std::string("Show")) stage.click("show/engine");
    expectFits(stage, panel.name);
  }
}

TEST_P(Translations, OfEveryMenuFit) {
  for (const char* menu : {"File", "View", "Show", "Help"}) {
    Stage stage;
    stage.state().state.recent = {"/tmp/a.toml"};
    stage.click(std::string("menu/") + menu);
    expectFits(stage, menu);
  }
}

TEST_P(Translations, OfEveryDialogAndPageFit) {
  const std::vector<std::pair<const char*, bool Shown::*>> pages = {{"picture", &Shown::picture_dialog},
                                                                    {"film", &Shown::film_dialog},
                                                                    {"open", &Shown::open_dialog},
                                                                    {"save", &Shown::save_dialog},
                                                                    {"class", &Shown::class_dialog},
                                                                    {"start page", &Shown::start},
                                                                    {"help", &Shown::help},
                                                                    {"messages", &Shown::messages}};
  for (const auto& [name, which] : pages) {
    Stage stage;
    stage.state().class_shown.offered = true;
    stage.state().state.shown.*which = true;
    expectFits(stage, name);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Translations, testing::Values("en", "de", "es"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace palpate::viewer
