// The viewer as a user meets it, without a window: events in, pictures and numbers out.
#include "stage.h"

#include "palpate/base/text.h"
#include "pictures/read_png.h"
#include "view/viewer/panels/panels.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

TEST(Viewer, PressesWhereTheMouseIsHeldAndLiftsWhenItIsLetGo) {
  Stage stage;
  stage.move(stage.middle());
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  EXPECT_GT(stage.finger().force.norm(), 1.0);
  stage.button(false);
  EXPECT_TRUE(stage.until([&] { return stage.finger().touch == contact::Touch::free; }));
}

TEST(Viewer, NamesTheTissueOfTheBodyAndWhyItHasNoLayers) {
  const support::TemporaryFolder folder;
  const view::OffscreenContext context;
  const auto shown = [&](const std::string& fidelity) {
    const auto world = scene::build(scene::parse(
        fidelity + "[body]\nkind = \"back\"\n[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n", "s.toml"));
    ViewerSettings settings;
    settings.intro = false;
    settings.output_folder = folder.path();
    settings.default_scene = sheetScene(folder);
    return Viewer(world, Stage::quiet(), std::move(settings)).state().world;
  };
  const WorldFacts layered = shown("");
  EXPECT_EQ(layered.tissue, "layered tissue, force by its layers");
  EXPECT_TRUE(layered.notes.empty());
  const WorldFacts printed = shown("fidelity.E15 = \"literal\"\n");
  EXPECT_EQ(printed.tissue, "half-Gaussian tissue, force F = k d");
  ASSERT_EQ(printed.notes.size(), 1u);
  EXPECT_TRUE(printed.notes[0].starts_with("no layers because of fidelity.E15 = \"literal\"")) << printed.notes[0];
}

TEST(Viewer, TheWheelDeepensWhilePressingAndZoomsOtherwise) {
  Stage stage;
  const double distance = stage.state().camera.distance_mm;
  stage.move(stage.middle());
  stage.scroll(1.0);
  EXPECT_NEAR(stage.state().camera.distance_mm, 0.9 * distance, 1e-6);
  stage.button(true);
  stage.scroll(-4.0);
  EXPECT_DOUBLE_EQ(stage.state().state.touch.depth_mm, 8.0);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 7.0; }));
}

TEST(Viewer, DraggingPullsTheSkin) {
  Stage stage;
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  const Vec3 anchor = stage.finger().anchor;
  stage.move(stage.middle() + Vec2(30, 0));
  EXPECT_TRUE(stage.until([&] { return (stage.finger().proxy - anchor).norm() > 2.0; }));
}

TEST(Viewer, LosingTheFocusLiftsTheFingerAlsoAHeldOne) {
  Stage stage;
  stage.move(stage.middle());
  stage.key(window::Key::enter);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 1.0; }));
  stage.loseFocus();
  EXPECT_TRUE(stage.until([&] { return stage.finger().touch == contact::Touch::free; }));
}

TEST(Viewer, TheSecondFingerPressesWhileTheFirstStays) {
  Stage stage;
  stage.move(stage.middle());
  stage.key(window::Key::enter);
  ASSERT_TRUE(stage.until([&] { return stage.finger(0).depth_mm > 5.0; }));
  stage.key(window::key('2'));
  stage.move(stage.middle() + Vec2(120, 0));
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger(1).depth_mm > 5.0; }));
  EXPECT_GT(stage.finger(0).depth_mm, 5.0);
}

TEST(Viewer, DragsBesideTheBodyTurnTheCamera) {
  Stage stage;
  stage.move(Vec2(320, 60));  // between the panel and the sheet
  stage.button(true);
  stage.move(Vec2(420, 60));
  stage.button(false);
  EXPECT_NE(stage.state().camera.yaw_rad, 0.0);
  EXPECT_EQ(stage.finger().touch, contact::Touch::free);
}

TEST(Viewer, KeysSwitchOverlaysAndColours) {
  Stage stage;
  stage.key(window::key('W'));
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe));
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe));
  stage.key(window::key('S'));
  EXPECT_EQ(stage.state().state.look.colouring, view::Colouring::strain);
  stage.key(window::key('M'));
  EXPECT_EQ(stage.state().state.look.colouring, view::Colouring::stiffness);
  stage.key(window::key('M'));
  EXPECT_EQ(stage.state().state.look.colouring, view::Colouring::plain);
}

