// A part of a recording, felt again from its beginning, gives the bits of the whole: wherever it was cut, through
// faults, with a loop that is closed and damped.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/random.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/engine/servo_thread.h"
#include "palpate/mesh/files/save.h"
#include "palpate/trace/recording_edit.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::engine {
namespace {

/// Taps and slides on a sheet, with a tremor that makes the loop lose energy; its device fails now and then.
device::Device tappingDevice(std::uint64_t seed) {
  device::Device device;
  device.name = "tapping";
  device.read_tip = [random = Random(seed), seed](std::uint64_t tick) mutable {
    const double t = 0.001 * static_cast<double>(tick) + 0.1 * static_cast<double>(seed);
    const Vec3 tip(100.0 + 30.0 * std::sin(3.0 * t), 100.0 + 20.0 * std::cos(2.0 * t),
                   4.0 + 6.0 * std::sin(5.0 * t) + 0.8 * std::sin(300.0 * t));
    if (random.below(900) == 0) return device::kNoPlace;
    return random.below(900) == 0 ? Vec3(tip + Vec3(0, 0, 25)) : tip;
  };
  device.write_force = [](const Vec3&) {};
  return device;
}

class RecordingEditReplay : public testing::Test {
 protected:
  /// Twelve seconds of two fingers on 8 N/mm; over a lump that moves, and one that does not.
  std::filesystem::path record(const std::string& name, std::uint64_t seed, bool lumps = false) const {
    mesh::save(folder_ / "sheet.ply", zoo::grid(20, 200.0));
    scene::Scene scene;
    scene.file = folder_ / "scene.toml";
    scene.body.kind = scene::BodyKind::mesh;
    scene.body.file = folder_ / "sheet.ply";
    scene.stiffness.constant_n_per_mm = 8.0;
    scene.fingers.resize(2);
    scene.fingers[0].name = "left";
    scene.fingers[1].name = "right";
    scene.fingers[1].radius_mm = 4.0;
    if (lumps) addLumps(scene);
    const auto world = scene::build(scene);
    trace::RecordingWriter writer(folder_ / name, recordingHeader(1000.0), {{"left", "tapping"}, {"right", "tapping"}});
    servo::RigParts parts;
    parts.solvers = servo::makeSolvers(world->surface, nullptr, 2);
    parts.fingers = fingerSettings(world->scene, 2);
    parts.limiter = servoPlan(world, parts.fingers).limiter;
    parts.devices = {tappingDevice(seed), tappingDevice(seed + 1)};
    servo::Rig rig = servo::rigOf(std::move(parts));
    writer.add(recordingWorld(*world, feltWith(rig)));
    std::vector<trace::Sample> samples(2);
    for (std::uint64_t tick = 0; tick < 12000; ++tick) {
      servo::runTick(rig, tick, servo::LoopEvent::none, samples);
      for (const trace::Sample& sample : samples) writer.add(sample);
    }
    writer.finish("done");
    return folder_ / name;
  }

  void addLumps(scene::Scene& scene) const {
    tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
    scene.tissue.layer_table = folder_ / "back.json";
    scene.lumps.resize(2);
    scene.lumps[0] = {.name = "mobile", .x_mm = 105.0, .y_mm = 108.0, .mobility_mm_per_n = 10.0};
    scene.lumps[1] = {.name = "fixed", .x_mm = 85.0, .y_mm = 95.0};
  }

  /// Every sample of it is proven or told not to be.
  ReplayReport replayed(const std::string& name) const {
    trace::RecordingReader recording(folder_ / name);
    ReplayReport report = replay(recording);
    EXPECT_EQ(report.ticks + report.unproven, recording.facts().samples);
    EXPECT_FALSE(report.first_difference)
        << name << ": tick " << report.first_difference->tick << " of " << report.first_difference->finger << " "
        << report.first_difference->field << " was " << report.first_difference->recorded << ", is "
        << report.first_difference->replayed;
    return report;
  }

  void expectLumpsWhereTheyWere(int rounds) const;
  void expectProvenAfterCuts(int rounds) const;
  void expectProvenAfterJoins(int rounds) const;

