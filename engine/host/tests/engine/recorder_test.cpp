// Recording while the servo runs: what is lost is reported, and the servo never waits.
#include "palpate/engine/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>

#include "host/tests/engine/small_worlds.h"
#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/recording_replay.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate::engine {
namespace {

using support::waitFor;

/// Presses, slides and lifts, the second finger in another rhythm; pushes its button in every fourth stroke.
device::Device strokingDevice(double rhythm) {
  struct Stroke {
    double t = 0.0;
    bool down() const { return std::fmod(t, 4.0) < 0.1; }
  };
  auto stroke = std::make_shared<Stroke>();
  device::Device device;
  device.name = "stroking";
  device.read_tip = [stroke, rhythm](std::uint64_t tick) {
    const double t = stroke->t = 0.001 * rhythm * static_cast<double>(tick);
    return Vec3(100.0 + 30.0 * std::sin(3.0 * t), 100.0 + 20.0 * std::cos(2.0 * t), 1.0 + 6.0 * std::cos(9.0 * t));
  };
  device.write_force = [](const Vec3&) {};
  device.state = [stroke] {
    device::DeviceState state;
    state.buttons = stroke->down() ? 1u : 0u;
    return state;
  };
  return device;
}

class RecorderOf : public testing::Test {
 protected:
  ServoPlan plan(double stiffness) const {
    scene::Scene scene = sheetOfTwo(folder_);
    scene.stiffness.constant_n_per_mm = stiffness;
    const auto world = scene::build(scene);
    ServoPlan plan = servoPlan(world, fingerSettings(world->scene, 2));
    plan.other_body = false;
    return plan;
  }
  static std::vector<device::Device> devices() { return {strokingDevice(1.0), strokingDevice(1.7)}; }
  RecorderSettings settings() const { return {file(), recordingHeader(1000.0), {{"left", "a"}, {"right", "b"}}}; }
  std::filesystem::path file() const { return folder_ / "run.session"; }

  static bool waitForSamples(const Recorder& recorder, std::uint64_t more) {
    const std::uint64_t enough = recorder.state().samples + more;
    return waitFor([&] { return recorder.state().samples >= enough || !recorder.state().failure.empty(); }) &&
           recorder.state().failure.empty();
  }
  static std::vector<trace::RecordingEvent> findEvents(trace::RecordingReader& recording, std::string_view kind) {
    std::vector<trace::RecordingEvent> found;
    for (const trace::RecordingEvent& event : recording.events()) {
      if (event.kind == kind) found.push_back(event);
    }
    return found;
  }
  static void expectIdentical(trace::RecordingReader& recording) {
    const ReplayReport report = replay(recording);
    ASSERT_FALSE(report.first_difference)
        << "tick " << report.first_difference->tick << " " << report.first_difference->field << " was "
        << report.first_difference->recorded << ", is " << report.first_difference->replayed;
    EXPECT_GT(report.ticks, 0u);
  }

