#include "view/viewer/state/state_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

Remembered unusual() {
  Remembered r;
  r.window.x = 40;
  r.window.width = 1111;
  r.state.shown.panel = false;
  r.state.theme = window::Theme::light;
  r.state.language = "es";
  r.state.touch.by = device::PressBy::force;
  r.state.touch.force_n = 4.25;
  r.state.input.preset = window::MousePreset::cad;
  r.state.stereo.mode = view::StereoMode::anaglyph_dubois;
  r.state.recent = {"/a b/\"c\".obj", "/d.toml"};
  return r;
}

TEST(StateFile, RemembersWhatWasWritten) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "config" / "palpate" / "window.toml";
  ASSERT_TRUE(writeState(file, unusual()));
  const StateReading reading = readState(file);
  ASSERT_TRUE(reading.remembered);
  EXPECT_TRUE(reading.note.empty());
  EXPECT_EQ(stateAsToml(*reading.remembered), stateAsToml(unusual()));
  EXPECT_EQ(reading.remembered->state.recent.at(0), "/a b/\"c\".obj");
}

TEST(StateFile, IsNothingOnTheFirstRun) {
  const support::TemporaryFolder folder;
  const StateReading reading = readState(folder / "window.toml");
  EXPECT_FALSE(reading.remembered);
  EXPECT_TRUE(reading.note.empty());
}

TEST(StateFile, ABadOneIsPutAsideAndTold) {
  for (const char* text : {"version = ", "version = 99\n", "\x01\x02", ""}) {
    const support::TemporaryFolder folder;
    writeFile(folder / "window.toml", text);
    const StateReading reading = readState(folder / "window.toml");
    EXPECT_FALSE(reading.remembered);
    EXPECT_NE(reading.note.find("put aside"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "window.toml.bad"));
    EXPECT_FALSE(fs::exists(folder / "window.toml"));
  }
}

TEST(StateFile, ValuesThatMakeNoSenseAreLeftAtTheirDefaults) {
  const Remembered r = parseState(
      "version = 1\ntheme = 77\nstereo_mode = -1\ndepth_mm = nan\ntext_size = 900.0\nwindow_width = 3\n"
      "panel = \"yes\"\nrecent = [1, \"/x\"]\nunknown = 5\n",
      "s");
  EXPECT_EQ(r.state.theme, window::Theme::dark);
  EXPECT_EQ(r.state.stereo.mode, view::StereoMode::mono);
  EXPECT_EQ(r.state.touch.depth_mm, 6.0);
  EXPECT_EQ(r.state.text_size, 2.5);
  EXPECT_EQ(r.window.width, 320);
  EXPECT_TRUE(r.state.shown.panel);
  EXPECT_EQ(r.state.recent, std::vector<std::string>{"/x"});
}

TEST(StateFile, AFolderThatCannotBeWrittenDoesNoHarm) {
  EXPECT_FALSE(writeState("/proc/no/such/window.toml", {}));
  EXPECT_FALSE(writeState("", {}));
}

TEST(RecentFiles, NewestFirstEachOnceAndNotTooMany) {
  std::vector<std::string> recent;
  for (int i = 0; i < 20; ++i) remember(recent, "/f" + std::to_string(i));
  remember(recent, "/f15");
  EXPECT_EQ(recent.size(), kRecentFiles);
  EXPECT_EQ(recent[0], "/f15");
  EXPECT_EQ(recent[1], "/f19");
}

}  // namespace
}  // namespace palpate::viewer
