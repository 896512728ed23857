// Distances, the scene's own fingers, the speed of time, pictures without background, scenes for the clipboard.
#include "stage.h"

#include "palpate/base/text.h"
#include "palpate/view/image.h"
#include "view/viewer/files/recorded_touch.h"
#include "view/viewer/state/home_view.h"
#include "view/viewer/state/ruler.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

constexpr window::Modifiers kCtrlHeld{true, false};

void clickOnSkin(Stage& stage, const Vec2& at) {
  stage.move(at);
  stage.button(true);
  stage.button(false);
}

TEST(Measuring, TwoClicksGiveADistanceAndTouchNothing) {
  Stage stage;
  stage.key(window::key('D'));
  clickOnSkin(stage, stage.middle());
  clickOnSkin(stage, stage.middle() + Vec2(100, 40));
  const Ruler& ruler = stage.state().ruler;
  ASSERT_EQ(ruler.ends.size(), 2u);
  EXPECT_NEAR(straightMm(ruler), (ruler.ends[0].point - ruler.ends[1].point).norm(), 1e-12);
  EXPECT_GE(alongSkinMm(ruler), straightMm(ruler));
  EXPECT_LT(alongSkinMm(ruler), 1.2 * straightMm(ruler));
  EXPECT_FALSE(stage.viewer->pointer().pressed(0));
  clickOnSkin(stage, stage.middle());
  EXPECT_EQ(ruler.ends.size(), 1u) << "a third click begins again";
  stage.key(window::Key::escape);
  EXPECT_FALSE(ruler.active);
  for (int i = 0; i < 30; ++i) stage.frame();  // two clicks at one place would be a double click
  stage.move(stage.middle());
  stage.button(true);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; })) << "and the button presses again";
}

TEST(Measuring, AlongAHalfOfABallIsAsLongAsItsArc) {
  const support::TemporaryFolder folder;
  scene::Scene scene = sheetScene(folder);
  mesh::save(folder / "ball.ply", zoo::sphere(60.0, 5));
  scene.body.file = folder / "ball.ply";
  const auto world = scene::build(scene);
  const auto at = [&](double degrees) {
    const double angle = degrees * kRadPerDeg;
    return *view::skinNear(world->surface, 60.0 * Vec3(std::sin(angle), 0.0, std::cos(angle)), 5.0);
  };
  Ruler ruler;
  measureAt(at(-40), world->surface, ruler);
  measureAt(at(40), world->surface, ruler);
  EXPECT_NEAR(straightMm(ruler), 120.0 * std::sin(40.0 * kRadPerDeg), 0.2);
  EXPECT_NEAR(alongSkinMm(ruler), 60.0 * 80.0 * kRadPerDeg, 0.02 * 84.0);
}

/// A stage whose scene has a finger of its own: down for half a second, held, up.
void openScripted(Stage& stage) {
  const fs::path file = stage.folder / "scripted.toml";
  writeFile(file,
            "[body]\nkind = \"mesh\"\nfile = \"sheet.ply\"\n[[finger]]\nname = \"one\"\nradius_mm = 8\nat_mm = [5, 5]\n"
            "script = [{ do = \"press\", depth_mm = 6, seconds = 0.5 }, { do = \"hold\", seconds = 0.2 },\n"
            "  { do = \"lift\", seconds = 0.3 }]\n");
  stage.drop(file);
  ASSERT_TRUE(stage.until([&] { return stage.state().document.file == file && !stage.state().opening; }));
}

TEST(Playback, FeelsWhatTheScenesFingersDoAndGoesBackToTheMouse) {
  Stage stage;
  openScripted(stage);
  stage.key(window::functionKey(7));
  ASSERT_TRUE(stage.until([&] { return stage.state().replay.playing; })) << stage.lastMessage();
  double deepest = 0.0;
  ASSERT_TRUE(stage.until([&] {
    deepest = std::max(deepest, stage.finger().depth_mm);
    return !stage.state().replay.playing;
  }));
  EXPECT_NEAR(deepest, 6.0, 0.3);
  EXPECT_TRUE(stage.state().finger_present[0]);
  EXPECT_FALSE(stage.state().finger_present[1]) << "there is one only";
  stage.key(window::functionKey(7));
  stage.frame();
  EXPECT_FALSE(stage.state().replay.frozen);
}

