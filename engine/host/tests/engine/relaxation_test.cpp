// Skin that relaxes, on its way through loop, recording and display.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/tests/engine/small_worlds.h"
#include "palpate/base/random.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/living_skin.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/engine/servo_thread.h"
#include "palpate/trace/recording_rest.h"
#include "support/counted.h"

namespace palpate::engine {
namespace {

/// Presses, slides, leaves faster than the skin follows, comes back, and fails now and then.
device::Device restlessDevice(std::uint64_t seed) {
  device::Device device;
  device.name = "restless";
  device.read_tip = [random = Random(seed)](std::uint64_t tick) mutable {
    const Vec3 tip = slidingTip(0.001 * static_cast<double>(tick), -2.0);
    return random.below(300) == 0 ? device::kNoPlace : tip;
  };
  device.write_force = [](const Vec3&) {};
  return device;
}

servo::Rig makeRig(const std::shared_ptr<const scene::World>& world) {
  servo::RigParts parts;
  parts.solvers = servo::makeSolvers(world->surface, nullptr, 2);
  parts.fingers = fingerSettings(world->scene, 2);
  parts.limiter = servoPlan(world, parts.fingers).limiter;
  parts.devices = {restlessDevice(3), restlessDevice(4)};
  return servo::rigOf(std::move(parts));
}

class Relaxation : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "run.session"; }
  std::shared_ptr<const scene::World> world() const {
    scene::Scene scene = sheetOfTwo(folder_);
    scene.tissue.relaxation = {0.3, 0.2, 0.2, 1.0};
    return scene::build(scene);
  }
  /// How much the force was relaxed at most, mm.
  double record(int ticks) const {
    const auto felt_in = world();
    trace::RecordingWriter writer(file(), recordingHeader(1000.0), {{"left", "script"}, {"right", "script"}});
    servo::Rig rig = makeRig(felt_in);
    writer.add(recordingWorld(*felt_in, feltWith(rig)));
    std::vector<trace::Sample> samples(2);
    double most = 0.0;
    for (std::uint64_t tick = 0; tick < static_cast<std::uint64_t>(ticks); ++tick) {
      servo::runTick(rig, tick, servo::LoopEvent::none, samples);
      for (const trace::Sample& sample : samples) {
        writer.add(sample);
        most = std::max(most, sample.contact.rest_mm);
      }
    }
    writer.finish("done");
    return most;
  }
  support::TemporaryFolder folder_;
};

TEST_F(Relaxation, IsFeltAgainFromARecordingToTheBit) {
  EXPECT_GT(record(3000), 0.5);
  {
    trace::RecordingReader recording(file());
    const ReplayReport report = replay(recording);
    EXPECT_TRUE(report.identical()) << (report.first_difference ? report.first_difference->field : "notes");
    EXPECT_EQ(report.ticks, 6000u);
    int dents = 0;
    recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
      for (const trace::Sample& sample : samples) dents += sample.contact.dent.rest_mm > 0.1 ? 1 : 0;
      return true;
    });
    EXPECT_GT(dents, 100) << "what the skin remembers is in the file";
  }
  trace::Database(file(), trace::Database::Mode::write)
      .run("UPDATE settings SET contact = replace(contact, 'relaxation = 0.3', 'relaxation = 0.2999')");
  trace::RecordingReader recording(file());
  EXPECT_TRUE(replay(recording).first_difference) << "it is felt with the settings that it was recorded with";
}

TEST(RestOfARecording, WaitsUntilTheDentIsGone) {
  trace::Sample sample;
  EXPECT_TRUE(trace::rests(sample));
  sample.contact.dent.rest_mm = 1e-5;
  EXPECT_FALSE(trace::rests(sample));
}

/// How far the skin lies below its rest anywhere, mm.
double deepest(const LivingSkin& skin) {
  const auto z = skin.surface().displacement(2);
  return -static_cast<double>(*std::min_element(z.begin(), z.end()));
}

TEST(LivingSkinThatRelaxes, ShowsTheDentComeBack) {
  scene::Scene scene;
  scene.tissue.relaxation = {0.3, 0.5, 0.0, 1.0};
  const auto world = sheet(0.5, scene, 80);
  const contact::FingerSettings settings = fingerSettings(world->scene).front();
  ASSERT_TRUE(settings.relaxation.on());
  contact::FingerState state;
  LivingSkin skin(*world);
  const auto shown_after = [&](const Vec3& tip, int ticks) {
    contact::FingerOutput felt;
    for (int i = 0; i < ticks; ++i) felt = contact::step(world->surface, settings, state, tip);
    skin.follow(std::span(&felt, 1));
    return deepest(skin);
  };
  shown_after(under(-1), 1);
  const double pressed = shown_after(under(8), 5000);
  EXPECT_GT(pressed, 7.0);
  EXPECT_LT(pressed, 8.1);
  const double share = pressed / 8.0;  // of the depth, at the vertex nearest to the finger
  EXPECT_NEAR(shown_after(under(1), 1), 2.4 * share, 0.15) << "the finger is higher than the skin comes";
  EXPECT_NEAR(shown_after(under(-5), 1), 2.4 * share, 0.15) << "the finger is gone, and nothing jumps";
  EXPECT_NEAR(shown_after(under(-5), 500), 2.4 * share * std::exp(-0.7), 0.15);
  EXPECT_LT(shown_after(under(-5), 5000), 0.01);
  EXPECT_EQ(shown_after(under(-5), 20000), 0.0);
}

TEST(LivingSkinThatRelaxes, HasRoomForEveryFingersDentAndAllocatesNothing) {
  const auto world = sheet(0.5);
  contact::FingerSettings settings;
  settings.relaxation = {0.3, 0.5, 0.0, 1.0};
  contact::FingerState state;
  contact::FingerOutput felt;
  for (int i = 0; i < 2000; ++i) felt = contact::step(world->surface, settings, state, under(i == 0 ? -1 : 8));
  felt = contact::step(world->surface, settings, state, under(-5));
  ASSERT_GT(felt.dent.rest_mm, 2.0);
  const std::vector<contact::FingerOutput> crowd(12, felt);
  LivingSkin skin(*world, {.fingers = crowd.size()});
  std::uint32_t status = ~0u;
  support::expectNoAllocation([&] { status = skin.follow(crowd).status; });
  EXPECT_EQ(status & deform::kIgnoredOverCapacity, 0u);
  EXPECT_GT(deepest(skin), 0.5);
}

TEST(SettingsOfARecording, HaveTheRelaxation) {
  contact::FingerSettings contact;
  contact.relaxation = {0.1, 1.0 / 3.0, 0.2, 7.0};
  const contact::Relaxation back = contactSettingsFrom(asText(contact)).relaxation;
  EXPECT_EQ(back.share, 0.1);
  EXPECT_EQ(back.time_s, 1.0 / 3.0);
  EXPECT_EQ(back.share_2, 0.2);
  EXPECT_EQ(back.time_2_s, 7.0);
  EXPECT_FALSE(contactSettingsFrom("radius_mm = 8\n").relaxation.on()) << "recordings from before there was any";
}

}  // namespace
}  // namespace palpate::engine
