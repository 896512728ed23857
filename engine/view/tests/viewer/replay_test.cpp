// Stepping back and forth through what was touched: the last minute of a frozen recording, and recorded tables.
#include "view/viewer/state/replay.h"

#include "palpate/base/text.h"
#include "palpate/trace/forces_table.h"
#include "stage.h"
#include "view/viewer/files/recorded_touch.h"

namespace palpate::viewer {
namespace {

trace::Sample sampleAt(std::uint64_t tick, std::uint32_t finger, double depth_mm) {
  trace::Sample sample;
  sample.tick = tick;
  sample.finger = finger;
  sample.contact.depth_mm = depth_mm;
  return sample;
}

TEST(TouchHistory, TellsWhatWasTrueAtATimeForBothFingers) {
  TouchHistory history(1000.0, 10.0);
  EXPECT_TRUE(history.empty());
  for (std::uint64_t tick = 100; tick < 200; ++tick) {
    history.add(sampleAt(tick, 0, static_cast<double>(tick)));
    history.add(sampleAt(tick, 1, -static_cast<double>(tick)));
  }
  EXPECT_DOUBLE_EQ(history.oldestTime(), 0.1);
  EXPECT_DOUBLE_EQ(history.newestTime(), 0.199);
  EXPECT_EQ(history.at(0.15)[0].contact.depth_mm, 150.0);
  EXPECT_EQ(history.at(0.1503)[1].contact.depth_mm, -150.0) << "the newest that is not later";
  EXPECT_EQ(history.at(-1.0)[0].tick, 100u);
  EXPECT_EQ(history.at(7.0)[0].tick, 199u);
}

TEST(TouchHistory, ForgetsTheOldestAndStaysInOrder) {
  TouchHistory history(1000.0, 0.05);
  for (std::uint64_t tick = 0; tick < 173; ++tick) history.add(sampleAt(tick, 0, static_cast<double>(tick)));
  EXPECT_DOUBLE_EQ(history.oldestTime(), 0.123);
  for (std::uint64_t tick = 123; tick < 173; ++tick)
    EXPECT_EQ(history.at(1e-3 * static_cast<double>(tick))[0].tick, tick);
}

TEST(Replay, StepsAPictureOrATickAndStaysWithinWhatThereIs) {
  Replay replay;
  TouchHistory history;
  for (std::uint64_t tick = 0; tick < 1000; ++tick) history.add(sampleAt(tick, 0, 0.0));
  advanceReplay(replay, history, 0.1);
  freeze(replay, true);
  EXPECT_DOUBLE_EQ(replay.at_s, 0.999);
  EXPECT_TRUE(replayKey(window::Action::ring_left, false, replay));
  EXPECT_NEAR(replay.at_s, 0.999 - 1.0 / 60.0, 1e-12);
  EXPECT_TRUE(replayKey(window::Action::ring_right, true, replay));
  EXPECT_NEAR(replay.at_s, 1.0 - 1.0 / 60.0, 1e-12);
  for (int i = 0; i < 100; ++i) stepReplay(replay, -kReplayStepS);
  EXPECT_EQ(replay.at_s, 0.0);
  replay.playing = true;
  advanceReplay(replay, history, 0.25);
  EXPECT_DOUBLE_EQ(replay.at_s, 0.25);
  advanceReplay(replay, history, 9.0);
  EXPECT_DOUBLE_EQ(replay.at_s, 0.999);
  EXPECT_FALSE(replay.playing) << "at its end";
}

TEST(Replay, StepsByTheTicksOfWhatWasRecorded) {
  Replay replay;
  TouchHistory history(400.0, 10.0);
  for (std::uint64_t tick = 0; tick < 400; ++tick) history.add(sampleAt(tick, 0, 0.0));
  advanceReplay(replay, history, 0.1);
  freeze(replay, true);
  EXPECT_TRUE(replayKey(window::Action::ring_left, true, replay));
  EXPECT_DOUBLE_EQ(replay.at_s, 0.995) << "2.5 ms before the last of 400 a second";
}

TEST(Replay, LeavesTheArrowsToTheFingerUnlessFrozen) {
  Replay replay;
  EXPECT_FALSE(replayKey(window::Action::ring_left, false, replay));
  replay.frozen = true;
  EXPECT_FALSE(replayKey(window::Action::ring_up, false, replay));
}

TEST(Replay, AFrozenPictureStepsBackToBeforeThePress) {
  Stage stage;
  stage.move(stage.middle());
  ASSERT_TRUE(stage.until([&] { return stage.state().performance.servo.ticks >= 1000; }));
  stage.key(window::Key::enter);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.9; }));
  stage.key(window::Key::space);
  stage.frame();
  const view::Image pressed = stage.picture();
  EXPECT_GT(stage.finger().depth_mm, 5.0);
  const auto in_the_air = [&] { return stage.finger().touch == contact::Touch::free; };
  for (int i = 0; i < 900 && !in_the_air(); ++i) stage.key(window::Key::left);
  ASSERT_TRUE(in_the_air()) << "back before the press";
  int ticks = 0;
  for (; ticks < 20 && in_the_air(); ++ticks) stage.key(window::Key::right, {false, true});
  EXPECT_LE(ticks, 18) << "a picture is 17 ticks";
  EXPECT_LT(stage.finger().depth_mm, 1.0) << "the first tick of the touch";
  EXPECT_NE(stage.picture().pixels, pressed.pixels);
  stage.key(window::Key::space);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.9; })) << "the touch went on";
}

TEST(Replay, ARecordedTableIsFeltAgainToTheLastBit) {
  Stage stage;
  stage.key(window::key('R'));
  stage.move(stage.middle());
  stage.button(true);
  ASSERT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  stage.move(stage.middle() + Vec2(60, 20));
  ASSERT_TRUE(stage.until([&] { return stage.finger().touch == contact::Touch::slip; }));
  stage.button(false);
  ASSERT_TRUE(stage.until([&] { return stage.finger().touch == contact::Touch::free; }));
  stage.key(window::key('R'));
  const std::string table = stage.state().recording.forces_file;
  const auto recorded = trace::readForcesTable(table);
  stage.drop(table);
  ASSERT_TRUE(stage.until([&] { return !stage.state().replay.table.empty(); })) << stage.lastMessage();
  EXPECT_TRUE(stage.state().replay.frozen);
  for (std::size_t i = 0; i < recorded[0].force.size(); i += 37) {
    stage.state().replay.at_s = recorded[0].time_s[i];
    stage.frame();
    ASSERT_EQ(stage.finger().force, recorded[0].force[i]) << "at " << recorded[0].time_s[i] << " s";
  }
  stage.key(window::Key::space);
  stage.frame();
  EXPECT_TRUE(stage.state().replay.table.empty()) << "live again";
}

TEST(Replay, ATableThatIsNoneBecomesAMessage) {
  Stage stage;
  writeFile(stage.folder / "prices.csv", "apples,pears\n1,2\n");
  stage.drop(stage.folder / "prices.csv");
  ASSERT_TRUE(stage.until([&] { return !stage.state().messages.all().empty(); }));
  EXPECT_TRUE(stage.lastMessage().starts_with("cannot replay ")) << stage.lastMessage();
  EXPECT_FALSE(stage.state().replay.frozen);
}

}  // namespace
}  // namespace palpate::viewer
