// A recording felt again gives every bit, whatever happened while it was recorded.
#include "palpate/engine/recording_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>

#include "host/tests/engine/small_worlds.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/engine/servo_thread.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate::engine {
namespace {

/// A finger that presses, slides, lifts, and whose device fails now and then.
device::Device troubledDevice(std::uint64_t seed) {
  device::Device device;
  device.name = "troubled";
  device.read_tip = [random = Random(seed)](std::uint64_t tick) mutable {
    const Vec3 tip = slidingTip(0.001 * static_cast<double>(tick), -4.0);
    if (random.below(200) == 0) return device::kNoPlace;
    if (random.below(300) == 0) return Vec3(tip + Vec3(0, 0, 25));
    return random.below(400) == 0 ? Vec3(Vec3::Constant(1e9)) : tip;
  };
  device.write_force = [](const Vec3&) {};
  return device;
}

class RecordingReplay : public testing::Test {
 protected:
  std::shared_ptr<const scene::World> buildSheetWorld(double stiffness) const {
    scene::Scene scene = sheetOfTwo(folder_);
    scene.stiffness.constant_n_per_mm = stiffness;
    return scene::build(scene);
  }

  static std::vector<FingerSetup> feltWith(const ServoPlan& plan) {
    std::vector<FingerSetup> fingers;
    for (const contact::FingerSettings& finger : plan.fingers) fingers.push_back({finger, plan.limiter, true});
    return fingers;
  }

  std::filesystem::path file() const { return folder_ / "run.session"; }

  support::TemporaryFolder folder_;
};

/// A servo thread of two troubled fingers whose ticks go into a recording.
class TroubledRun {
 public:
  TroubledRun(ServoPlan first, trace::RecordingWriter& writer)
      : writer_(writer), servo_(std::move(first), {troubledDevice(1), troubledDevice(2)}) {}

  std::uint64_t ticks() const { return ticks_; }

  void record(std::uint64_t more_ticks) {
    const std::uint64_t enough = ticks_ + more_ticks;
    ASSERT_TRUE(support::waitFor([&] { return drain(), ticks_ > enough; }));
  }

  void changeTo(ServoPlan next) {
    servo_.change(std::move(next));
    ASSERT_TRUE(support::waitFor([&] { return servo_.exchange(); }));
  }

  void stopInAnEmergency() {
    servo_.emergencyStop().press();
    // Counted by what was stopped: on a busy machine the ring still holds ticks from before the press.
    const std::uint64_t long_enough = stopped_ + 60;
    ASSERT_TRUE(support::waitFor([&] { return drain(), stopped_ > long_enough; }));
    servo_.emergencyStop().release();
  }

  void finish() {
    servo_.stop();
    drain();
    ASSERT_EQ(servo_.droppedSamples(), 0u);
  }

 private:
  void drain() {
    trace::Sample sample;
    for (; servo_.pop(sample); ++ticks_) {
      writer_.add(sample);
      if ((sample.safety & servo::kEmergencyStop) != 0u) ++stopped_;
    }
  }

  trace::RecordingWriter& writer_;
  ServoThread servo_;
  std::uint64_t ticks_ = 0;
  std::uint64_t stopped_ = 0;
};

void expectTroublesAndFourWorlds(trace::RecordingReader& recording) {
  std::uint32_t seen = 0;
  std::uint32_t last_world = 0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) {
      seen |= sample.safety;
      last_world = sample.world;
    }
    return true;
  });
  EXPECT_EQ(last_world, 3u);
  EXPECT_NE(seen & servo::kTipNotFinite, 0u);
  EXPECT_NE(seen & servo::kTipJumped, 0u);
  EXPECT_NE(seen & servo::kEmergencyStop, 0u);
}

