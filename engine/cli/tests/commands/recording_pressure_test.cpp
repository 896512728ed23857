// The pressure under the fingers of a recording: exported, and after a kill, a replay and a bundle still the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/engine/felt_pressure.h"
#include "palpate/engine/recorded_pressure.h"
#include "palpate/mesh/files/save.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

/// Two fingers on a dome, one of them over a lump that moves.
class RecordedLumps : public testing::Test {
 protected:
  void SetUp() override {
    mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
    tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
    std::ofstream(folder_ / "scene.toml") << R"(
[body]
kind = "mesh"
file = "dome.obj"
[stiffness]
constant_n_per_mm = 8
[tissue]
layer_table = "back.json"
[[lump]]
name = "mobile"
y_mm = 6
depth_mm = 5
young_kpa = 200
mobility_mm_per_n = 20
[[lump]]
name = "fixed"
x_mm = 30
depth_mm = 5
stiffness_ratio = 8
[[finger]]
name = "index"
radius_mm = 8
pad = 4
script = [{ do = "press", depth_mm = 6, seconds = 0.3 }, { do = "circle", radius_mm = 8, seconds = 0.5 }, { do = "lift", seconds = 0.1 }]
[[finger]]
name = "middle"
at_mm = [24, 0]
radius_mm = 6
script = [{ do = "press", depth_mm = 5, seconds = 0.3 }, { do = "drag", by_mm = [8, 0], seconds = 0.6 }]
)";
  }
  CommandResult palpate(const std::string& arguments) const { return runPalpate(arguments, folder_.path()); }
  void succeeds(const std::string& arguments) const {
    const CommandResult result = palpate(arguments);
    ASSERT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
  }
  void simulate() const { succeeds("simulate scene.toml --no-pictures --no-plot --session"); }
  bool isIdentical(const std::string& file) const {
    const CommandResult result = palpate("recording replay " + file + " --verify --json");
    const auto json = nlohmann::json::parse(result.out, nullptr, false);
    return result.exit_code == 0 && json["identical"] == true;
  }
  support::TemporaryFolder folder_;
};

TEST_F(RecordedLumps, ThePatternsAreThoseOfWhatWasFeltToTheBit) {
  simulate();
  trace::RecordingReader recording(folder_ / "results/run.session");
  const contact::PressurePad pad{4, 16.0};
  engine::ReplaySettings settings;
  settings.folder = folder_.path();
  const engine::RecordedPressure pressure = engine::recordedPressure(recording, settings, pad);
  EXPECT_TRUE(pressure.replay.identical());
  ASSERT_EQ(pressure.kpa.size(), 2u);
  // Straight from the recorded samples; what they lack of the place is in the skin.
  const engine::FeltPressure felt(engine::builtWorld(recording.world(0), folder_.path()));
  std::vector<double> kpa(16);
  std::vector<std::size_t> next(2, 0);
  std::size_t moved = 0, bumps = 0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) {
      contact::FingerOutput whole = sample.contact;
      whole.finger_mm = sample.finger == 0 ? 8.0 : 6.0;
      whole.tissue_mm = 0.0;  // one stack: its patterns are the same everywhere
      felt.at(whole, sample.tick, pad, kpa);
      for (const double taxel : kpa) {
        EXPECT_EQ(pressure.kpa[sample.finger].at(next[sample.finger]++), static_cast<float>(taxel)) << sample.tick;
      }
      moved += sample.contact.lump_moved_mm.norm() > 0.05 ? 1 : 0;
      bumps += sample.contact.lump_share > 0.005 ? 1 : 0;
    }
    return !testing::Test::HasFailure();
  });
  EXPECT_EQ(next[0], pressure.kpa[0].size());
  EXPECT_GT(moved, 100u) << "the lump must have moved, or nothing is tested";
  EXPECT_GT(bumps, 300u);
}