TEST(Viewer, AFileThatCannotBeReadBecomesAMessageAndLeavesEverythingAsItWas) {
  Stage stage;
  writeFile(stage.folder / "broken.obj", "v 1 2\nthis is not a mesh\n");
  const std::size_t triangles = stage.state().world.triangles;
  stage.drop(stage.folder / "broken.obj");
  ASSERT_TRUE(stage.until([&] { return stage.state().messages.toast(stage.now_s) != nullptr; }));
  EXPECT_EQ(stage.state().messages.toast(1e9)->severity, Severity::error);
  EXPECT_TRUE(stage.lastMessage().starts_with("cannot open ")) << stage.lastMessage();
  EXPECT_NE(stage.lastMessage().find("broken.obj"), std::string::npos);
  EXPECT_EQ(stage.state().world.triangles, triangles);
}

TEST(Viewer, ADroppedMeshTakesThePlaceOfTheBodyAndClearsTheErrorBefore) {
  Stage stage;
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.drop(stage.folder / "nothing.obj");
  ASSERT_TRUE(stage.until([&] { return stage.state().messages.toast(stage.now_s) != nullptr; }));
  stage.drop(stage.folder / "ball.ply");
  ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; }));
  EXPECT_EQ(stage.state().messages.toast(stage.now_s), nullptr);
  EXPECT_EQ(stage.state().state.recent.front(), (stage.folder / "ball.ply").string());
  stage.move(stage.middle());
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; })) << "and is felt";
}

TEST(Viewer, ADysfunctionIsPlacedFeltUndoneAndRedone) {
  Stage stage;
  stage.click("panel/Dysfunctions");
  stage.click("dysfunctions/edit");
  ASSERT_TRUE(stage.state().editor.active);
  stage.move(stage.middle());
  stage.button(true);
  stage.button(false);
  ASSERT_EQ(stage.state().scene.dysfunctions.size(), 1u);
  const auto stiffest = [&] { return stage.state().world.stiffest_n_per_mm; };
  EXPECT_TRUE(stage.until([&] { return stiffest() > 0.7; })) << stiffest();
  stage.key(window::key('Z'), {true, false});
  EXPECT_TRUE(stage.state().scene.dysfunctions.empty());
  EXPECT_TRUE(stage.until([&] { return stiffest() < 0.51; }));
  stage.key(window::key('Z'), {true, true});
  EXPECT_EQ(stage.state().scene.dysfunctions.size(), 1u);
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().editor.active);
}

TEST(Viewer, TurningTheWheelInTheEditorSizesWhatIsSelected) {
  Stage stage;
  stage.click("panel/Dysfunctions");
  stage.click("dysfunctions/edit");
  stage.move(stage.middle());
  stage.button(true);
  stage.button(false);
  const double radius = stage.state().scene.dysfunctions.at(0).radius_mm;
  stage.scroll(2.0);
  EXPECT_GT(stage.state().scene.dysfunctions.at(0).radius_mm, radius);
  stage.key(window::Key::delete_key);
  EXPECT_TRUE(stage.state().scene.dysfunctions.empty());
}

TEST(Viewer, AChangedSceneIsSavedAndReadsBack) {
  Stage stage;
  stage.state().scene.contact.finger.mu_static = 0.9;
  stage.key(window::key('S'), {true, false});
  const fs::path file = stage.state().document.file;
  ASSERT_TRUE(fs::exists(file)) << stage.lastMessage();
  EXPECT_EQ(scene::load(file).contact.finger.mu_static, 0.9);
}

TEST(Viewer, WhatIsRecordedIsCompleteEvenWhenTheViewerIsClosed) {
  Stage stage;
  stage.move(stage.middle());  // a finger that was nowhere has no rows
  stage.key(window::key('R'));
  ASSERT_TRUE(stage.state().recording.forces);
  ASSERT_TRUE(stage.until([&] { return stage.state().performance.servo.ticks >= 1000; }));
  const fs::path file = stage.state().recording.forces_file;
  EXPECT_FALSE(fs::exists(file)) << "a half-written table has no name yet";
  stage.viewer->finish();
  const std::string text = readFile(file, 1 << 26);
  EXPECT_TRUE(text.starts_with(trace::forcesCsvHeader()));
  EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 100);
}

TEST(Viewer, SavesPicturesAndSequences) {
  Stage stage;
  stage.draws = true;
  stage.key(window::functionKey(12));
  stage.frame();
  ASSERT_TRUE(fs::exists(stage.folder / "palpate.png"));
  const view::Image picture = support::readPng(stage.folder / "palpate.png");
  EXPECT_EQ(picture.width, kStageWidth);
  EXPECT_EQ(picture.height, kStageHeight);
  stage.state().request(ToggleSequence{});
  for (int i = 0; i < 5; ++i) stage.frame();
  stage.state().request(ToggleSequence{});
  stage.frame();
  stage.viewer->finish();
  EXPECT_TRUE(fs::exists(stage.folder / "pictures" / "frame_00003.png"));
}

