// Recordings in the window: recorded by themselves, kept by one key, shown again with their marks, two of them beside
// each other.
#include <algorithm>
#include <chrono>
#include <fstream>

#include "palpate/engine/recording_replay.h"
#include "stage.h"
#include "view/viewer/files/recorded_touch.h"
#include "view/viewer/files/recording_keeper.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sessionsIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (trace::isRecording(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class SessionStage : public Stage {
 public:
  SessionStage() : Stage(quiet(), {}, true) {}
  fs::path sessions() const { return folder / "sessions"; }

  void press(const Vec2& at) {
    move(at);
    button(true);
    ASSERT_TRUE(until([&] { return finger().depth_mm > 5.0; }));
    button(false);
    ASSERT_TRUE(until([&] { return finger().touch == contact::Touch::free; }));
  }
  /// The file of what has been recorded so far.
  std::string saveRecording() {
    state().recording.kept_file.clear();
    key(window::key('R'), {false, true});
    EXPECT_TRUE(until([&] { return !state().recording.kept_file.empty(); })) << lastMessage();
    return state().recording.kept_file;
  }
  ::testing::AssertionResult shows(const std::string& file) {
    drop(file);
    if (until([&] { return state().replay.table == file; })) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << lastMessage();
  }
};

TEST(Sessions, WhatWasTouchedIsKeptByOneKeyProvenAndShownAgain) {
  SessionStage stage;
  stage.key(window::key('M'), {false, true});
  stage.press(stage.middle());
  stage.key(window::key('M'), {false, true});
  const std::string file = stage.saveRecording();
  EXPECT_TRUE(fs::path(file).filename().string().starts_with("session-"));
  {
    trace::RecordingReader viewer(file);
    const engine::ReplayReport report = engine::replay(viewer);
    EXPECT_TRUE(report.identical()) << (report.first_difference ? report.first_difference->field : "");
    EXPECT_GT(report.ticks, 100u);
    EXPECT_EQ(viewer.facts().fingers[0].device, "mouse");
  }
  ASSERT_TRUE(stage.shows(file));
  Replay& replay = stage.state().replay;
  EXPECT_TRUE(replay.frozen);
  ASSERT_EQ(replay.marks.size(), 2u);
  EXPECT_EQ(replay.marks[0].words, "mark 1");
  double deepest = 0.0;
  for (double t = replay.from_s; t <= replay.to_s; t += 0.01) {
    replay.at_s = t;
    stage.frame();
    deepest = std::max(deepest, stage.finger().depth_mm);
  }
  EXPECT_GT(deepest, 5.0);
  stage.click("replay/mark_back");
  EXPECT_NEAR(replay.at_s, replay.marks[1].at_s, 1e-6);
  stage.key(window::Key::space);
  EXPECT_TRUE(stage.until([&] { return stage.state().replay.table.empty(); })) << "back to the present";
}

TEST(Sessions, ARunWithoutATouchLeavesNothingAndOneWithLeavesAFinishedFile) {
  {
    SessionStage stage;
    ASSERT_TRUE(stage.until([&] { return stage.state().recording.length_s > 0.4; }));
    stage.viewer->finish();
    EXPECT_TRUE(sessionsIn(stage.sessions()).empty());
  }
  SessionStage stage;
  stage.press(stage.middle());
  stage.viewer->finish("SIGTERM");
  const auto files = sessionsIn(stage.sessions());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].extension(), ".session");
  EXPECT_EQ(trace::RecordingReader(files[0]).facts().ended_by, "SIGTERM");
}

TEST(Sessions, AWindowThatDiesLeavesWhatWasFelt) {
  SessionStage stage;
  stage.press(stage.middle());
  ASSERT_TRUE(stage.until([&] { return stage.state().recording.length_s > 0.5; }));
  stage.viewer.reset();  // as when drawing threw: nobody finishes anything
  const auto files = sessionsIn(stage.sessions());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].extension(), ".partial");
  trace::RecordingReader viewer(files[0]);
  EXPECT_GT(viewer.facts().seconds(), 0.3);
}

TEST(Sessions, WhatAKilledRunLeftIsFinishedByTheNextAndOnlySoManyRunsAreKept) {
  const support::TemporaryFolder folder;
  const auto record = [&](const std::string& name, bool finishes) {
    trace::RecordingWriter writer(folder / name, trace::RecordingHeader(), {{"left", "mouse"}});
    trace::Sample sample;
    for (sample.tick = 0; sample.tick < 400; ++sample.tick) writer.add(sample);
    finishes ? writer.finish("done") : writer.flush();
  };
  record("2026-01-01T00-00-00.session", false);
  const fs::path left = folder / "2026-01-01T00-00-00.session.partial";
  ASSERT_TRUE(fs::exists(left));
  EXPECT_TRUE(tidySessions(folder.path()).empty()) << "somebody may be writing it";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::minutes(1);
  for (const char* companion : {"", "-wal"}) {
    std::error_code ignored;
    fs::last_write_time(left.string() + companion, long_ago, ignored);
  }
  const auto finished = tidySessions(folder.path());
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].filename(), "2026-01-01T00-00-00.session");
  EXPECT_EQ(trace::RecordingReader(finished[0]).facts().samples, 400u);
  EXPECT_EQ(trace::RecordingReader(finished[0]).facts().ended_by, "interrupted");
  EXPECT_FALSE(fs::exists(left));
  for (int i = 0; i < 10; ++i) record("2026-02-0" + std::to_string(i) + "T00-00-00.session", true);
  tidySessions(folder.path());
  const auto kept = sessionsIn(folder.path());
  ASSERT_EQ(kept.size(), kKeptRuns);
  EXPECT_EQ(kept.front().filename(), "2026-02-00T00-00-00.session") << "the oldest went";
}

