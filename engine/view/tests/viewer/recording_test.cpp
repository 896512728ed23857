// What is recorded in the window: only fingers that are somewhere, and nothing lost when the disk is full or gone.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "palpate/trace/forces_table.h"
#include "stage.h"
#include "view/viewer/files/recorded_touch.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

/// While it lives no file may be longer; the write fails as on a full disk.
class NoLongerThan {
 public:
  explicit NoLongerThan(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~NoLongerThan() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  NoLongerThan(const NoLongerThan&) = delete;
  NoLongerThan& operator=(const NoLongerThan&) = delete;

 private:
  void (*signal_)(int);
  rlimit before_ = {};
};

void pressWhileRecording(Stage& stage) {
  stage.key(window::key('R'));
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  EXPECT_TRUE(stage.state().recording.forces);
}

bool saidThatItEnded(Stage& stage) { return stage.lastMessage().starts_with("The recording ended: "); }

TEST(Recording, OnAFullDiskEndsWithAMessageAndKeepsItsRows) {
  Stage stage;
  pressWhileRecording(stage);
  {
    const NoLongerThan limit(100'000);
    ASSERT_TRUE(stage.until([&] { return !stage.state().recording.forces; }));
  }
  const fs::path part = stage.folder / "forces.csv.partial";
  EXPECT_EQ(stage.lastMessage(), "The recording ended: " + (stage.folder / "forces.csv").string() +
                                     ": cannot be written: File too large; what was written is kept in " +
                                     part.string());
  EXPECT_FALSE(fs::exists(stage.folder / "forces.csv"));
  const auto fingers = trace::readForcesTable(part);
  EXPECT_GT(fingers[0].time_s.size(), 100u) << "all whole rows can be read";
  EXPECT_GT(stage.finger().depth_mm, 5.0) << "the touch went on";

  stage.key(window::key('R'));
  ASSERT_TRUE(stage.state().recording.forces);
  stage.key(window::key('R'));
  EXPECT_EQ(stage.state().recording.forces_file, (stage.folder / "forces-2.csv").string());
  EXPECT_EQ(trace::readForcesTable(part)[0].time_s.size(), fingers[0].time_s.size()) << "and are not overwritten";

  stage.drop(part);
  ASSERT_TRUE(stage.until([&] { return !stage.state().replay.table.empty(); })) << stage.lastMessage();
  EXPECT_TRUE(stage.lastMessage().starts_with(part.string() + " was interrupted")) << stage.lastMessage();
}

TEST(Recording, IntoAFolderThatVanishesEndsWithAMessage) {
  Stage stage;
  pressWhileRecording(stage);
  fs::remove_all(stage.folder.path());
  ASSERT_TRUE(stage.until([&] { return !stage.state().recording.forces; }));
  EXPECT_TRUE(saidThatItEnded(stage)) << stage.lastMessage();
  EXPECT_NE(stage.lastMessage().find("nothing of it could be saved"), std::string::npos) << stage.lastMessage();
  EXPECT_GT(stage.finger().depth_mm, 5.0) << "the touch went on";
}

TEST(Recording, LeavesOutAFingerThatIsNowhere) {
  Stage stage;
  pressWhileRecording(stage);
  stage.button(false);
  stage.key(window::key('R'));
  const auto fingers = trace::readForcesTable(stage.state().recording.forces_file);
  ASSERT_EQ(fingers.size(), 1u);
  EXPECT_EQ(fingers[0].name, "left");
  for (const Vec3& tip : fingers[0].tip) ASSERT_LT(tip.z(), 1000.0);
}

TEST(Recording, FingersThatCameAtDifferentTimesAreFeltOnOneClock) {
  const support::TemporaryFolder folder;
  const std::string rest = ",0,0,0,0,0,0,0,0,0,0,free,-1,0,0,0,0,0\n";
  std::ofstream(folder / "two.csv") << trace::forcesCsvHeader() << "\n0.002,right,1,0,9" << rest << "0.003,left,2,0,9"
                                    << rest << "0.003,right,3,0,9" << rest;
  const auto scene = sheetScene(folder);
  const RecordedTouch touch = touchedAgain(scene::build(scene), scene, folder / "two.csv");
  const auto& first = touch.history.at(0.002);
  EXPECT_EQ(first[1].contact.tip.x(), 1.0) << "the right finger in its own place";
  EXPECT_EQ(first[0].contact.tip.z(), device::kNowhere.z()) << "the left one was not there yet";
  EXPECT_EQ(touch.history.at(0.003)[0].contact.tip.x(), 2.0);
  EXPECT_EQ(touch.history.at(0.003)[1].contact.tip.x(), 3.0);
}

}  // namespace
}  // namespace palpate::viewer