  support::TemporaryFolder folder_;
};

TEST_F(RecorderOf, ARunningServoIsFeltAgainThroughChangedWorlds) {
  ServoThread servo(plan(0.5), devices());
  Recorder recorder(servo, settings());
  for (const double stiffness : {0.8, 0.6}) {
    ASSERT_TRUE(waitForSamples(recorder, 900));
    servo.change(plan(stiffness));
    ASSERT_TRUE(waitFor([&] { return servo.exchange(); }));
  }
  recorder.mark("here");
  recorder.attach({0, "picture", "a.png", "image/png", std::string("\x89PNG\0x", 6)});
  ASSERT_TRUE(waitForSamples(recorder, 900));
  servo.stop();
  recorder.finish("done");
  EXPECT_TRUE(recorder.anyTouch());
  trace::RecordingReader recording(file());
  EXPECT_EQ(recording.facts().ended_by, "done");
  EXPECT_EQ(recording.facts().worlds, 3u);
  EXPECT_EQ(recording.facts().dropped, 0u);
  EXPECT_EQ(findEvents(recording, "world").size(), 2u);
  EXPECT_FALSE(findEvents(recording, "button").empty());
  ASSERT_EQ(findEvents(recording, "mark").size(), 1u);
  EXPECT_EQ(findEvents(recording, "mark")[0].text, "here");
  std::string data;
  recording.forEachAttachment({}, [&](const trace::RecordingAttachment& a) { data = a.name + "|" + a.data; });
  EXPECT_EQ(data, std::string("a.png|\x89PNG\0x", 12));
  expectIdentical(recording);
}

TEST_F(RecorderOf, TheServoThreadNeitherWaitsNorAllocatesForIt) {
  struct Counted {
    std::atomic<std::uint64_t> ticks{0}, calls{0};
  } counted;
  if (!lab::kCountsCalls) GTEST_SKIP() << "this build counts no calls";
  ServoThread servo(plan(0.5), devices(), [&counted, before = lab::ThreadCounts{}](auto) mutable {
    if (counted.ticks++ > 100) {
      const lab::ThreadCounts since = lab::countsSince(before);
      counted.calls += since.allocations.value_or(0) + since.locks.value_or(0);
    }
    before = lab::countsOfThisThread();
  });
  Recorder recorder(servo, settings());
  ASSERT_TRUE(waitForSamples(recorder, 2000));
  EXPECT_EQ(counted.calls, 0u);
  EXPECT_GT(counted.ticks, 800u);
}

/// Another program that holds the file's lock: whatever is written waits, as on a disk that stands still.
class StandingDisk {
 public:
  explicit StandingDisk(const std::filesystem::path& file)
      : database_(file, trace::Database::Mode::write), lock_(std::in_place, database_) {}
  void goOn() { lock_.reset(); }

 private:
  trace::Database database_;
  std::optional<trace::Transaction> lock_;
};

TEST_F(RecorderOf, ADiskThatStandsStillForTwoSecondsLosesNothing) {
  ServoThread servo(plan(0.5), devices());
  Recorder recorder(servo, settings());
  ASSERT_TRUE(waitForSamples(recorder, 300));
  {
    StandingDisk disk(recorder.partial());
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));
  }
  ASSERT_TRUE(waitForSamples(recorder, 4000));
  const servo::LoopReport loop = servo.stop();
  recorder.finish("done");
  EXPECT_EQ(recorder.state().dropped, 0u);
  trace::RecordingReader recording(file());
  const trace::RecordingFacts& facts = recording.facts();
  EXPECT_EQ(facts.dropped, 0u);
  // Every tick of the servo since the first: those that it missed are its own, of a machine that did something else.
  EXPECT_LE(2 * (facts.last_tick - facts.first_tick + 1) - facts.samples, 2 * loop.overruns);
  expectIdentical(recording);
}

TEST_F(RecorderOf, WhatFindsNoRoomIsCountedAndMarked) {
  ServoThread servo(plan(0.5), devices(), {}, 512);
  Recorder recorder(servo, settings());
  ASSERT_TRUE(waitForSamples(recorder, 300));
  {
    StandingDisk disk(recorder.partial());
    ASSERT_TRUE(waitFor([&] { return recorder.state().dropped > 500; }));
  }
  ASSERT_TRUE(waitForSamples(recorder, 3000));
  servo.stop();
  recorder.finish("done");
  trace::RecordingReader recording(file());
  EXPECT_EQ(recording.facts().dropped, recorder.state().dropped);
  EXPECT_GT(recording.facts().dropped, 500u);
  const auto events = findEvents(recording, "dropped");
  ASSERT_FALSE(events.empty());
  EXPECT_NE(events[0].text.find("found no room"), std::string::npos) << events[0].text;
  // The events stand where ticks are missing, and what was felt around the gaps is proven.
  std::uint64_t before = 0;
  std::uint64_t missing = 0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    for (const trace::RecordingEvent& event : events)
      missing += event.tick == samples[0].tick ? event.tick - before - 1 : 0;
    before = samples[0].tick;
    return true;
  });
  EXPECT_GE(2 * (missing + events.size()), recording.facts().dropped);
  expectIdentical(recording);
}

