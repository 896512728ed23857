// Every command that writes, on a disk that is too small: it says which file and why, ends with exit code 2 and leaves
// the earlier file as it was. A tmpfs of some sizes where one may be mounted, and everywhere a limit on a file's size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "palpate/mesh/files/save.h"
#include "palpate/trace/forces_csv.h"
#include "palpate/trace/forces_table.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEarlier = "what was there before\n";
constexpr int kNoMount = 77;  ///< exit code

struct WritingCommand {
  std::string arguments;  ///< the disk is the folder `disk`
  std::string file;       ///< in it: what is written first and too large for the smallest disk
};

/// A row for each command that writes and each way in which it writes.
const std::vector<WritingCommand> kCommands = {
    {"render --mesh dome.ply --size 320x240 --supersampling 1 -o disk/picture.png", "picture.png"},
    {"render --mesh dome.ply --size 320x240 --supersampling 1 --at 0 --frames 2 -o disk/film.png", "film_0001.png"},
    {"render --mesh dome.ply --size 320x240 --supersampling 1 --at 0 --frames 2 -o disk/film.webm", "film.webm"},
    {"render --mesh dome.ply --size 320x240 --supersampling 1 --at 0 --frames 2 -o disk/film.gif", "film.gif"},
    {"simulate --mesh dome.ply --trajectory path.csv --no-pictures --overwrite --out disk", "forces.csv"},
    {"simulate quiet.toml --overwrite --out disk", "surface_deepest.ply"},
    {"body map ellipses dome.ply -o disk/map.csv", "map.csv"},
    {"body map ellipses dome.ply -o disk/map.ply", "map.ply"},
    {"body map ellipses dome.ply -o disk/map.png", "map.png"},
    {"body map ellipses dome.ply -o disk/map.svg", "map.svg"},
    {"measure dots dots.csv --overwrite -o disk", "overlay.png"},
    {"body make back --triangles 2000 -o disk/back.ply", "back.ply"},
    {"body make back --triangles 2000 -o disk/back.obj", "back.obj"},
    {"body make back --triangles 2000 -o disk/back.stl", "back.stl"},
    {"body repair dome.ply -o disk/mended.ply", "mended.ply"},
    {"simulate quiet.toml --no-pictures --no-plot --session --overwrite -o disk", "run.session"},
    {"recording plot forces.csv -o disk/plot.png", "plot.png"},
    {"recording plot forces.csv -o disk/plot.svg", "plot.svg"},
};
/// The same of the studies, which need not run on every change.
const std::vector<WritingCommand> kStudies = {
    {"study partition dome.ply --threshold 64 --leaf-colours disk/leaves.ply", "leaves.ply"},
    {"study partition dome.ply --threshold 64 --box 0,0,5,20 --selection disk/box.ply", "box.ply"},
    {"study partition dome.ply --threshold 64 -o disk/leaves.png", "leaves.png"},
    {"study bench workload pit -o disk/path.csv", "path.csv"},
    {"study numbers --out disk", "numbers.md"},
    {"study figures --only 4.8 --out disk", "figure_4_8.png"},
    {"study profile --quick --out disk", "profile_sweep.png"},
};

class FullDisk : public testing::TestWithParam<WritingCommand> {
 protected:
  void SetUp() override {
    if (!support::hasProgramOf(GetParam().arguments)) GTEST_SKIP() << "not built";
    mesh::save(folder_ / "dome.ply", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
    std::ofstream(folder_ / "quiet.toml") << "[body]\nkind = \"mesh\"\nfile = \"dome.ply\"\n[output]\nforces = false\n"
                                             "[[finger]]\nname = \"a\"\nat_mm = [0, 0]\n"
                                             "script = [{ do = \"press\", depth_mm = 4, seconds = 0.1 }]\n";
    writeForces();
    writeDots();
    std::ofstream(folder_ / "path.csv") << "t_s,x_mm,y_mm,z_mm\n0,0,0,30\n0.3,0,0,15\n";
  }

  /// A stencil's dots, dragged upwards by a half Gaussian; 40 px are 30 mm.
  void writeDots() const {
    std::ofstream table(folder_ / "dots.csv");
    table << "picture,x_px,y_px\n";
    for (int i = 0; i < 11 * 13; ++i) {
      const int row = i / 11;
      const double x = 40.0 * (i % 11 - 5);
      const double y = 40.0 * (row - 6);
      const double up = 24.0 * std::exp(-(x * x + 0.8 * y * y) / 4900.0);
      table << "before," << 300.0 + x << ',' << 400.0 + y << "\nafter," << 300.0 + x << ',' << 400.0 + y - up << '\n';
    }
  }

  /// Half a second of a finger that touches nothing.
  void writeForces() const {
    std::string text = std::string(trace::forcesCsvHeader()) + "\n";
    trace::ForcesCsvSettings settings;
    settings.finger_names = {"a"};
    for (std::uint64_t tick = 0; tick < 500; ++tick) {
      trace::Sample sample;
      sample.tick = tick;
      trace::appendForcesRow(text, settings, sample);
    }
    std::ofstream(folder_ / "forces.csv") << text;
  }

  /// Runs the command with `disk` prepared by these lines of shell; its exit code, and what is on the disk afterwards.
  support::CommandResult runOn(const std::string& prepare, const std::string& limit) const {
    std::ofstream(folder_ / "script.sh") << "rm -rf disk after; mkdir disk\n"
                                         << prepare << "printf '"
                                         << "what was there before\\n"
                                         << "' > disk/" << GetParam().file << "\n(" << limit << "exec '"
                                         << support::builtProgram() << "' " << GetParam().arguments
                                         << " > /dev/null)\ncode=$?\ncp -r disk after\nexit $code\n";
    return support::runProgram("/usr/bin/env", (prepare.empty() ? "" : "unshare -m ") + std::string("sh script.sh"),
                               folder_.path());
  }

  void expectACleanFailure(const support::CommandResult& end, const std::string& cause) const {
    EXPECT_EQ(end.exit_code, 2) << end.out << end.err;
    EXPECT_NE(end.err.find("disk/" + GetParam().file + ": cannot be written: " + cause + "\n"), std::string::npos)
        << end.err;
    EXPECT_EQ(support::contentOf(folder_ / ("after/" + GetParam().file)), kEarlier);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "after")) {
      EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
    }
  }

  support::TemporaryFolder folder_;
};

