// Dialogs own mouse and keyboard while they are open, however few frames come; and the start page.
#include "stage.h"

#include <imgui.h>

#include "palpate/base/text.h"
#include "palpate/scene/presets.h"
#include "view/viewer/files/input_script.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/start_page.h"
#include "view/viewer/state/free_area.h"
#include "view/viewer/state/home_view.h"

namespace palpate::viewer {
namespace {

using window::InputEvent;
using EventList = std::vector<InputEvent>;

constexpr window::Modifiers kWithCtrl{true, false};

InputEvent keyChange(window::Key key, bool down, window::Modifiers modifiers = {}) {
  InputEvent event;
  event.kind = InputEvent::Kind::key;
  event.key = key;
  event.down = down;
  event.modifiers = modifiers;
  return event;
}

void addTap(EventList& events, window::Key key, window::Modifiers modifiers = {}) {
  events.push_back(keyChange(key, true, modifiers));
  events.push_back(keyChange(key, false, modifiers));
}

/// As a keyboard sends it: keys by their place, and the letters that they write.
void addTyped(EventList& events, std::string_view text) {
  for (const char letter : text) {
    const auto upper = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    const bool has_key = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (has_key) events.push_back(keyChange(window::key(upper), true));
    InputEvent typed;
    typed.kind = InputEvent::Kind::text;
    typed.text = std::string(1, letter);
    events.push_back(typed);
    if (has_key) events.push_back(keyChange(window::key(upper), false));
  }
}

TEST(OpenDialog, HearsEveryLetterAndTheBodyNone) {
  Stage stage;
  const auto overlays = stage.state().state.look.overlays;
  stage.move(stage.middle());
  stage.key(window::key('O'), kWithCtrl);
  for (const char letter : std::string("results/scene.toml")) {
    EventList events;
    addTyped(events, std::string_view(&letter, 1));
    stage.frame(events);
  }
  stage.key(window::Key::enter);
  EXPECT_EQ(stage.state().state.look.overlays, overlays);
  EXPECT_EQ(stage.state().state.look.colouring, view::Colouring::plain);
  EXPECT_FALSE(stage.state().recording.forces);
  EXPECT_FALSE(stage.viewer->pointer().pressed(0));
  EXPECT_TRUE(stage.state().state.shown.open_dialog) << "there is no such file";
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().state.shown.open_dialog);
  stage.key(window::key('W'));
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe)) << "keys are heard again";
}

TEST(OpenDialog, LosesNoTapInOneSlowFrame) {
  Stage stage;
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  EventList events;
  addTap(events, window::key('O'), kWithCtrl);
  addTyped(events, (stage.folder / "ball.plx").string());
  addTap(events, window::Key::backspace);
  addTyped(events, "y");
  addTap(events, window::Key::enter);
  stage.frame(events);
  EXPECT_FALSE(stage.state().state.shown.open_dialog);
  EXPECT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; })) << stage.lastMessage();
}

TEST(OpenDialog, IsCancelledByItsButtonAndByEscapeInOneFrame) {
  Stage stage;
  stage.key(window::key('O'), kWithCtrl);
  stage.frame();
  stage.click("open/cancel");
  EXPECT_FALSE(stage.state().state.shown.open_dialog);
  EventList events;
  addTap(events, window::key('O'), kWithCtrl);
  addTap(events, window::Key::escape);
  addTap(events, window::key('W'));
  stage.frame(events);
  EXPECT_FALSE(stage.state().state.shown.open_dialog);
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe)) << "what comes after it is for the body";
}

TEST(OpenDialog, AClickBesideItTouchesNothing) {
  Stage stage;
  stage.key(window::key('O'), kWithCtrl);
  stage.frame();
  stage.move(Vec2(320, 60));
  const double yaw = stage.state().camera.yaw_rad;
  stage.button(true);
  stage.move(Vec2(420, 60));
  stage.button(false);
  EXPECT_EQ(stage.state().camera.yaw_rad, yaw);
}

TEST(StartPage, TouchClosesIt) {
  Stage stage;
  stage.state().state.shown.start = true;
  stage.frame();
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe)) << "the page owns the keyboard";
  stage.click("start/touch");
  EXPECT_FALSE(stage.state().state.shown.start);
}

TEST(StartPage, APressInTheFrameOfTheClickThatClosesItIsFelt) {
  Stage stage;
  stage.state().state.shown.start = true;
  stage.frame();
  stage.frame();
  const auto& [left, top, right, below] = widgetPlaces().at("start/touch");
  EventList events;
  addButton(events, Vec2(0.5 * (left + right), 0.5 * (top + below)), true);
  addButton(events, events.back().at, false);
  addButton(events, stage.middle(), true);
  stage.frame(events);
  EXPECT_FALSE(stage.state().state.shown.start);
  EXPECT_TRUE(stage.viewer->pointer().pressed(0));
}