TEST_F(RecordedLumps, AreExportedForNumPyAndAsColumnsOfATable) {
  simulate();
  succeeds("recording export results/run.session --pressure 4 --npz run.npz --csv run.csv --from 0.1 --to 0.7");
  succeeds("recording export results/run.session --pressure 4 --npz again.npz --from 0.1 --to 0.7");
  EXPECT_EQ(contentOf(folder_ / "run.npz"), contentOf(folder_ / "again.npz"));
  std::ofstream(folder_ / "read.py") << R"(
import ast, csv, struct, zipfile
with zipfile.ZipFile('run.npz') as npz:
    def array(name):
        data = npz.read(name + '.npy')
        size = struct.unpack('<H', data[8:10])[0]
        head = ast.literal_eval(data[10:10 + size].decode('latin1'))
        code = {'<f8': 'd', '<u8': 'Q', '<u4': 'I', '<f4': 'f'}[head['descr']]
        return head['shape'], struct.unpack('<%d%s' % ((len(data) - 10 - size) // struct.calcsize(code), code), data[10 + size:])
    for name in ('index', 'middle'):
        shape, kpa = array(name + '.pressure_kpa')
        assert shape == (601, 4, 4), shape
        force = [array(name + '.force_%s_n' % axis)[1] for axis in 'xyz']
        normal = [array(name + '.normal_' + axis)[1] for axis in 'xyz']
        rows = [row for row in csv.DictReader(open('run.csv')) if row['finger'] == name]
        assert len(rows) == 601
        for i in range(601):
            newton = sum(kpa[16 * i:16 * i + 16]) * 16 / 1000
            wanted = sum(f[i] * n[i] for f, n in zip(force, normal))
            assert abs(newton - wanted) < 1e-5, (name, i, newton, wanted)
            for taxel in range(16):
                cell = rows[i]['pressure_%d_%d_kpa' % (taxel // 4 + 1, taxel % 4 + 1)]
                assert struct.pack('<f', float(cell)) == struct.pack('<f', kpa[16 * i + taxel]), (name, i, taxel)
        assert max(kpa) > 5, max(kpa)
)";
  const auto python = support::runProgram("/bin/sh", "-c \"cd '" + folder_.path().string() + "' && python3 read.py\"");
  EXPECT_EQ(python.exit_code, 0) << python.err;
}

TEST_F(RecordedLumps, AreKeptByABundle) {
  simulate();
  succeeds("recording bundle results/run.session --folder . -o away.session");
  std::filesystem::remove(folder_ / "dome.obj");
  std::filesystem::rename(folder_ / "back.json", folder_ / "elsewhere.json");
  EXPECT_TRUE(isIdentical("away.session")) << "the lumps and the layers that they lie in went with it";
  succeeds("recording export away.session --pressure 8 --pad-mm 20 --npz away.npz");
  succeeds("recording export away.session --scene away.toml");
  EXPECT_NE(contentOf(folder_ / "away.toml").find("name = \"mobile\""), std::string::npos);
  std::filesystem::rename(folder_ / "elsewhere.json", folder_ / "back.json");
  SetUp();
  succeeds("recording export results/run.session --pressure 8 --pad-mm 20 --npz here.npz");
  EXPECT_EQ(contentOf(folder_ / "away.npz"), contentOf(folder_ / "here.npz"));
}

TEST_F(RecordedLumps, WhatMakesNoSenseIsRefusedInOneLine) {
  simulate();
  const auto said = [&](const std::string& options) {
    const CommandResult result = palpate("recording export results/run.session " + options);
    EXPECT_EQ(result.exit_code, 2) << options;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  EXPECT_NE(said("--pressure 1 --npz a.npz").find("--pressure"), std::string::npos);
  EXPECT_NE(said("--pressure 17 --npz a.npz").find("2 to 16"), std::string::npos);
  EXPECT_NE(said("--pressure 4 --pad-mm 0 --npz a.npz").find("1 to 100"), std::string::npos);
  EXPECT_NE(said("--pressure 4 --scene a.toml").find("--npz FILE or --csv FILE"), std::string::npos);
  EXPECT_NE(said("--pad-mm 20 --npz a.npz").find("--pressure"), std::string::npos);
  std::ofstream(folder_ / "path.csv") << "t_s,x_mm,y_mm,z_mm\n0,0,0,40\n0.2,0,0,15\n";
  succeeds("simulate dome.obj --trajectory path.csv --no-pictures --no-plot --session --out plain");
  const CommandResult plain = palpate("recording export plain/run.session --pressure 4 --npz a.npz");
  EXPECT_EQ(plain.exit_code, 2);
  EXPECT_NE(plain.err.find("layered tissue"), std::string::npos) << plain.err;
}

}  // namespace
}  // namespace palpate
