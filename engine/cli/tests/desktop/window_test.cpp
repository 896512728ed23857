// The window with real events: an X server, real buttons and keys, and what the program says a frame later.
#include <gtest/gtest.h>

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "desktop.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "pictures/read_png.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace palpate::desktop {
namespace {

namespace fs = std::filesystem;
using Values = std::map<std::string, std::string>;

double numberIn(const Values& values, const char* name) { return std::atof(values.at(name).c_str()); }

/// One X server for all of them; each its own program on a small sheet, which is built in no time.
class Window : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (whyNoDesktop().empty()) desktop = new Desktop();
  }
  static void TearDownTestSuite() {
    delete desktop;
    desktop = nullptr;
  }
  void SetUp() override {
    if (desktop == nullptr) GTEST_SKIP() << whyNoDesktop();
    mesh::save(folder / "sheet.ply", zoo::wavyGrid(40, 200.0, 3.0));
  }

  std::unique_ptr<Program> start(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), "sheet.ply");
    return std::make_unique<Program>(*desktop, folder.path(), arguments);
  }
  /// Plays events and quits by itself.
  std::unique_ptr<Program> play(const std::string& script, std::vector<std::string> arguments = {}) {
    writeFile(folder / "script.csv", script);
    arguments.insert(arguments.end(), {"--play", "script.csv"});
    return start(arguments);
  }

  const support::TemporaryFolder folder;
  static Desktop* desktop;
};
Desktop* Window::desktop = nullptr;

/// A place over the sheet, and one beside it.
constexpr const char* kOnSkin = "mousemove 790 380";
constexpr const char* kBeside = "mousemove 330 60";

/// What the mouse or the keyboard does over the sheet presses a finger into it.
bool isFelt(Program& program, const std::string& act) {
  return program.hand(std::string(kOnSkin) + " " + act) &&
         program.until([](const Values& v) { return numberIn(v, "depth") > 5.0; });
}

TEST_F(Window, ShowsAFrameAndQuitsWhenAskedTo) {
  const auto program = start({"--frames", "5"});
  const std::string said = program->rest();
  EXPECT_NE(said.find("frame 5 "), std::string::npos) << said;
  EXPECT_EQ(said.find("frame 6 "), std::string::npos);
  EXPECT_NE(said.find("servo: "), std::string::npos);
  EXPECT_EQ(program->exitCode(), 0) << program->errors();
}

TEST_F(Window, APressWithTheLeftButtonIsFeltAndEnds) {
  const auto program = start();
  ASSERT_TRUE(isFelt(*program, "mousedown 1"));
  EXPECT_GT(program->number("force"), 1.0);
  ASSERT_TRUE(program->hand("mouseup 1"));
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("pressed") == "0" && numberIn(v, "depth") == 0.0; }));
}

TEST_F(Window, ASceneWithoutFingersIsTouchedAllTheSame) {
  writeFile(folder / "alone.toml", "[body]\nkind = \"mesh\"\nfile = \"sheet.ply\"\n");
  Program program(*desktop, folder.path(), {"alone.toml"});
  EXPECT_TRUE(isFelt(program, "mousedown 1"));
}

TEST_F(Window, MovingWhilePressingPullsTheSkin) {
  const auto program = start();
  ASSERT_TRUE(isFelt(*program, "mousedown 1"));
  ASSERT_TRUE(program->hand("mousemove_relative -- 25 0"));
  EXPECT_TRUE(program->until([](const Values& v) { return numberIn(v, "drag") > 1.0; }));
  program->hand("mouseup 1");
}

TEST_F(Window, TheWheelZoomsAndWhilePressingDeepens) {
  const auto program = start();
  const double distance = program->number("distance");
  ASSERT_TRUE(program->hand(std::string(kOnSkin) + " click 4"));
  EXPECT_TRUE(program->until([&](const Values& v) { return numberIn(v, "distance") < distance - 1.0; }));
  ASSERT_TRUE(program->hand("mousedown 1 click 5 click 5"));
  EXPECT_TRUE(program->until([](const Values& v) { return numberIn(v, "set_depth") == 7.0; }));
  program->hand("mouseup 1");
}