TEST(StartPage, LeadsToTheOpenDialogAndToRecentFiles) {
  Stage stage;
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/open");
  stage.frame();
  EXPECT_TRUE(stage.state().state.shown.open_dialog);
  stage.key(window::Key::escape);
  stage.state().state.recent = {(stage.folder / "ball.ply").string()};
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/recent/0");
  EXPECT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; })) << stage.lastMessage();
}

TEST(StartPage, OffersWhatLiesInTheFolderByOneClick) {
  Stage stage;
  for (const char* name : {"ball.ply", "kept.ply"}) mesh::save(stage.folder / name, zoo::sphere(60.0, 3));
  writeFile(stage.folder / "project.toml", "[tool]\n");
  showFolder(stage.folder.path());
  stage.state().state.recent = {(stage.folder / "kept.ply").string()};
  stage.state().state.shown.start = true;
  stage.frame();
  EXPECT_FALSE(widgetPlaces().contains("start/here/kept.ply")) << "twice";
  EXPECT_FALSE(widgetPlaces().contains("start/here/project.toml")) << "of another program";
  stage.click("start/here/ball.ply");
  EXPECT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; })) << stage.lastMessage();
  EXPECT_FALSE(stage.state().state.shown.start);
}

TEST(StartPage, AsksBeforeAnExampleTakesThePlaceOfChanges) {
  Stage stage;
  stage.state().scene.contact.finger.mu_static = 0.9;
  stage.key(window::Key::end);
  ASSERT_TRUE(stage.state().history.changed());
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/vhb");
  stage.frame();
  ASSERT_TRUE(stage.state().question);
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().question);
  EXPECT_EQ(stage.state().scene.contact.finger.mu_static, 0.9);
}

/// A window whose training is another program, in any state.
struct TrainingBeside {
  ActivityState training;
  std::optional<Activity> given_way_to;
  ViewerHost host() {
    ViewerHost host;
    host.activities = [this] { return Activities{training, {}, {}}; };
    host.give_way = [this](Activity activity) { given_way_to = activity; };
    return host;
  }
};