  support::TemporaryFolder folder_;
};

/// The same for many more places, so a suite of its own that need not run on every change.
class RecordingEditReplayAtManyPlaces : public RecordingEditReplay {};

TEST_F(RecordingEditReplay, ALumpThatMovesIsWhereItWasWhereverTheRecordingIsCut) { expectLumpsWhereTheyWere(4); }
TEST_F(RecordingEditReplayAtManyPlaces, ALumpThatMovesIsWhereItWasWhereverTheRecordingIsCut) {
  expectLumpsWhereTheyWere(15);
}

TEST_F(RecordingEditReplay, WhereverItIsCutWhatIsSaidToBeProvenIs) { expectProvenAfterCuts(12); }
TEST_F(RecordingEditReplayAtManyPlaces, WhereverItIsCutWhatIsSaidToBeProvenIs) { expectProvenAfterCuts(60); }

TEST_F(RecordingEditReplay, JoinedOnesGiveEveryBit) { expectProvenAfterJoins(3); }
TEST_F(RecordingEditReplayAtManyPlaces, JoinedOnesGiveEveryBit) { expectProvenAfterJoins(10); }

void RecordingEditReplay::expectLumpsWhereTheyWere(int rounds) const {
  trace::RecordingReader recording(record("run.session", 11, true));
  double farthest = 0.0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) farthest = std::max(farthest, sample.contact.lump_moved_mm.norm());
    return true;
  });
  EXPECT_GT(farthest, 0.2);
  EXPECT_EQ(replayed("run.session").unproven, 0u);
  Random random(5);
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t from = 1 + random.below(9000);
    trim(recording, {{from, from + 2500}, round % 2 == 0}, folder_ / "part.session");
    replayed("part.session");
  }
}

void RecordingEditReplay::expectProvenAfterCuts(int rounds) const {
  trace::RecordingReader recording(record("run.session", 1));
  std::uint32_t seen = 0;
  std::uint64_t touching = 0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) {
      seen |= sample.safety;
      touching += sample.contact.touch == contact::Touch::free ? 0 : 1;
    }
    return true;
  });
  for (const std::uint32_t bit : {servo::kDamped, servo::kTooStiff, servo::kTipNotFinite, servo::kSoftened}) {
    EXPECT_NE(seen & bit, 0u) << "what a cut might forget happens: bit " << bit;
  }
  EXPECT_GT(touching, 5000u);
  Random random(3);
  std::uint64_t unproven = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t from = 1 + random.below(9000);
    const trace::TickSpan span{from, from + 2500};
    trim(recording, {span}, folder_ / "part.session");
    EXPECT_EQ(replayed("part.session").unproven, 0u) << "cut at rest, from " << from;
    trim(recording, {span, true}, folder_ / "exact.session");
    const ReplayReport exact = replayed("exact.session");
    EXPECT_GT(exact.ticks, 2000u) << "from " << from;
    unproven += exact.unproven;
  }
  EXPECT_GT(unproven, 17u * static_cast<unsigned>(rounds));
}

void RecordingEditReplay::expectProvenAfterJoins(int rounds) const {
  trace::RecordingReader first(record("a.session", 1));
  trace::RecordingReader second(record("b.session", 5));
  Random random(4);
  for (int round = 0; round < rounds; ++round) {
    trim(first, {{0, 500 + random.below(1000)}}, folder_ / "begin.session");
    const std::uint64_t from = 1 + random.below(9000);
    trim(second, {{from, from + 1000}}, folder_ / "middle.session");
    trim(second, {{from, from + 1000}, true}, folder_ / "exact.session");
    trace::join({folder_ / "begin.session", folder_ / "middle.session", folder_ / "begin.session"},
                folder_ / "all.session");
    EXPECT_EQ(replayed("all.session").unproven, 0u);
    trace::join({folder_ / "begin.session", folder_ / "exact.session", folder_ / "middle.session"},
                folder_ / "all.session");
    EXPECT_EQ(replayed("all.session").unproven, replayed("exact.session").unproven);
  }
}

}  // namespace
}  // namespace palpate::engine
