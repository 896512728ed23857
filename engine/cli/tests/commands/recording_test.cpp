// Recordings from the outside: recorded by `simulate`, felt again by `replay`, listed, exported, read by thirty lines
// of Python.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "palpate/trace/forces_table.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

class RecordingCommands : public testing::Test {
 protected:
  void SetUp() override {
    mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
    std::ofstream(folder_ / "path.csv") << "t_s,x_mm,y_mm,z_mm\n0,0,0,30\n0.5,0,0,15\n1.0,20,0,14\n1.2,20,0,30\n";
  }
  CommandResult palpate(const std::string& arguments) const { return runPalpate(arguments, folder_.path()); }
  void record() const {
    const CommandResult result =
        palpate("simulate dome.obj --trajectory path.csv --trajectory path.csv --radius-mm 4 --no-pictures --session");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  support::TemporaryFolder folder_;
};

TEST_F(RecordingCommands, ARunIsFeltAgainToTheBit) {
  record();
  const CommandResult result = palpate("recording replay results/run.session --verify --json -o again.csv");
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["identical"], true);
  EXPECT_EQ(json["ticks"], 2 * 1201);
  EXPECT_TRUE(json["first_difference"].is_null());
  EXPECT_EQ(contentOf(folder_ / "again.csv"), contentOf(folder_ / "results/forces.csv"));
}

TEST_F(RecordingCommands, SoIsAFingerThatFoundItsOwnWay) {
  ASSERT_EQ(palpate("simulate dome.obj --seconds 1 --no-pictures --session").exit_code, 0);
  EXPECT_EQ(palpate("recording replay results/run.session --verify").exit_code, 0);
}

TEST_F(RecordingCommands, AnotherBodyIsToldAndEndsWithOne) {
  record();
  mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 21.0));
  const CommandResult result = palpate("recording replay results/run.session --verify");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("is not the recorded one"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("different"), std::string::npos);
}

TEST_F(RecordingCommands, ListInfoAndExportSayWhatIsInIt) {
  record();
  const CommandResult list = palpate("recording list");
  EXPECT_NE(list.out.find("results/run.session"), std::string::npos);
  EXPECT_NE(list.out.find("ended: done"), std::string::npos) << list.out;
  const auto info = nlohmann::json::parse(palpate("recording info results/run.session --json").out);
  EXPECT_EQ(info["samples"], 2 * 1201);
  EXPECT_EQ(info["damaged_blocks"], 0);
  EXPECT_EQ(palpate("recording export results/run.session --csv out.csv --json out.json --scene out.toml").exit_code,
            0);
  EXPECT_EQ(contentOf(folder_ / "out.csv"), contentOf(folder_ / "results/forces.csv"));
  EXPECT_EQ(nlohmann::json::parse(contentOf(folder_ / "out.json"))["world_list"].size(), 1u);
  EXPECT_NE(contentOf(folder_ / "out.toml").find("dome.obj"), std::string::npos);
}

