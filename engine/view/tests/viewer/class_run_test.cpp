// A class from the window, with a stand-in of palpate-class that notes what it was asked to do.
#include "view/viewer/class_run.h"

#include <fstream>

#include "stage.h"
#include "support/run_command.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

class ClassInTheWindow : public testing::Test {
 protected:
  /// Lines of shell; "$1 $2" say which command it is.
  void install(const std::string& lines) const {
    const fs::path program = folder_ / "palpate-class";
    std::ofstream(program) << "#!/bin/sh\necho \"$@\" >> '" << (folder_ / "said.txt").string() << "'\n"
                           << lines << '\n';
    fs::permissions(program, fs::perms::owner_all);
  }
  void installAClass() const {
    install("trap 'echo ended $1 $2 >> " + (folder_ / "said.txt").string() +
            "; exit 0' INT TERM\ncase \"$2\" in\ninit) mkdir -p \"$3/stations/s01\"; touch \"$3/class.toml\" "
            "\"$3/stations/s01/station.toml\"; exit 0;;\nserve) echo 'palpate: 2 stations, 0 rows' >&2;;\nesac\n"
            "while :; do sleep 0.05; done");
  }
  std::string said() const { return support::contentOf(folder_ / "said.txt"); }
  Stage stage() const {
    ViewerHost host;
    host.class_program = folder_ / "palpate-class";
    host.activities = [] {
      constexpr ActivityState kHere = {.kind = ActivityState::Kind::here};
      return Activities{kHere, kHere, kHere};
    };
    return Stage(Stage::quiet(), std::move(host));
  }
  std::string classFolder() const { return (folder_ / "osteo").string(); }

  support::TemporaryFolder folder_;
};

TEST_F(ClassInTheWindow, IsMadeStartedWatchedAndEndedInOrder) {
  installAClass();
  Stage stage = this->stage();
  EXPECT_TRUE(stage.state().class_shown.offered);
  stage.state().request(StartClass{classFolder(), "osteo-1", 2, "teacher"});
  ASSERT_TRUE(stage.until([&] { return stage.state().class_shown.watched; })) << stage.state().class_shown.trouble;
  EXPECT_TRUE(stage.state().class_shown.runs);
  EXPECT_EQ(stage.state().class_shown.words, "2 stations, 0 rows");
  EXPECT_NE(said().find("class init " + classFolder() + " --class osteo-1 --stations 2 --host teacher\n"),
            std::string::npos);
  EXPECT_NE(said().find("class serve " + classFolder() + " --broker --language en\n"), std::string::npos) << said();
  stage.state().request(JoinClass{classFolder() + "/stations/s01"});
  ASSERT_TRUE(stage.until([&] { return said().find("train --class") != std::string::npos; }));
  stage.state().request(Quit{});
  stage.frame();
  EXPECT_FALSE(stage.viewer->wantsToQuit());
  ASSERT_TRUE(stage.state().question) << "the class would end";
  stage.key(window::Key::escape);
  EXPECT_TRUE(stage.state().class_shown.runs);
  stage.state().request(Quit{});
  stage.frame();
  stage.key(window::Key::enter);
  stage.frame();
  EXPECT_TRUE(stage.viewer->wantsToQuit());
  EXPECT_NE(said().find("ended class serve"), std::string::npos) << said();
  EXPECT_NE(said().find("ended train --class"), std::string::npos) << said();
}

TEST_F(ClassInTheWindow, IsNotMadeAgainWhereThereIsOne) {
  installAClass();
  fs::create_directories(classFolder());
  std::ofstream(folder_ / "osteo/class.toml") << "";
  Stage stage = this->stage();
  stage.state().request(StartClass{classFolder(), "osteo-1", 2, "teacher"});
  ASSERT_TRUE(stage.until([&] { return stage.state().class_shown.watched; }));
  EXPECT_EQ(said().find("init"), std::string::npos);
}

TEST_F(ClassInTheWindow, SaysWhatTheCommandsSay) {
  install("echo 'palpate: mosquitto is not installed (Debian: apt install mosquitto)' >&2; exit 2");
  fs::create_directories(classFolder());
  std::ofstream(folder_ / "osteo/class.toml") << "";
  Stage stage = this->stage();
  stage.state().request(StartClass{classFolder(), "osteo-1", 2, "teacher"});
  ASSERT_TRUE(stage.until([&] { return !stage.state().class_shown.trouble.empty(); }));
  EXPECT_EQ(stage.state().class_shown.trouble,
            "The class ended (exit code 2): mosquitto is not installed (Debian: apt install mosquitto)");
  EXPECT_FALSE(stage.state().class_shown.runs);
}

TEST_F(ClassInTheWindow, RefusesFoldersThatAreNone) {
  installAClass();
  Stage stage = this->stage();
  stage.state().request(JoinClass{folder_.path().string()});
  stage.frame();
  EXPECT_NE(stage.state().class_shown.trouble.find("has no station.toml"), std::string::npos);
  stage.state().request(WatchClass{folder_.path().string()});
  stage.frame();
  EXPECT_NE(stage.state().class_shown.trouble.find("has no class.toml"), std::string::npos);
  EXPECT_FALSE(stage.state().class_shown.anything());
}

TEST_F(ClassInTheWindow, BeginsOnTheStartPage) {
  installAClass();
  Stage stage = this->stage();
  stage.state().state.shown.start = true;
  stage.frame();
  stage.click("start/class");
  stage.frame();
  EXPECT_TRUE(stage.state().state.shown.class_dialog);
  EXPECT_FALSE(stage.state().state.shown.start);
  stage.frame();
  stage.click("class/start");
  ASSERT_TRUE(stage.until([&] { return stage.state().class_shown.watched; })) << stage.state().class_shown.trouble;
  EXPECT_NE(said().find("class init "), std::string::npos);
  for (int i = 0; i < 5; ++i) stage.frame();  // the dialog takes its new size
  stage.click("class/end");
  stage.frame();
  EXPECT_FALSE(stage.state().class_shown.anything());
}

}  // namespace
}  // namespace palpate::viewer