TEST_F(Window, TheRightButtonTurns) {
  const auto program = start();
  ASSERT_TRUE(program->hand(std::string(kOnSkin) + " mousedown 3 mousemove_relative 60 0 mouseup 3"));
  EXPECT_TRUE(program->until([](const Values& v) { return std::abs(numberIn(v, "yaw")) > 0.1; }));
  EXPECT_EQ(program->word("pressed"), "0");
}

TEST_F(Window, ADragBesideTheBodyTurnsToo) {
  const auto program = start();
  ASSERT_TRUE(program->hand(std::string(kBeside) + " mousedown 1 mousemove_relative 60 0 mouseup 1"));
  EXPECT_TRUE(program->until([](const Values& v) { return std::abs(numberIn(v, "yaw")) > 0.1; }));
}

TEST_F(Window, KeysSwitch) {
  const auto program = start();
  const std::string before = program->word("overlays");
  ASSERT_TRUE(program->hand("key w"));
  EXPECT_TRUE(program->until([&](const Values& v) { return v.at("overlays") != before; }));
  ASSERT_TRUE(program->hand("key Tab"));
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("panel") == "0"; }));
}

TEST_F(Window, EnterHoldsTheFingerUntilTheFocusIsLost) {
  const auto program = start();
  ASSERT_TRUE(isFelt(*program, "key Return"));
  // To another window: the X server's own.
  ASSERT_TRUE(program->hand("search --maxdepth 0 '' windowfocus"));
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("pressed") == "0"; }));
}

TEST_F(Window, IsResizedWhileItPresses) {
  const auto program = start();
  ASSERT_TRUE(isFelt(*program, "mousedown 1"));
  for (const char* size : {"900 700", "1100 640", "1000 720"}) {
    ASSERT_TRUE(program->hand(std::string("search --onlyvisible --name Palpate windowsize ") + size));
  }
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("size") == "1000x720"; }));
  EXPECT_GT(program->number("depth"), 5.0);
  program->hand("mouseup 1");
}

TEST_F(Window, FillsTheScreenAndComesBack) {
  const auto program = start();
  const std::string before = program->word("size");
  ASSERT_TRUE(program->hand("key F11"));
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("size") == "1400x900"; }));
  ASSERT_TRUE(program->hand("key F11"));
  EXPECT_TRUE(program->until([&](const Values& v) { return v.at("size") == before; }));
}

/// Between two ticks of a table of forces.
double longestPauseS(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);  // the header
  double longest = 0.0;
  for (double last = -1.0; std::getline(lines, line);) {
    const double time_s = std::atof(line.c_str());
    if (last >= 0.0) longest = std::max(longest, time_s - last);
    last = time_s;
  }
  return longest;
}

TEST_F(Window, TheServoGoesOnWhileTheScreenIsFilledAndLeft) {
  const auto program = start();
  const std::string before = program->word("size");
  ASSERT_TRUE(isFelt(*program, "mousedown 1"));
  ASSERT_TRUE(program->hand("key r"));
  ASSERT_TRUE(program->until([](const Values& v) { return v.at("recording") == "1"; }));
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(program->hand("key F11"));
    ASSERT_TRUE(program->until([](const Values& v) { return v.at("size") == "1400x900"; }));
    ASSERT_TRUE(program->hand("key F11"));
    ASSERT_TRUE(program->until([&](const Values& v) { return v.at("size") == before; }));
  }
  EXPECT_GT(program->number("depth"), 5.0) << "still pressed";
  ASSERT_TRUE(program->hand("mouseup 1 key r"));
  ASSERT_TRUE(program->until([](const Values& v) { return v.at("recording") == "0"; }));
  const std::string table = readFile(folder / "forces.csv", 1 << 28);
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 300);
  EXPECT_LT(longestPauseS(table), 0.2) << "a busy machine may make it pause for some hundredths";
}

