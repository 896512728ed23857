// Nothing is lost by a slip: saving, questions, undo of everything, as a user meets them.
#include "stage.h"

#include "palpate/base/text.h"
#include "view/viewer/files/scene_snippet.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

constexpr window::Modifiers kCtrl{true, false};
constexpr window::Modifiers kCtrlShift{true, true};

constexpr const char* kByHand = R"(# The sheet that I measured on Monday.
title = "a sheet"

[body]
kind = "mesh"
file = "sheet.ply"   # of the scanner

[friction]
static = 0.5   # dry
)";

std::string textOf(const fs::path& file) { return readFile(file, 1 << 20); }

/// Opens a scene file of the stage's sheet, and waits until it is shown.
fs::path openByHand(Stage& stage, const char* text = kByHand) {
  const fs::path file = stage.folder / "hand.toml";
  writeFile(file, text);
  stage.drop(file);
  EXPECT_TRUE(stage.until([&] { return stage.state().document.file == file && !stage.state().opening; }))
      << stage.lastMessage();
  return file;
}

void changeGrip(Stage& stage, double grip) {
  stage.state().scene.contact.finger.mu_static = grip;
  stage.key(window::Key::end);  // any key: the change is seen in its frame
}

TEST(Saving, KeepsTheCommentsOfAPersonsFile) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  EXPECT_TRUE(stage.state().history.changed());
  stage.key(window::key('S'), kCtrl);
  std::string expected = kByHand;
  expected.replace(expected.find("0.5 "), 3, "0.75");
  EXPECT_EQ(textOf(file), expected);
  EXPECT_EQ(stage.lastMessage(), "The scene is saved as " + file.string());
  EXPECT_FALSE(stage.state().history.changed());
  stage.key(window::key('S'), kCtrl);
  EXPECT_EQ(stage.lastMessage(), "Nothing to save: " + file.string() + " is up to date");
}

TEST(Saving, AnEndThatCannotAskKeepsTheChangesBesideTheScene) {
  Stage stage;
  const fs::path file = openByHand(stage);
  EXPECT_EQ(stage.viewer->saveBackup(), fs::path()) << "nothing was changed";
  changeGrip(stage, 0.75);
  const fs::path kept = stage.viewer->saveBackup();
  EXPECT_EQ(kept, stage.folder / "hand-backup.toml");
  EXPECT_EQ(scene::load(kept).contact.finger.mu_static, 0.75);
  EXPECT_EQ(textOf(file), kByHand) << "as it was";
  EXPECT_EQ(stage.viewer->saveBackup(), stage.folder / "hand-backup-2.toml") << "no backup is overwritten";
}

TEST(Saving, WhereCommentsCannotStayTheOldFileIsKept) {
  Stage stage;
  const char* dotted = "# mine\nbody.kind = \"mesh\"\nbody.file = \"sheet.ply\"\nfriction.static = 0.5\n";
  const fs::path file = openByHand(stage, dotted);
  stage.state().scene.contact.finger.mu_dynamic = 0.1;
  stage.key(window::key('S'), kCtrl);
  EXPECT_EQ(textOf(file.string() + ".bak"), dotted);
  EXPECT_NE(stage.lastMessage().find("hand.toml.bak"), std::string::npos) << stage.lastMessage();
  EXPECT_EQ(scene::load(file).contact.finger.mu_dynamic, 0.1);
}