class DiskOfThreeSizes : public FullDisk {};

TEST_P(DiskOfThreeSizes, LeavesTheEarlierFileAndSaysSo) {
  const support::CommandResult nothing =
      runOn("mount -t tmpfs -o size=4k palpate disk || exit " + std::to_string(kNoMount) + "\n", "");
  if (nothing.exit_code == kNoMount || nothing.err.find("unshare") != std::string::npos) {
    GTEST_SKIP() << "no tmpfs may be mounted here: " << nothing.err;
  }
  expectACleanFailure(nothing, "No space left on device");
  for (const char* size : {"64k", "16m"}) {
    SCOPED_TRACE(size);
    const auto end = runOn("mount -t tmpfs -o size=" + std::string(size) + " palpate disk\n", "");
    const std::string now = support::contentOf(folder_ / ("after/" + GetParam().file));
    if (end.exit_code == 0) {
      EXPECT_NE(now, kEarlier);
      return;  // there is room
    }
    EXPECT_EQ(end.exit_code, 2) << end.out << end.err;
    EXPECT_NE(end.err.find("disk/"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find(": cannot be written: No space left on device\n"), std::string::npos) << end.err;
    if (end.err.find("/" + GetParam().file + ":") != std::string::npos) {
      EXPECT_EQ(now, kEarlier);
    }
  }
  ADD_FAILURE() << "does not succeed with 16 MB either";
}

/// In blocks of 512 bytes, as sh counts.
TEST_P(FullDisk, LeavesTheEarlierFileWhereOneMayNotGrow) {
  expectACleanFailure(runOn("", "ulimit -f 2; "), "File too large");
}

std::string nameOfRow(const testing::TestParamInfo<WritingCommand>& of) {
  std::string name = of.param.arguments.substr(0, of.param.arguments.find(' ')) + "_" + of.param.file;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Commands, FullDisk, testing::ValuesIn(kCommands), nameOfRow);
INSTANTIATE_TEST_SUITE_P(Studies, FullDisk, testing::ValuesIn(kStudies), nameOfRow);
INSTANTIATE_TEST_SUITE_P(Commands, DiskOfThreeSizes, testing::ValuesIn(kCommands), nameOfRow);
INSTANTIATE_TEST_SUITE_P(Studies, DiskOfThreeSizes, testing::ValuesIn(kStudies), nameOfRow);

/// What is told of the progress once went into the first file that was opened. 600 s take long enough to be told of.
TEST(StandardOutputOfALongRun, ThatWasClosedAtTheStartIsNoFile) {
  const support::TemporaryFolder folder;
  const auto end =
      support::runProgram("/bin/sh",
                          "-c \"'" + support::builtProgram() +
                              "' simulate --preset vhb --seconds 600 --no-pictures --no-plot --out results 2>&-\"",
                          folder.path());
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_EQ(trace::readForcesTable(folder / "results/forces.csv").front().time_s.size(), 600000u);
}

TEST(StandardOutput, ThatWasClosedAtTheStartIsTold) {
  const auto end = support::runProgram("/bin/sh", "-c \"'" + support::builtProgram() + "' run --keys >&-\"");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.err, "palpate: standard output: cannot be written: Bad file descriptor\n");
}

/// By the exit code: what is said of it goes into a file too, here, which may not grow either.
TEST(StandardOutput, ThatMayNotGrowEndsNoProgramInTheMiddle) {
  const support::TemporaryFolder folder;
  const auto end = support::runProgram(
      "/bin/sh", "-c \"ulimit -f 0; '" + support::builtProgram() + "' run --keys > keys.txt\"", folder.path());
  EXPECT_EQ(end.exit_code, 2);
}

/// How much is enough differs from machine to machine; below it stands the same line everywhere.
TEST(MemoryThatRanOut, IsSaidInOneLine) {
  const support::TemporaryFolder folder;
  const std::string press = "'" + support::builtProgram() + "' simulate --seconds 0.1 --no-pictures --no-plot";
  int refused = 0;
  for (const int kilobytes : {40'000, 60'000, 80'000, 100'000}) {
    const auto end = support::runProgram(
        "/bin/sh", "-c \"ulimit -v " + std::to_string(kilobytes) + "; " + press + " --overwrite --out results\"",
        folder.path());
    if (end.exit_code == 0 || end.exit_code == 127) continue;  // enough, or too little for its libraries
    ++refused;
    EXPECT_EQ(end.exit_code, 2) << kilobytes;
    EXPECT_EQ(end.err, "palpate: memory ran out\n") << kilobytes;
  }
  EXPECT_GT(refused, 0);
}

TEST(StandardOutput, ThatCannotBeWrittenIsToldToo) {
  const auto end = support::runProgram("/bin/sh", "-c \"'" + support::builtProgram() + "' run --keys > /dev/full\"");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.err, "palpate: standard output: cannot be written: No space left on device\n");
}

}  // namespace
}  // namespace palpate