TEST_F(RecordingReplay, GivesEveryBitThroughFaultsWorldChangesAndAnEmergencyStop) {
  trace::RecordingWriter writer(file(), recordingHeader(1000.0), {{"left", "troubled"}, {"right", "troubled"}});
  const auto recorded_plan = [&](double stiffness, bool other_body) {
    const auto world = buildSheetWorld(stiffness);
    ServoPlan plan = servoPlan(world, fingerSettings(world->scene, 2));
    plan.other_body = other_body;
    writer.add(recordingWorld(*plan.world, feltWith(plan)));
    return plan;
  };
  TroubledRun run(recorded_plan(0.5, true), writer);
  for (const double stiffness : {1.0, 0.7, 1.3}) {
    run.record(600);
    run.changeTo(recorded_plan(stiffness, false));
    run.stopInAnEmergency();
    ASSERT_FALSE(HasFatalFailure());
  }
  run.record(1000);
  run.finish();
  ASSERT_FALSE(HasFatalFailure());
  writer.finish("done");
  trace::RecordingReader recording(file());
  expectTroublesAndFourWorlds(recording);
  const ReplayReport report = replay(recording);
  ASSERT_FALSE(report.first_difference) << "tick " << report.first_difference->tick << " "
                                        << report.first_difference->field << " was "
                                        << report.first_difference->recorded << ", is "
                                        << report.first_difference->replayed;
  EXPECT_TRUE(report.identical());
  EXPECT_EQ(report.ticks, run.ticks());
  if (const char* keep = std::getenv("PALPATE_KEEP_SESSION")) {  // tests/data/sessions/README.md
    std::filesystem::copy(file(), std::filesystem::path(keep) / "troubled.session");
    std::filesystem::copy(folder_ / "sheet.ply", std::filesystem::path(keep) / "sheet.ply");
  }
}

/// Two fingers on their paths, for a second, without a thread.
void recordHeadless(const std::filesystem::path& file, const std::shared_ptr<const scene::World>& world) {
  trace::RecordingWriter writer(file, recordingHeader(1000.0), {{"left", "script"}, {"right", "script"}});
  servo::RigParts parts;
  parts.solvers = servo::makeSolvers(world->surface, nullptr, 2);
  parts.fingers = fingerSettings(world->scene, 2);
  parts.limiter = servoPlan(world, parts.fingers).limiter;
  parts.devices = {troubledDevice(3), troubledDevice(4)};
  servo::Rig rig = servo::rigOf(std::move(parts));
  writer.add(recordingWorld(*world, feltWith(rig)));
  std::vector<trace::Sample> samples(2);
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    servo::runTick(rig, tick, servo::LoopEvent::none, samples);
    for (const trace::Sample& sample : samples) writer.add(sample);
  }
  writer.finish("done");
}

TEST_F(RecordingReplay, NamesTheFirstDifference) {
  recordHeadless(file(), buildSheetWorld(0.625));
  {
    trace::RecordingReader recording(file());
    EXPECT_TRUE(replay(recording).identical());
  }
  // The same poses on a skin that is a little stiffer.
  trace::Database database(file(), trace::Database::Mode::write);
  database.run("UPDATE worlds SET scene = replace(scene, '0.625', '0.625001')");
  trace::RecordingReader recording(file());
  const ReplayReport report = replay(recording);
  EXPECT_FALSE(report.identical());
  ASSERT_TRUE(report.first_difference);
  EXPECT_TRUE(report.first_difference->field.starts_with("force_")) << report.first_difference->field;
  EXPECT_NE(report.first_difference->recorded, report.first_difference->replayed);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("world 0 is not the recorded one"), std::string::npos);
}

TEST_F(RecordingReplay, ComparesOnlyTheSpanThatIsAskedFor) {
  recordHeadless(file(), buildSheetWorld(0.5));
  trace::RecordingReader recording(file());
  std::uint64_t felt = 0;
  const ReplayReport report =
      replay(recording, {{500, 599}, {}}, [&](std::span<const trace::Sample> tick) { felt += tick.size(); });
  EXPECT_EQ(report.ticks, 200u);
  EXPECT_EQ(felt, 200u);
  EXPECT_TRUE(report.identical());
}

/// A kept file, open in a copy: a reader may leave files beside what it reads.
struct Kept {
  Kept(const char* version, const char* file)
      : folder(support::testData() / "sessions" / version), recording(copied(file)) {}

  std::filesystem::path folder;
  support::TemporaryFolder copy;
  trace::RecordingReader recording;

 private:
  std::filesystem::path copied(const char* file) const {
    std::filesystem::copy(folder / file, copy / file);
    return copy / file;
  }
};

/// Files of every version are felt again for ever: the first, of a corner that was pressed by a point.
TEST(RecordingVersions, TheFirstIsStillFeltAgain) {
  Kept kept("version_1", "press.session");
  trace::RecordingReader& recording = kept.recording;
  EXPECT_EQ(recording.facts().samples, 50u);
  const ReplayReport report = replay(recording, {{}, kept.folder});
  EXPECT_TRUE(report.identical()) << (report.first_difference ? report.first_difference->field : "notes");
}