/// Whether two pictures are the same within a place on the screen.
bool areSameIn(const view::Image& a, const view::Image& b, const std::array<float, 4>& place) {
  for (int y = static_cast<int>(place[1]); y < static_cast<int>(place[3]); ++y) {
    for (int x = static_cast<int>(place[0]); x < static_cast<int>(place[2]); ++x) {
      if (a.at(x, y) != b.at(x, y)) return false;
    }
  }
  return true;
}

TEST(Viewer, F12SavesNoPopUpsAndShiftF12SavesThem) {
  Stage stage;
  stage.draws = true;
  const view::Image before = stage.picture();
  stage.state().report(Severity::error, "a plate over the picture");
  stage.frame();
  stage.frame();
  const std::array<float, 4> toast = widgetPlaces().at("toast");
  const std::array<float, 4> panel = widgetPlaces().at("touch/depth");
  stage.key(window::functionKey(12));
  stage.key(window::functionKey(12), {false, true});
  const view::Image bare = support::readPng(stage.folder / "palpate.png");
  const view::Image whole = support::readPng(stage.folder / "palpate-2.png");
  EXPECT_TRUE(areSameIn(bare, before, toast));
  EXPECT_FALSE(areSameIn(whole, before, toast));
  EXPECT_TRUE(areSameIn(bare, before, panel)) << "panels are part of the picture";
  EXPECT_FALSE(areSameIn(stage.picture(), before, toast)) << "and the window goes on showing it";
}

TEST(Viewer, ARecordingHasARedDotATimeAndAMessage) {
  Stage stage;
  EXPECT_FALSE(widgetPlaces().contains("menu/recording"));
  stage.key(window::key('R'));
  EXPECT_TRUE(stage.lastMessage().starts_with("Recording forces to ")) << stage.lastMessage();
  stage.frame();
  const std::array<float, 4> words = widgetPlaces().at("menu/recording");
  const view::Image picture = stage.picture();
  int red = 0;
  for (int x = static_cast<int>(words[0]) - 30; x < static_cast<int>(words[0]); ++x) {
    const view::Pixel& pixel = picture.at(x, static_cast<int>(0.5f * (words[1] + words[3])));
    red += pixel[0] > 200 && pixel[1] < 90 && pixel[2] < 90 ? 1 : 0;
  }
  EXPECT_GE(red, 6);
  stage.key(window::key('R'));
  stage.frame();
  EXPECT_FALSE(widgetPlaces().contains("menu/recording"));
  Recording recording;
  EXPECT_EQ(recordingStatus(recording, 70.0), "");
  recording.forces = true;
  recording.since_s = 5.0;
  EXPECT_EQ(recordingStatus(recording, 70.9), "recording 1:05");
  recording.sequence = true;
  recording.pictures = 12;
  EXPECT_EQ(recordingStatus(recording, 70.9), "recording 1:05, 12 pictures");
}

TEST(Viewer, WordsStayWholeInASmallWindow) {
  ViewState state = Stage::quiet();
  state.hints = true;
  Stage stage(state);
  constexpr int kWidth = 500, kHeight = 400;
  const auto small_frames = [&] {
    for (int i = 0; i < 3; ++i) stage.viewer->frame(kWidth, kHeight, 1.0, stage.now_s += 1.0 / 60.0, {});
  };
  const auto expect_inside = [&](const char* path) {
    ASSERT_TRUE(widgetPlaces().contains(path)) << path;
    const auto [left, top, right, below] = widgetPlaces().at(path);
    EXPECT_TRUE(left >= 0.0f && top >= 0.0f && right <= kWidth && below <= kHeight) << path;
  };
  stage.state().state.shown.panel = false;
  stage.state().world.name = "a body with a rather long name, 20389 triangles";
  stage.state().report(Severity::warning, "words that need more than one line of a window as small as this one is");
  stage.key(window::key('R'));
  small_frames();
  for (const char* path : {"menu/status", "menu/recording", "hint", "toast"}) expect_inside(path);
  stage.key(window::Key::space);
  small_frames();
  expect_inside("replay");
}

TEST(Outputs, MakesItsFolderWhenItIsFirstNeeded) {
  const support::TemporaryFolder folder;
  ViewerState viewer;
  Outputs outputs(folder / "not" / "yet", viewer);
  outputs.savePlots(viewer.plots);
  EXPECT_TRUE(fs::exists(folder / "not" / "yet" / "plots.csv")) << viewer.messages.all().back().text;
}

TEST(Viewer, FreezesThePictureButNotTheTouch) {
  Stage stage;
  stage.key(window::Key::space);
  stage.move(stage.middle());
  stage.button(true);
  const std::uint64_t ticks = stage.state().performance.servo.ticks;
  ASSERT_TRUE(stage.until([&] { return stage.state().performance.servo.ticks > ticks + 1000; }));
  EXPECT_EQ(stage.finger().depth_mm, 0.0) << "what is shown stays as it was";
  stage.key(window::Key::space);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
}