TEST(Saving, AColouringAloneIsNoReasonToAskOnLeaving) {
  Stage stage;
  stage.key(window::key('S'));
  EXPECT_FALSE(stage.state().history.sceneChanged());
  stage.key(window::key('Q'), kCtrl);
  EXPECT_FALSE(stage.state().question);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST(Saving, KnowsTheFileAsItWasWhenItWasReadNotWhenTheBodyWasBuilt) {
  Stage stage;
  const fs::path file = stage.folder / "hand.toml";
  writeFile(file, kByHand);
  const OpenedScene opened = sceneFromFile(file.string(), {});
  writeFile(file, "# saved by another window meanwhile\n");
  EXPECT_TRUE(wouldOverwrite(opened.document, file));
}

TEST(Saving, AsksBeforeItWritesOverWhatSomebodyElseWrote) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  writeFile(file, "# changed in an editor meanwhile\n");
  stage.key(window::key('S'), kCtrl);
  ASSERT_TRUE(stage.state().question);
  EXPECT_EQ(textOf(file), "# changed in an editor meanwhile\n");
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().question);
  EXPECT_EQ(textOf(file), "# changed in an editor meanwhile\n");
  stage.key(window::key('S'), kCtrl);
  stage.click("question/Overwrite");
  EXPECT_EQ(scene::load(file).contact.finger.mu_static, 0.75);
}

TEST(Saving, WithoutAFileItGoesToTheOutputFolderUnderAFreshName) {
  Stage stage;
  writeFile(stage.folder / "scene.toml", "# somebody's\n");
  stage.key(window::key('S'), kCtrl);
  EXPECT_EQ(textOf(stage.folder / "scene.toml"), "# somebody's\n");
  EXPECT_EQ(stage.lastMessage(), "The scene is saved as " + (stage.folder / "scene-2.toml").string());
}

TEST(Saving, AsAnotherFileByItsDialog) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  stage.key(window::key('S'), kCtrlShift);
  stage.frame();
  stage.frame();
  ASSERT_TRUE(widgetPlaces().contains("save/save"));
  stage.state().state.shown.save_dialog = false;  // its field was offered the present name
  stage.state().request(SaveScene{(stage.folder / "other.toml").string()});
  stage.frame();
  EXPECT_EQ(textOf(file), kByHand) << "the first one stays as it was";
  EXPECT_NE(textOf(stage.folder / "other.toml").find("# dry"), std::string::npos);
  EXPECT_EQ(stage.state().document.file, stage.folder / "other.toml");
  stage.key(window::key('S'), kCtrlShift);
  stage.frame();
  stage.frame();
  stage.click("save/save");
  EXPECT_FALSE(stage.state().state.shown.save_dialog);
  EXPECT_FALSE(stage.state().question) << "it knows that file";
  EXPECT_TRUE(stage.lastMessage().starts_with("Nothing to save")) << stage.lastMessage();
}

TEST(Saving, AMeshIsSavedWithoutTheFingersOfTheBodyBefore) {
  Stage stage;
  ASSERT_FALSE(stage.state().scene.fingers.empty());
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.drop(stage.folder / "ball.ply");
  ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply" && !stage.state().opening; }));
  stage.key(window::key('S'), kCtrl);
  const fs::path file = stage.state().document.file;
  EXPECT_EQ(textOf(file).find("[[finger"), std::string::npos) << textOf(file);
  EXPECT_NE(textOf(file).find("file = \"ball.ply\""), std::string::npos);
}

TEST(Saving, CameraColoursAndOverlaysComeBack) {
  Stage stage;
  const fs::path file = openByHand(stage);
  stage.key(window::key('W'));
  stage.key(window::key('S'));
  stage.move(Vec2(320, 60));
  stage.button(true);
  stage.move(Vec2(420, 90));
  stage.button(false);
  stage.scroll(3.0);
  const view::Camera camera = stage.state().camera;
  stage.state().state.look.stiffness_n_per_mm = {0.4, 0.9};
  stage.state().state.look.half_major_mm = {60.0, 150.0};
  stage.key(window::key('S'), kCtrl);
  EXPECT_NE(textOf(file).find("show = [\"wireframe\"]"), std::string::npos) << textOf(file);
  EXPECT_NE(textOf(file).find("# of the scanner"), std::string::npos);
  stage.state().state.look = Stage::quiet().look;
  stage.key(window::Key::home);
  stage.key(window::functionKey(5));
  EXPECT_FALSE(stage.state().question) << "neither a view nor a look is worth one";
  ASSERT_TRUE(stage.until([&] { return !stage.state().opening && !stage.state().building; }));
  for (int i = 0; i < 3; ++i) stage.frame();
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe));
  const view::Look& look = stage.state().state.look;
  EXPECT_EQ(look.colouring, view::Colouring::strain);
  EXPECT_EQ(look.stiffness_n_per_mm.low, 0.4);
  EXPECT_EQ(look.stiffness_n_per_mm.high, 0.9);
  EXPECT_EQ(look.half_major_mm.low, 60.0);
  EXPECT_EQ(look.half_major_mm.high, 150.0);
  EXPECT_NEAR(stage.state().camera.yaw_rad, camera.yaw_rad, 1e-4);
  EXPECT_NEAR(stage.state().camera.pitch_rad, camera.pitch_rad, 1e-4);
  EXPECT_NEAR(stage.state().camera.distance_mm, camera.distance_mm, 0.2);
  EXPECT_LT((stage.state().camera.centre - camera.centre).norm(), 0.1);
}