TEST_F(Window, RowsForTheEyesAreThoseOfTheMonitor) {
  const auto program = start();
  for (const char* top : {"101", "40"}) {
    ASSERT_TRUE(program->hand(std::string("search --onlyvisible --name Palpate windowmove 20 ") + top));
    EXPECT_TRUE(program->until([&](const Values& v) { return v.at("row") == top; })) << program->word("row");
  }
}

TEST_F(Window, ADroppedFileThatIsBrokenIsToldAndNothingChanges) {
  writeFile(folder / "broken.stl", "solid nothing\nfacet");
  const auto program = play("0.1, drop, broken.stl\n");
  const double body = program->number("body");
  EXPECT_TRUE(program->until([](const Values& v) { return v.at("message").find("broken.stl") != std::string::npos; }));
  EXPECT_EQ(program->number("body"), body);
}

TEST_F(Window, ClosedWhileRecordingItLeavesACompleteTable) {
  const auto program = play("0.1, key, R\n1.5, close\n");
  program->rest();
  EXPECT_EQ(program->exitCode(), 0) << program->errors();
  const std::string table = readFile(folder / "forces.csv", 1 << 26);
  EXPECT_EQ(table.back(), '\n');
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 200);
}

TEST_F(Window, ItsButtonAsksWhileThereIsSomethingToSave) {
  // A look alone is worth no question, the slider of the skin's grip is.
  const auto program = play(
      "0.1, key, W\n0.1, move, 140, 334\n0.2, down, left\n0.3, up, left\n"
      "0.6, close\n1.4, key, Esc\n2.0, close\n2.8, key, Enter\n60, close\n");
  const auto asks = [](const Values& v) { return v.at("question") == "1"; };
  const auto goes_on = [](const Values& v) { return v.at("question") == "0" && v.at("changed") == "1"; };
  EXPECT_TRUE(program->until(asks));
  EXPECT_TRUE(program->until(goes_on)) << "Esc stays";
  EXPECT_TRUE(program->until(asks));
  program->rest();  // Enter saves, and then the window closes
  EXPECT_EQ(program->exitCode(), 0) << program->errors();
  EXPECT_NE(readFile(folder / "scene.toml", 1 << 16).find("wireframe"), std::string::npos);
}

TEST_F(Window, EndedByASignalItKeepsWhatNobodyCouldBeAskedAbout) {
  const auto program = play("0.1, key, W\n0.2, key, R\n60, close\n");
  ASSERT_TRUE(program->until([](const Values& v) { return v.at("changed") == "1" && v.at("recording") == "1"; }));
  program->send(SIGTERM);
  program->rest();
  EXPECT_EQ(program->exitCode(), 143) << program->errors();
  EXPECT_NE(program->errors().find("palpate: the changed scene is kept as "), std::string::npos) << program->errors();
  EXPECT_NE(readFile(folder / "scene-backup.toml", 1 << 16).find("wireframe"), std::string::npos);
  EXPECT_EQ(readFile(folder / "forces.csv", 1 << 28).back(), '\n') << "what was recorded is complete";
}

TEST_F(Window, EndedByASignalWithNothingChangedItLeavesNoBackup) {
  const auto program = start();
  program->send(SIGTERM);
  program->rest();
  EXPECT_EQ(program->exitCode(), 143);
  EXPECT_FALSE(fs::exists(folder / "scene-backup.toml"));
}

TEST_F(Window, SavesThePictureThatItShows) {
  const auto program = play("0.2, key, F12\n0.5, close\n");
  program->rest();
  const view::Image picture = support::readPng(folder / "palpate.png");
  EXPECT_EQ(std::to_string(picture.width) + "x" + std::to_string(picture.height), program->word("size"));
}