TEST_F(RecorderOf, AFileOfTheLastHourForgetsWhatIsOlderAndIsStillProven) {
  RecorderSettings last = settings();
  last.keep_s = 1.0;
  ServoThread servo(plan(0.5), devices());
  Recorder recorder(servo, last);
  for (const double stiffness : {0.8, 0.6, 0.9}) {
    ASSERT_TRUE(waitForSamples(recorder, 1200));
    servo.change(plan(stiffness));
    ASSERT_TRUE(waitFor([&] { return servo.exchange(); }));
  }
  ASSERT_TRUE(waitForSamples(recorder, 1200));
  EXPECT_NEAR(recorder.state().seconds, 1.0, 0.1);
  servo.stop();
  recorder.finish("done");
  trace::RecordingReader recording(file());
  EXPECT_LT(recording.facts().seconds(), 1.4);
  EXPECT_GT(recording.facts().seconds(), 0.8);
  EXPECT_GT(recording.facts().first_world, 0u);
  EXPECT_EQ(findEvents(recording, "cut").size(), 1u);
  expectIdentical(recording);
}

TEST_F(RecorderOf, ACopyIsFinishedWhileItGoesOn) {
  ServoThread servo(plan(0.5), devices());
  Recorder recorder(servo, settings());
  ASSERT_TRUE(waitForSamples(recorder, 600));
  EXPECT_TRUE(recorder.save(folder_ / "kept.session"));
  EXPECT_FALSE(recorder.save(folder_ / "other.session")) << "one at a time";
  std::optional<KeptRecording> kept;
  ASSERT_TRUE(waitFor([&] { return (kept = recorder.collectSaved()).has_value(); }));
  EXPECT_EQ(kept->failure, "");
  EXPECT_EQ(kept->file, folder_ / "kept.session");
  trace::RecordingReader copy(kept->file);
  EXPECT_EQ(copy.facts().ended_by, "kept");
  EXPECT_NEAR(copy.facts().seconds(), kept->seconds, 0.02);
  expectIdentical(copy);
  ASSERT_TRUE(waitForSamples(recorder, 600));
  servo.stop();
  recorder.finish("done");
  EXPECT_GT(trace::RecordingReader(file()).facts().samples, copy.facts().samples + 500);
}

TEST_F(RecorderOf, AFolderThatVanishesEndsItWithAMessageAndTheServoGoesOn) {
  const auto folder = folder_ / "gone";
  std::filesystem::create_directory(folder);
  RecorderSettings there = settings();
  there.file = folder / "run.session";
  ServoThread servo(plan(0.5), devices());
  Recorder recorder(servo, there);
  ASSERT_TRUE(waitForSamples(recorder, 300));
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(waitFor([&] { return !recorder.state().failure.empty(); }));
  EXPECT_NE(recorder.state().failure.find("was deleted"), std::string::npos) << recorder.state().failure;
  const std::uint64_t ticks = servo.vitals().ticks;
  EXPECT_TRUE(waitFor([&] { return servo.vitals().ticks > ticks; }));
  EXPECT_THROW(recorder.finish("done"), Error);
}

TEST_F(RecorderOf, AFullDiskLeavesWhatWasWritten) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  ServoThread servo(plan(0.5), devices());
  std::optional<Recorder> recorder;
  recorder.emplace(servo, settings());
  ASSERT_TRUE(waitForSamples(*recorder, 300));
  rlimit small = before;
  small.rlim_cur = 200 * 1024;
  setrlimit(RLIMIT_FSIZE, &small);
  const bool failed = waitFor([&] { return !recorder->state().failure.empty(); });
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_TRUE(failed);
  const auto partial = recorder->partial();
  EXPECT_THROW(recorder->finish("done"), Error);
  recorder.reset();
  trace::RecordingReader recording(partial);
  EXPECT_GT(recording.facts().samples, 100u);
  EXPECT_TRUE(recording.damagedBlocks().empty());
  expectIdentical(recording);
}

TEST_F(RecorderOf, ARecordingThatIsDiscardedLeavesNothing) {
  ServoThread servo(plan(0.5), devices());
  {
    Recorder recorder(servo, settings());
    ASSERT_TRUE(waitForSamples(recorder, 400));
    recorder.discard();
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().filename(), "sheet.ply");
  }
}

TEST_F(RecorderOf, AFolderThatCannotBeWrittenIsSaidAtOnce) {
  ServoThread servo(plan(0.5), devices());
  RecorderSettings nowhere = settings();
  nowhere.file = folder_ / "sheet.ply" / "run.session";
  EXPECT_NE(support::thrownMessage([&] { Recorder(servo, nowhere); }).find("sheet.ply"), std::string::npos);
}

}  // namespace
}  // namespace palpate::engine