TEST(Playback, PassesSlowerAndFaster) {
  Stage stage;
  openScripted(stage);
  for (int i = 0; i < 9; ++i) stage.key(window::functionKey(8));
  EXPECT_DOUBLE_EQ(stage.state().time_speed, 0.1);
  stage.key(window::functionKey(7));
  const Replay& replay = stage.state().replay;
  ASSERT_TRUE(stage.until([&] { return replay.playing; }));
  const double from = replay.at_s;
  for (int i = 0; i < 30; ++i) stage.frame();
  EXPECT_NEAR(replay.at_s - from, 0.05, 1e-6) << "half a second at a tenth of its speed";
  for (int i = 0; i < 9; ++i) stage.key(window::functionKey(9));
  EXPECT_DOUBLE_EQ(stage.state().time_speed, 10.0);
}

TEST(Playback, WithoutFingersItSaysSo) {
  Stage stage;
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.drop(stage.folder / "ball.ply");
  ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply" && !stage.state().opening; }));
  stage.key(window::functionKey(7));
  EXPECT_NE(stage.lastMessage().find("no fingers of its own"), std::string::npos) << stage.lastMessage();
}

TEST(CutOut, FindsColourAndOpacityAgain) {
  view::Image white(3, 1, {255, 255, 255});
  view::Image black(3, 1, {0, 0, 0});
  white.at(1, 0) = black.at(1, 0) = {200, 100, 50};
  black.at(2, 0) = {100, 50, 25};  // the same colour, half there
  white.at(2, 0) = {228, 178, 153};
  const view::CutOut cut = view::cutOut(white, black);
  EXPECT_EQ(cut.opacity, (std::vector<std::uint8_t>{0, 255, 127}));
  EXPECT_EQ(cut.image.at(1, 0), (view::Pixel{200, 100, 50}));
  EXPECT_NEAR(cut.image.at(2, 0)[0], 200, 2);
}

TEST(CutOut, OfTheWindowHasNothingRoundTheBody) {
  Stage stage;
  stage.draws = true;
  stage.key(window::functionKey(12), kCtrlHeld);
  stage.frame();
  const fs::path file = stage.folder / "palpate.png";
  ASSERT_TRUE(fs::exists(file)) << stage.lastMessage();
  EXPECT_EQ(stage.lastMessage(), "The picture without background is saved as " + file.string());
  const std::string bytes = readFile(file, 1 << 26);
  EXPECT_EQ(bytes[25], 6) << "PNG colour type: red, green, blue and opacity";
  const view::Image read = view::decodeImage(bytes);
  EXPECT_EQ(read.at(5, 5), (view::Pixel{0, 0, 0})) << "nothing there, not even a panel";
  EXPECT_GT(read.at(790, 350)[0], 60) << "the sheet";
}

TEST(Clipboard, GetsASceneThatReadsBackAsWhatIsSeen) {
  std::string clipboard;
  ViewerHost host;
  host.set_clipboard = [&](const std::string& text) { clipboard = text; };
  Stage stage(Stage::quiet(), host);
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.9; }));
  stage.state().scene.contact.finger.mu_static = 0.75;
  stage.key(window::key('W'));
  stage.key(window::key('C'), kCtrlHeld);
  const scene::Scene scene = scene::parse(clipboard, "snippet.toml");
  EXPECT_EQ(scene.contact.finger.mu_static, 0.75);
  ASSERT_EQ(scene.fingers.size(), 1u) << clipboard;
  EXPECT_NEAR(scene.fingers[0].steps.at(0).depth_mm, stage.finger().depth_mm, 0.05);
  EXPECT_EQ(scene.view.show, std::vector{view::Overlay::wireframe});
  const ViewerState& viewer = stage.state();
  const view::Camera said = cameraOfFreePart(viewer.camera, viewer.state.shown, viewer.size_points);
  EXPECT_NEAR(scene.view.distance_mm, said.distance_mm, 0.06) << "as what the panels leave free shows it";
  EXPECT_TRUE(clipboard.starts_with("# sheet.ply\n# left: ")) << clipboard;
}

}  // namespace
}  // namespace palpate::viewer