/// The second, of two fingers through faults, three changed worlds and emergency stops.
TEST(RecordingVersions, TheSecondIsStillFeltAgainThroughFaultsAndChangedWorlds) {
  Kept kept("version_2", "troubled.session");
  trace::RecordingReader& recording = kept.recording;
  EXPECT_EQ(recording.facts().version, 2);
  EXPECT_EQ(recording.facts().worlds, 4u);
  EXPECT_EQ(recording.facts().fingers.size(), 2u);
  const ReplayReport report = replay(recording, {{}, kept.folder});
  EXPECT_TRUE(report.identical()) << (report.first_difference ? report.first_difference->field : "notes");
  EXPECT_EQ(report.ticks, recording.facts().samples);
}

/// The third, on the built-in trunk, which is made again here: since 0.2 it has other last bits.
TEST(RecordingVersions, TheThirdIsFeltAgainWithAForceThatDiffersByLittleAndANoteThatSaysWhy) {
  Kept kept("version_3", "trunk.session");
  trace::RecordingReader& recording = kept.recording;
  EXPECT_EQ(recording.facts().version, 3);
  std::vector<Vec3> recorded;
  recording.forEachTick({}, [&](std::span<const trace::Sample> tick) {
    for (const trace::Sample& sample : tick) recorded.push_back(sample.contact.force);
    return true;
  });
  double off_n = 0.0;
  std::size_t at = 0;
  const ReplayReport report = replay(recording, {{}, kept.folder}, [&](std::span<const trace::Sample> tick) {
    for (const trace::Sample& sample : tick) off_n = std::max(off_n, (sample.contact.force - recorded[at++]).norm());
  });
  EXPECT_EQ(report.ticks, recording.facts().samples);
  EXPECT_GT(off_n, 0.0);
  EXPECT_LT(off_n, 1e-3);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("palpate 0.2"), std::string::npos) << report.notes[0];
}

/// The fifth, on the built-in trunk, to the bit on every platform.
TEST(RecordingVersions, TheFifthIsStillFeltAgain) {
  Kept kept("version_5", "trunk.session");
  trace::RecordingReader& recording = kept.recording;
  EXPECT_EQ(recording.facts().version, 5);
  const ReplayReport report = replay(recording, {{}, kept.folder});
  EXPECT_TRUE(report.identical()) << (report.first_difference ? report.first_difference->field : "notes");
  EXPECT_EQ(report.ticks, recording.facts().samples);
}

TEST(RecordingSettings, AreReadBackToTheBit) {
  contact::FingerSettings contact;
  contact.radius_mm = 1.0 / 3.0;
  contact.force_shading = true;
  EXPECT_EQ(contactSettingsFrom(asText(contact)).radius_mm, 1.0 / 3.0);
  EXPECT_EQ(contactSettingsFrom("relaxation = 0.2\nrelaxation_2_s = 7\n").relaxation.time_2_s, 7.0)
      << "the names of recordings that there are";
  EXPECT_TRUE(contactSettingsFrom(asText(contact)).force_shading);
  servo::LimiterSettings limiter;
  limiter.passivity.friction_n = 0.1 + 0.2;
  limiter.start = scene::StartRule::ramp;
  const RecordedLimiter back = limiterFrom(asText(limiter, false));
  EXPECT_EQ(back.settings.passivity.friction_n, 0.1 + 0.2);
  EXPECT_EQ(back.settings.start, scene::StartRule::ramp);
  EXPECT_FALSE(back.closes_loop);
  EXPECT_TRUE(back.follows_exchange);
  EXPECT_FALSE(limiterFrom("limited = 1\n").follows_exchange) << "recordings of before have no such line";
  EXPECT_EQ(asText(limiter, false).find("unsafe"), std::string::npos) << "recordings of before have no such line";
  limiter.unsafe = true;
  EXPECT_TRUE(limiterFrom(asText(limiter, false)).settings.unsafe);
  EXPECT_NE(describeLimits(limiter).find("UNSAFE"), std::string::npos);
  EXPECT_THROW(contactSettingsFrom("radius = 8\n"), Error);
  EXPECT_THROW(contactSettingsFrom("radius_mm = much\n"), Error);
}

}  // namespace
}  // namespace palpate::engine