TEST(StartPage, GivesWayToTheTrainingWhereItIsInstalled) {
  TrainingBeside beside{.training = {.kind = ActivityState::Kind::elsewhere}, .given_way_to = {}};
  Stage stage(Stage::quiet(), beside.host());
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/train");
  stage.frame();
  EXPECT_EQ(beside.given_way_to, Activity::training);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST(StartPage, OpensWhatWasAskedForAsSoonAsItIsBuilt) {
  TrainingBeside beside{.training = {.kind = ActivityState::Kind::being_built, .done = 3, .of = 9}, .given_way_to = {}};
  Stage stage(Stage::quiet(), beside.host());
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/train");
  stage.frame();
  EXPECT_EQ(stage.state().awaited, Activity::training);
  EXPECT_FALSE(beside.given_way_to);
  stage.click("start/train");  // not any more
  stage.frame();
  EXPECT_FALSE(stage.state().awaited);
  stage.click("start/train");
  stage.click("start/close");
  EXPECT_FALSE(stage.state().awaited) << "nor after the page was closed";
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/train");
  beside.training.kind = ActivityState::Kind::elsewhere;
  stage.frame();
  stage.frame();
  EXPECT_EQ(beside.given_way_to, Activity::training);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST(StartPage, OffersNothingThatIsMissing) {
  TrainingBeside beside;
  Stage stage(Stage::quiet(), beside.host());
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/train");
  stage.frame();
  EXPECT_TRUE(stage.state().state.shown.start);
  EXPECT_FALSE(beside.given_way_to);
}

TEST(StartPage, HasAPictureOfEveryExample) {
  for (const scene::Preset& preset : scene::presets()) {
    EXPECT_FALSE(pictureBytes(preset.name).empty()) << preset.name;
    EXPECT_NO_THROW(scene::presetScene(preset.name)) << preset.name;
  }
}

TEST(Menus, EscClosesOneThatIsOpenAndNothingElse) {
  Stage stage;
  stage.state().state.shown.help = false;
  stage.click("menu/File");
  stage.frame();
  ASSERT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  stage.key(window::Key::escape);
  stage.frame();
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  stage.click("menu/View");
  stage.frame();
  EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
      << "the next click does its work";
}

TEST(PlaceField, OffersNamesThatHoldWhatWasTyped) {
  const std::vector<body::SkinLandmark> landmarks = {{"spinous_T6", "", {0, 40, 0}, Vec3::UnitZ(), {}},
                                                     {"spinous_T12", "", {0, -90, 0}, Vec3::UnitZ(), {}},
                                                     {"psis_left", "", {-48, -295, 0}, Vec3::UnitZ(), {}}};
  EXPECT_EQ(placesLike(landmarks, "psis"), std::vector<std::string>{"left PSIS"});
  EXPECT_EQ(placesLike(landmarks, "PSIS left"), std::vector<std::string>{"left PSIS"});
  EXPECT_EQ(placesLike(landmarks, "t").front(), "T6");
  EXPECT_TRUE(placesLike(landmarks, " ").empty());
  EXPECT_TRUE(placesLike(landmarks, "knee").empty());
}

TEST(PlaceField, NamesPlacesThatTheBodyHas) {
  const auto at = [](const char* name) { return body::SkinLandmark{name, "", {0, 0, 0}, Vec3::UnitZ(), {}}; };
  EXPECT_EQ(examplePlaces(std::vector{at("spinous_T1"), at("spinous_T6"), at("psis_left")}), "T6, left PSIS");
  EXPECT_EQ(examplePlaces(std::vector{at("spinous_T6"), at("rib_7_left_angle")}), "T6, left rib 7 angle");
  EXPECT_EQ(examplePlaces(std::vector{at("spinous_L1")}).find("PSIS"), std::string::npos);
  EXPECT_EQ(examplePlaces({}), "");
}

TEST(PlaceField, FliesToTheFirstNameThatFits) {
  const support::TemporaryFolder folder;
  const view::OffscreenContext context;
  ViewerSettings settings;
  settings.intro = false;
  settings.output_folder = folder.path();
  settings.default_scene = sheetScene(folder);
  Viewer viewer(scene::build(scene::presetScene("vhb")), Stage::quiet(), std::move(settings));
  double now_s = 0.0;
  const auto frame = [&](const EventList& events) {
    viewer.frame(kStageWidth, kStageHeight, 1.0, now_s += 0.1, events);
  };
  frame({});
  const double far = viewer.state().camera.distance_mm;
  EventList events;
  addTap(events, window::key('F'), kWithCtrl);
  frame(events);
  frame({});
  events.clear();
  addTyped(events, "T9");
  addTap(events, window::Key::enter);
  frame(events);
  for (int i = 0; i < 10; ++i) frame({});
  EXPECT_LT(viewer.state().camera.distance_mm, 0.6 * far);
  EXPECT_EQ(viewer.state().place_words, "T9");
  events.clear();
  addTap(events, window::Key::enter);
  frame(events);
  for (int i = 0; i < 5; ++i) frame({});
  EXPECT_TRUE(viewer.pointer().pressed(viewer.state().active_finger));
  EXPECT_EQ(viewer.state().place_words, "T9") << "with the mouse at rest elsewhere";
}

TEST(PlaceField, TakesWhatAScriptTypes) {
  const scene::Scene scene = scene::presetScene("vhb");
  Stage stage(scene);
  const double far = stage.state().camera.distance_mm;
  for (const ScriptEvent& event : parseInputScript("0, key, Ctrl+F\n1, text, T9\n2, key, Enter\n", "s.csv")) {
    stage.frame({event.input});
    stage.frame();
  }
  for (int i = 0; i < 10; ++i) stage.frame();
  EXPECT_LT(stage.state().camera.distance_mm, 0.6 * far);
}

TEST(PlaceField, CentresThePlaceInWhatPanelAndPlotsLeaveFree) {
  constexpr float kWidth = 1280.0f, kHeight = 800.0f;
  Shown shown;
  shown.panel = shown.plots = true;
  view::Camera camera;
  camera.distance_mm = 500.0;
  const Vec3 place(30, 40, 0);
  const view::Camera centred = centredInFreePart(camera, place, shown, Vec2(kWidth, kHeight));
  const view::Frustum eye =
      view::makeFrustum(view::cameraScreen(centred, kWidth / kHeight), centred.eye(), 10.0, 2000.0);
  const Vec2 seen = view::seenAt(eye, place).cwiseProduct(Vec2(kWidth, kHeight));
  const FreeArea free = freeArea(shown, kWidth, kHeight);
  EXPECT_NEAR(seen.x(), 0.5 * (free.left + free.right), 1.0);
  EXPECT_NEAR(seen.y(), 0.5 * (free.top + free.below), 1.0);
}

}  // namespace
}  // namespace palpate::viewer