TEST_F(RecordingCommands, WrongInputIsOneLineAndExitTwo) {
  std::ofstream(folder_ / "text.session") << "hello";
  record();
  for (const char* arguments :
       {"recording replay none.session", "recording replay text.session",
        "recording replay results/run.session --from 3 --to 2", "recording replay results/run.session --from 99",
        "recording export results/run.session", "recording export text.session --csv a.csv"}) {
    const CommandResult result = palpate(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << ": " << result.err;
  }
  EXPECT_NE(palpate("recording list").out.find("text.session: "), std::string::npos);
}

/// The code of the page.
std::string pythonOfThePage() {
  const std::string page = readFile(support::sourceFolder() / "docs/reference/recordings.md", 1 << 20);
  const std::string fence = "```python\n";
  const std::size_t begin = page.find(fence) + fence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

TEST_F(RecordingCommands, ThirtyLinesOfPythonReadTheSameForces) {
  record();
  std::ofstream(folder_ / "read.py") << pythonOfThePage();
  const auto python = support::runProgram(
      "/bin/sh", "-c \"cd '" + folder_.path().string() + "' && python3 read.py results/run.session 1\"");
  ASSERT_EQ(python.exit_code, 0) << python.err;
  std::istringstream lines(python.out);
  std::size_t rows = 0;
  trace::forEachForcesRow(folder_ / "results/forces.csv", [&](const trace::ForcesRow& row) {
    if (row.finger != "finger_2") return;
    std::uint64_t tick = 0;
    Vec3 force;
    unsigned touch = 0;
    lines >> tick >> force.x() >> force.y() >> force.z() >> touch;
    ASSERT_EQ(tick, rows);
    ASSERT_EQ(force, row.force) << "tick " << tick;
    ASSERT_EQ(touch, static_cast<unsigned>(row.touch));
    ++rows;
  });
  EXPECT_EQ(rows, 1201u);
}

TEST_F(RecordingCommands, RecordWritesWhatIsFeltAndTheMarksThatAreTyped) {
  std::ofstream(folder_ / "type.sh") << "(sleep 0.5; echo 'T6 right'; sleep 0.3; echo) | '" << support::builtProgram()
                                     << "' record dome.obj --seconds 1.5 -o r.session "
                                     << "--notes 'a <test>' --tags 'one two' --json\n";
  const CommandResult result = support::runProgram("/bin/sh", "type.sh", folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["marks"], 2);
  EXPECT_EQ(json["notes"], "a <test>");
  EXPECT_EQ(json["tags"], "one two");
  EXPECT_EQ(json["dropped"], 0);
  EXPECT_GT(json["seconds"].get<double>(), 1.4);
  const CommandResult info = palpate("recording info r.session");
  EXPECT_NE(info.out.find("mark: T6 right"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("mark: mark 2"), std::string::npos) << info.out;
  EXPECT_EQ(palpate("recording replay r.session --verify").exit_code, 0);
  const CommandResult again = palpate("recording new dome.obj --seconds 1 -o r.session");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("already exists"), std::string::npos) << again.err;
}

TEST_F(RecordingCommands, AnnotateAddsWhatSomebodyWantsToSayAndLeavesTheTicksAsTheyAre) {
  record();
  std::ofstream(folder_ / "voice.wav") << "RIFF";
  const CommandResult result = palpate(
      "recording annotate results/run.session --notes new --tags 'a b' --mark 'T6 right@0.5' --mark end@1.2 --attach "
      "voice.wav@0.7 -o more.session");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto info = nlohmann::json::parse(palpate("recording info more.session --json").out);
  EXPECT_EQ(info["notes"], "new");
  EXPECT_EQ(info["tags"], "a b");
  EXPECT_EQ(info["attachments"], 1);
  EXPECT_EQ(info["samples"], 2 * 1201);
  const std::string text = palpate("recording info more.session").out;
  EXPECT_NE(text.find("0.500 s, mark: T6 right"), std::string::npos) << text;
  EXPECT_EQ(palpate("recording replay more.session --verify").exit_code, 0);
  EXPECT_EQ(palpate("recording export more.session --attachments notes").exit_code, 0);
  bool found = false;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "notes")) {
    found = found || (entry.is_regular_file() && contentOf(entry.path()) == "RIFF");
  }
  EXPECT_TRUE(found);
  for (const char* wrong : {"--mark T6", "--mark T6@9", "--mark @1", "--mark T6@nan", "--attach voice.wav",
                            "--attach missing.wav@1", "--attach dome.obj@1", ""}) {
    const CommandResult refused =
        palpate("recording annotate results/run.session -o wrong.session " + std::string(wrong));
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.session"));
  }
  EXPECT_EQ(palpate("recording annotate results/run.session --notes x -o results/run.session").exit_code, 2);
}

TEST_F(RecordingCommands, TheWindowsOwnAreListedFromWhereverTheyAre) {
  record();
  ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
  const CommandResult none = palpate("recording list --window");
  std::filesystem::create_directories(folder_ / "state/palpate/sessions");
  std::filesystem::copy(folder_ / "results/run.session", folder_ / "state/palpate/sessions/a.session");
  const CommandResult list = palpate("recording list --window");
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(list.out.find("sessions/a.session"), std::string::npos) << list.out << list.err;
}

}  // namespace
}  // namespace palpate
