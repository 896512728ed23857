// Each panel, menu and dialog in each language in the smallest window that is promised, 640x480: no text is cut and
// none lies over another. Training and the measuring window have tests of their own, of the same kind.
#include "palpate/base/language.h"
#include "palpate/body/places.h"
#include "palpate/view/overlays/place_words.h"
#include "palpate/view/overlays/section.h"
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

// ---- places are read and typed in the language of the window, and kept in English

using view::placeInEnglish;
using view::placeInLanguage;

class PlaceWords : public testing::Test {
 protected:
  void TearDown() override { useLanguage("en"); }
  static body::SkinLandmark markAt(const char* name, const Vec3& position) {
    body::SkinLandmark mark;
    mark.name = name;
    mark.position = position;
    return mark;
  }
  const std::vector<body::SkinLandmark> landmarks = {markAt("spinous_T6", Vec3(0, 40, 0)),
                                                     markAt("psis_left", Vec3(-40, -150, 0)),
                                                     markAt("rib_7_right_angle", Vec3(60, 20, 0))};
};

TEST_F(PlaceWords, AreTheSameInEnglish) {
  for (const char* words : {"T6", "T9 right 32 mm", "left PSIS", "right rib 7 angle, 12 mm right and 8 mm up"}) {
    EXPECT_EQ(placeInLanguage(words), words);
    EXPECT_EQ(placeInEnglish(landmarks, words), words);
  }
}

TEST_F(PlaceWords, OfACutAndOfTheAxesAreInTheLanguage) {
  useLanguage("es");
  const view::SectionEnds across = view::sectionEnds({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()});
  EXPECT_EQ(across.low + ", " + across.high, "A izquierda, B derecha");
  const view::SectionEnds along = view::sectionEnds({Vec3::Zero(), -Vec3::UnitY(), Vec3::UnitZ()});
  EXPECT_EQ(along.low + ", " + along.high, "A craneal, B caudal");
  EXPECT_EQ(std::string(tr("R")) + tr("L"), "DI");
}

TEST_F(PlaceWords, AreReadInTheLanguage) {
  useLanguage("de");
  EXPECT_EQ(placeInLanguage("T9 right 32 mm down 8 mm"), "T9 rechts 32 mm unten 8 mm");
  EXPECT_EQ(placeInLanguage("T6, 12 mm left and 8 mm up"), "T6, 12 mm links und 8 mm oben");
  EXPECT_EQ(placeInLanguage("right rib 7 angle"), "rechter Rippenwinkel 7");
  EXPECT_EQ(placeInLanguage("left PSIS, 8 mm up"), "linke SIPS, 8 mm oben");
  EXPECT_EQ(placeInLanguage("somewhere else"), "somewhere else");
  useLanguage("es");
  EXPECT_EQ(placeInLanguage("T9 right 32 mm"), "T9 derecha 32 mm");
  EXPECT_EQ(placeInLanguage("left rib 7"), "costilla 7 izquierda");
}

TEST_F(PlaceWords, AreTypedInEitherLanguageAndKeptInEnglish) {
  for (const char* code : {"de", "es"}) {
    useLanguage(code);
    for (const char* english : {"T6", "T6 right 32 mm down 8 mm", "left PSIS left 5 mm", "right rib 7 angle"}) {
      EXPECT_EQ(placeInEnglish(landmarks, english), english) << code;
      EXPECT_EQ(placeInEnglish(landmarks, placeInLanguage(english)), english) << code;
      EXPECT_EQ(body::placeNamed(landmarks, placeInEnglish(landmarks, placeInLanguage(english))).name, english);
    }
  }
  useLanguage("de");
  EXPECT_EQ(placeInEnglish(landmarks, "t6 LINKS 40mm"), "T6 left 40mm");
}

/// Every name of the built-in bodies has one in every language, and no two are the same.
TEST_F(PlaceWords, NamesOfABodyDifferInEveryLanguage) {
  const char* const names[] = {"left acromion",
                               "left clavicle sternal end",
                               "coccyx tip",
                               "right costochondral 4",
                               "left greater tubercle",
                               "right iliac crest",
                               "left ischial tuberosity",
                               "jugular notch",
                               "left pubic tubercle",
                               "right scapula acromial angle",
                               "left scapula inferior angle",
                               "left scapula spine root",
                               "left scapula superior angle",
                               "sternal angle",
                               "xiphoid tip",
                               "right site 4",
                               "left cartilage 3",
                               "left hip",
                               "right humerus",
                               "sacrum",
                               "sternum"};
  for (const char* code : {"de", "es"}) {
    useLanguage(code);
    for (const char* name : names) EXPECT_NE(placeInLanguage(name), name) << code;
  }
}

}  // namespace
}  // namespace palpate::viewer