/// Frames that come ten times a second.
void slowFrames(Stage& stage, int count, int width = 320, int height = 240) {
  for (int i = 0; i < count; ++i) stage.viewer->frame(width, height, 1.0, stage.now_s += 0.1, {});
}

TEST(Viewer, DrawsTheBodyWithFewerPixelsWhileAFingerTouchesAndPicturesAreSlow) {
  Stage stage;
  const double& share = stage.state().performance.picture_share;
  slowFrames(stage, 20, kStageWidth, kStageHeight);
  EXPECT_EQ(share, 1.0) << "at rest";
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  EXPECT_EQ(share, 1.0) << "pictures are quick";
  slowFrames(stage, 6, kStageWidth, kStageHeight);
  EXPECT_EQ(share, kMinPictureShare);
  const view::Image touched = stage.viewer->target().read();
  stage.button(false);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm == 0.0; }));
  EXPECT_TRUE(stage.until([&] { return share == 1.0; })) << "at rest again";
  EXPECT_EQ(touched.width, kStageWidth) << "panels and labels have all pixels";
}

TEST(Viewer, SavesPicturesWithAllPixelsAndLeavesThemAllWhereTheUserWantsIt) {
  Stage stage;
  const double& share = stage.state().performance.picture_share;
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  slowFrames(stage, 6, kStageWidth, kStageHeight);
  ASSERT_LT(share, 1.0);
  stage.state().request(TakeScreenshot{.with_pop_ups = true});
  slowFrames(stage, 1, kStageWidth, kStageHeight);
  EXPECT_EQ(share, 1.0) << "of the frame that was saved";
  slowFrames(stage, 1, kStageWidth, kStageHeight);
  EXPECT_LT(share, 1.0);
  stage.state().state.adapts_resolution = false;
  slowFrames(stage, 10, kStageWidth, kStageHeight);
  EXPECT_EQ(share, 1.0);
}

TEST(Viewer, DrawsTheSkinSmoothWhilePicturesAreSlowAndSaysSo) {
  ViewState state = Stage::quiet();
  state.look.shading = view::Shading::skin;
  state.adapts_resolution = false;  // pixels are given up before
  Stage stage(state);
  slowFrames(stage, 60);
  EXPECT_TRUE(stage.state().simple_shading);
  EXPECT_NE(stage.lastMessage().find("drawn smooth for now"), std::string::npos) << stage.lastMessage();
  EXPECT_EQ(stage.state().messages.toast(stage.now_s), nullptr) << "it does not lie over the body";
  EXPECT_EQ(stage.state().state.look.shading, view::Shading::skin) << "what is remembered is the user's choice";
}

TEST(Viewer, NeverDrawsSmootherThanTheUserChose) {
  ViewState state = Stage::quiet();
  state.look.shading = view::Shading::skin;
  state.simpler_when_slow = false;
  Stage stage(state);
  slowFrames(stage, 60);
  EXPECT_FALSE(stage.state().simple_shading);
  EXPECT_TRUE(stage.state().messages.all().empty());
}

TEST(Viewer, EscapeNeverQuits) {
  Stage stage;
  stage.key(window::functionKey(1));
  EXPECT_TRUE(stage.state().state.shown.help);
  for (int i = 0; i < 5; ++i) stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().state.shown.help);
  EXPECT_FALSE(stage.viewer->wantsToQuit());
  stage.key(window::key('Q'), {true, false});
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST(Viewer, CopiesItsViewAsTextAndPastesItBack) {
  std::string clipboard;
  ViewerHost host;
  host.set_clipboard = [&](const std::string& text) { clipboard = text; };
  host.clipboard = [&] { return clipboard; };
  Stage stage(Stage::quiet(), host);
  stage.state().camera.yaw_rad = 0.5;
  stage.state().request(CopyView{});
  stage.frame();
  EXPECT_TRUE(clipboard.starts_with("palpate-view ")) << clipboard;
  stage.state().camera.yaw_rad = -1.0;
  stage.state().request(PasteView{});
  stage.frame();
  stage.frame();
  EXPECT_NEAR(stage.state().camera.yaw_rad, 0.5, 1e-4);
  clipboard = "nonsense";
  stage.state().request(PasteView{});
  stage.frame();
  EXPECT_EQ(stage.lastMessage(), "The clipboard holds no view");
}

TEST(Viewer, PressedByForceAStiffPlaceGivesWayLess) {
  ViewState state = Stage::quiet();
  state.touch.by = device::PressBy::force;
  state.touch.force_n = 2.0;
  Stage stage(state);
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return std::abs(stage.finger().force.norm() - 2.0) < 0.05; }));
  EXPECT_NEAR(stage.finger().depth_mm, 4.0, 0.3) << "0.5 N/mm";
}

}  // namespace
}  // namespace palpate::viewer