TEST(Saving, TheTitleHasAStarWhileThereIsSomethingToSave) {
  std::string title;
  ViewerHost host;
  host.set_title = [&](const std::string& words) { title = words; };
  Stage stage(Stage::quiet(), host);
  openByHand(stage);
  EXPECT_EQ(title, "hand.toml - Palpate");
  stage.key(window::key('W'));
  EXPECT_EQ(title, "hand.toml * - Palpate");
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(title, "hand.toml - Palpate");
  stage.move(Vec2(320, 60));
  stage.button(true);
  stage.move(Vec2(420, 90));
  stage.button(false);
  EXPECT_EQ(title, "hand.toml - Palpate") << "turning is looking";
}

TEST(Saving, TheTitleNamesThePresetUntilItIsAFile) {
  std::string title;
  ViewerHost host;
  host.set_title = [&](const std::string& words) { title = words; };
  Stage stage(Stage::quiet(), host);
  stage.state().request(OpenPreset{"vhb"});
  ASSERT_TRUE(stage.until([&] { return title == "Virtual Haptic Back - Palpate"; })) << title;
  stage.state().request(SaveScene{.file = (stage.folder / "mine.toml").string()});
  ASSERT_TRUE(stage.until([&] { return title == "mine.toml - Palpate"; })) << title;
}

TEST(Leaving, WithoutChangesNothingIsAsked) {
  Stage stage;
  stage.key(window::key('Q'), kCtrl);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST(Leaving, WithChangesItAsksAndEachAnswerDoesWhatItSays) {
  for (const std::string answer : {"Save", "Discard", "Stay"}) {
    Stage stage;
    const fs::path file = openByHand(stage);
    changeGrip(stage, 0.75);
    stage.key(window::key('Q'), kCtrl);
    ASSERT_TRUE(stage.state().question);
    EXPECT_FALSE(stage.viewer->wantsToQuit());
    stage.key(window::key('W'));
    EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe)) << "nothing else is heard";
    stage.click("question/" + answer);
    EXPECT_FALSE(stage.state().question);
    EXPECT_EQ(stage.viewer->wantsToQuit(), answer != "Stay") << answer;
    EXPECT_EQ(scene::load(file).contact.finger.mu_static, answer == "Save" ? 0.75 : 0.5) << answer;
  }
}

TEST(Leaving, EnterSavesAndEscStays) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  stage.key(window::key('Q'), kCtrl);
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.viewer->wantsToQuit());
  stage.key(window::key('Q'), kCtrl);
  stage.key(window::Key::enter);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
  EXPECT_EQ(scene::load(file).contact.finger.mu_static, 0.75);
}