TEST(Sessions, TheSwitchEndsAndBeginsTheRecording) {
  SessionStage stage;
  stage.press(stage.middle());
  stage.state().state.keeps_last_hour = false;
  ASSERT_TRUE(stage.until([&] { return !stage.state().recording.viewer; }));
  EXPECT_EQ(sessionsIn(stage.sessions()).size(), 1u);
  stage.key(window::key('R'), {false, true});
  EXPECT_NE(stage.lastMessage().find("Automatic recording is off"), std::string::npos);
  stage.state().state.keeps_last_hour = true;
  EXPECT_TRUE(stage.until([&] { return stage.state().recording.length_s > 0.2; }));
}

TEST(Sessions, AFolderThatCannotBeWrittenIsToldOnceAndTheTouchGoesOn) {
  Stage stage(Stage::quiet(), {}, true);
  // The viewer began its first file; the next one finds a file where its folder should be.
  stage.state().state.keeps_last_hour = false;
  ASSERT_TRUE(stage.until([&] { return !stage.state().recording.viewer; }));
  fs::remove_all(stage.folder / "sessions");
  std::ofstream(stage.folder / "sessions") << "a file";
  stage.state().state.keeps_last_hour = true;
  ASSERT_TRUE(stage.until([&] { return stage.lastMessage().starts_with("The last hour is not recorded"); }));
  const std::size_t messages = stage.state().messages.all().size();
  for (int i = 0; i < 20; ++i) stage.frame();
  EXPECT_EQ(stage.state().messages.all().size(), messages);
}

TEST(Sessions, TwoStandBesideEachOther) {
  SessionStage stage;
  stage.press(stage.middle());
  const std::string first = stage.saveRecording();
  stage.press(stage.middle() + Vec2(120, 90));
  const std::string second = stage.saveRecording();
  ASSERT_TRUE(stage.shows(first));
  stage.frame();
  const view::Image alone = stage.picture();
  stage.state().request(OpenBeside{second});
  ASSERT_TRUE(stage.until([&] { return stage.state().replay.beside == second; })) << stage.lastMessage();
  stage.state().replay.loops = true;
  stage.state().replay.playing = true;
  for (int i = 0; i < 30; ++i) stage.frame();
  const view::Image both = stage.picture();
  EXPECT_NE(both.pixels, alone.pixels);
  // The plots are where they were; the body is twice as often and smaller.
  const auto skin = [](const view::Image& image, int from, int to) {
    int seen = 0;
    for (int x = from; x < to; ++x) seen += image.at(x, 330)[0] > image.at(x, 330)[2] + 40 ? 1 : 0;
    return seen;
  };
  EXPECT_GT(skin(both, 310, 785), 150);
  EXPECT_NEAR(skin(both, 310, 785), skin(both, 800, 1275), 60);
  stage.click("replay/alone");
  stage.state().replay.playing = false;
  stage.state().replay.at_s = stage.state().replay.from_s;
  stage.frame();
  EXPECT_EQ(stage.state().replay.table, first);
  EXPECT_TRUE(stage.state().replay.beside.empty());
}

TEST(Sessions, AnotherBodyIsShownOnlyWhileItsSessionIs) {
  SessionStage stage;
  stage.press(stage.middle());
  const std::string file = stage.saveRecording();
  const std::size_t triangles = stage.viewer->world().body->skin.triangles.size();
  const fs::path other = stage.folder / "other.ply";
  mesh::save(other, zoo::wavyGrid(20, 200.0, 3.0));
  stage.drop(other);
  ASSERT_TRUE(stage.until([&] { return stage.viewer->world().body->skin.triangles.size() < triangles; }));
  ASSERT_TRUE(stage.shows(file));
  EXPECT_EQ(stage.viewer->world().body->skin.triangles.size(), triangles);
  stage.key(window::Key::space);
  EXPECT_TRUE(stage.until([&] { return stage.viewer->world().body->skin.triangles.size() < triangles; }));
}

TEST(Sessions, WhatIsNoSessionIsAMessage) {
  SessionStage stage;
  std::ofstream(stage.folder / "broken.session") << "hello";
  stage.drop(stage.folder / "broken.session");
  EXPECT_TRUE(stage.until([&] { return stage.lastMessage().starts_with("cannot replay"); })) << stage.lastMessage();
}

}  // namespace
}  // namespace palpate::viewer