TEST_F(Window, RemembersItsSizeAndSurvivesABadMemory) {
  start({"--frames", "3", "--width", "900", "--height", "600"})->rest();
  const fs::path memory = folder / "config/palpate/window.toml";
  ASSERT_TRUE(fs::exists(memory));
  {
    const auto program = start({"--frames", "3"});
    program->rest();
    EXPECT_EQ(program->word("size"), "900x600");
  }
  writeFile(memory, "not = [toml");
  const auto program = start({"--frames", "3"});
  program->rest();
  EXPECT_EQ(program->exitCode(), 0);
  EXPECT_TRUE(fs::exists(memory.string() + ".bad"));
}

TEST_F(Window, RunsWithoutAPlaceToRemember) {
  writeFile(folder / "config", "a file where the folder should be");
  const auto program = start({"--frames", "3"});
  program->rest();
  EXPECT_EQ(program->exitCode(), 0) << program->errors();
}

TEST_F(Window, ShortcutsCanBeSwitchedOff) {
  const auto program = play("0.1, key, W\n0.2, key, Ctrl+Q\n0.4, close\n", {"--no-shortcuts"});
  program->rest();
  EXPECT_EQ(program->word("overlays").find('1'), std::string::npos);
}

TEST(WindowFailure, WithoutADisplayItSaysWhatToDo) {
  Child child({support::builtProgram(), "run"}, {}, {"DISPLAY", "WAYLAND_DISPLAY"});
  EXPECT_EQ(child.exitCode(), 2);
  EXPECT_EQ(child.errors(),
            "palpate: there is no display to open a window on; `palpate render` makes pictures and `palpate simulate` "
            "palpates without one\n");
}

TEST(WindowFailure, ADisplayThatIsNotThereIsTheSame) {
  Child child({support::builtProgram(), "run"}, {{"DISPLAY", ":4242"}}, {"WAYLAND_DISPLAY"});
  EXPECT_EQ(child.exitCode(), 2);
  EXPECT_NE(child.errors().find("there is no display"), std::string::npos) << child.errors();
}

TEST(WindowFailure, AHeadTrackerThatIsNotThereIsNamedBeforeTheWindowOpens) {
  const auto error_of = [](const char* tracker, const std::string& loader) {
    Child child({support::builtProgram(), "run", "--head-tracker", tracker}, {{"PALPATE_OPENXR_LOADER", loader}},
                {"DISPLAY", "WAYLAND_DISPLAY"});
    EXPECT_EQ(child.exitCode(), 2) << tracker;
    return child.errors();
  };
  EXPECT_EQ(error_of("openxt", ""), "palpate: head tracker: 'openxt' must be [ADDRESS:]PORT or openxr\n");
  EXPECT_NE(error_of("openxr", "/nowhere/loader.so").find("palpate: head tracker openxr: the OpenXR loader"),
            std::string::npos);
  const std::string with_double =
      error_of("openxr", (support::buildFolder() / "tests/doubles/openxr/libopenxr_loader.so").string());
  EXPECT_NE(with_double.find("there is no display"), std::string::npos) << with_double;
}

TEST_F(Window, AnOpenGlThatIsTooOldIsNamed) {
  auto environment = desktop->environment();
  environment["MESA_GL_VERSION_OVERRIDE"] = "2.1";
  Child child({support::builtProgram(), "run", "--no-state"}, environment, {"WAYLAND_DISPLAY"});
  EXPECT_EQ(child.exitCode(), 2);
  EXPECT_NE(child.errors().find("needs OpenGL 3.3 and found OpenGL 2.1"), std::string::npos) << child.errors();
  EXPECT_EQ(std::count(child.errors().begin(), child.errors().end(), '\n'), 1);
}

TEST_F(Window, AScriptThatMakesNoSenseIsRefusedBeforeTheWindowOpens) {
  writeFile(folder / "bad.csv", "0, wave\n");
  Child child({support::builtProgram(), "run", "--no-state", "--play", "bad.csv"}, desktop->environment(),
              {"WAYLAND_DISPLAY"}, folder.path());
  EXPECT_EQ(child.exitCode(), 2);
  EXPECT_EQ(child.errors(), "palpate: bad.csv:1: unknown event 'wave'\n");
}

}  // namespace
}  // namespace palpate::desktop