TEST(Leaving, OpeningSomethingElseAsksTooAndASaveThatFailsStays) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.drop(stage.folder / "ball.ply");
  stage.frame();
  ASSERT_TRUE(stage.state().question);
  stage.state().document.file = stage.folder / "ball.ply" / "no_folder.toml";
  stage.state().document.text.clear();
  stage.click("question/Save");
  for (int i = 0; i < 5; ++i) stage.frame();
  EXPECT_FALSE(stage.state().opening) << "what could not be saved is still there";
  EXPECT_EQ(stage.state().scene.contact.finger.mu_static, 0.75);
  stage.drop(stage.folder / "ball.ply");
  stage.frame();
  stage.click("question/Discard");
  EXPECT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; }));
  EXPECT_EQ(textOf(file), kByHand);
}

TEST(Undo, TakesBackWhateverControlOneStepADrag) {
  Stage stage;
  const double grip = stage.state().scene.contact.finger.mu_static;
  stage.frame();
  const auto [left, top, right, below] = widgetPlaces().at("friction/static");
  const double y = 0.5 * (top + below);
  stage.move(Vec2(left + 10, y));
  stage.button(true);
  for (const double x : {20.0, 35.0, 50.0, 60.0}) stage.move(Vec2(left + x, y));
  stage.button(false);
  stage.frame();
  EXPECT_NE(stage.state().scene.contact.finger.mu_static, grip);
  stage.key(window::key('W'));
  stage.key(window::key('Z'), kCtrl);
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe));
  EXPECT_EQ(stage.lastMessage(), "Undo: view show from the default to [\"wireframe\"]");
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(stage.state().scene.contact.finger.mu_static, grip) << stage.lastMessage();
  EXPECT_TRUE(stage.lastMessage().starts_with("Undo: friction ")) << stage.lastMessage();
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(stage.lastMessage(), "Nothing to undo");
  stage.key(window::key('Z'), kCtrlShift);
  EXPECT_NE(stage.state().scene.contact.finger.mu_static, grip);
}

TEST(Undo, OfASliderThatIsNotOfTheScene) {
  Stage stage;
  stage.frame();
  const double depth = stage.state().state.touch.depth_mm;
  stage.click("touch/depth");
  const double clicked = stage.state().state.touch.depth_mm;
  ASSERT_NE(clicked, depth);
  EXPECT_FALSE(stage.state().history.changed()) << "no scene says how deep the mouse presses";
  stage.move(stage.middle());
  stage.button(true);
  stage.scroll(-4.0);
  stage.button(false);
  EXPECT_EQ(stage.state().state.touch.depth_mm, clicked + 2.0) << "touching is no step";
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(stage.state().state.touch.depth_mm, depth);
  EXPECT_EQ(stage.lastMessage(), "Undo: depth mm");
}

TEST(Undo, BringsTheWorldBackToo) {
  Stage stage;
  stage.state().scene.stiffness.constant_n_per_mm = 1.25;
  stage.state().output.changed |= kMapChange;
  stage.frame();
  const auto stiffness = [&] { return stage.state().world.stiffest_n_per_mm; };
  ASSERT_TRUE(stage.until([&] { return stiffness() > 1.2; }));
  stage.key(window::key('Z'), kCtrl);
  EXPECT_TRUE(stage.until([&] { return stiffness() < 0.6; }));
}

TEST(Undo, ResetPutsEverythingBackAndCanBeTakenBackItself) {
  Stage stage;
  const fs::path file = openByHand(stage);
  changeGrip(stage, 0.75);
  stage.key(window::key('W'));
  stage.key(window::functionKey(6));
  EXPECT_EQ(stage.state().scene.contact.finger.mu_static, 0.5);
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe));
  EXPECT_FALSE(stage.state().history.changed());
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(stage.state().scene.contact.finger.mu_static, 0.75);
}

TEST(Reload, ReadsTheFileAgain) {
  Stage stage;
  const fs::path file = openByHand(stage);
  std::string text = kByHand;
  text.replace(text.find("0.5 "), 3, "0.9");
  writeFile(file, text);
  stage.key(window::functionKey(5));
  EXPECT_TRUE(stage.until([&] { return stage.state().scene.contact.finger.mu_static == 0.9; }));
}

}  // namespace
}  // namespace palpate::viewer
