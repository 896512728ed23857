// A signal ends every command in order: recordings are finished, partial results are named as such, and the exit code
// is the one that a shell expects.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/system/fed_program.h"
#include "palpate/mesh/files/save.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/recording_reader.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "support/terminal.h"
#include "support/wait_for.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

class Signals : public testing::Test {
 protected:
  void SetUp() override { mesh::save(folder_ / "dome.ply", zoo::dome({-100.0, -100.0}, 10.0, 20.0)); }

  /// Starts the command in the folder, its output in files there, and sends the signal when it is time.
  int ended(std::vector<std::string> arguments, int signal, const std::function<bool()>& ready) {
    const pid_t child = fork();
    if (child == 0) runInFolder(std::move(arguments));
    const bool came = support::waitFor([&] { return catches(child, signal) && ready(); });
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(came) << (terminal_ ? terminal_->shown() : support::contentOf(folder_ / "err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  [[noreturn]] void runInFolder(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), support::builtProgram());
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    if (chdir(folder_.path().c_str()) != 0) _exit(99);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
    dup2(open("out", O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    dup2(terminal_ ? terminal_->programSide() : open("err", O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    execv(words.front(), words.data());
    _exit(99);
  }

  /// The same with the command's messages on a terminal: the signal comes as soon as they name this work. Seconds until
  /// its end are put into `took_s`.
  int endedDuring(const std::string& work, std::vector<std::string> arguments, double& took_s) {
    terminal_.emplace();
    Clock::time_point asked;
    const int end = ended(std::move(arguments), SIGINT, [&] {
      asked = Clock::now();
      return terminal_->shown().find(work) != std::string::npos;
    });
    took_s = secondsSince(asked);
    terminal_.reset();
    return end;
  }

  /// Whether the process has taken the signal over: before that it ends as every process does. SIGKILL cannot be
  /// caught.
  static bool catches(pid_t process, int signal) {
    if (signal == SIGKILL) return true;
    const std::string status = support::contentOf("/proc/" + std::to_string(process) + "/status");
    const std::size_t caught = status.find("SigCgt:");
    if (caught == std::string::npos) return false;
    return (std::stoull(status.substr(caught + 7), nullptr, 16) >> (signal - 1) & 1) != 0;
  }

  bool hasBytes(const std::string& name) const {
    std::error_code error;
    const auto size = fs::file_size(folder_ / name, error);
    return !error && size > 0;
  }
  nlohmann::json report() const { return nlohmann::json::parse(support::contentOf(folder_ / "results/report.json")); }

  support::TemporaryFolder folder_;
  std::optional<support::Terminal> terminal_;  ///< for messages, instead of the file "err"
};

/// A suite of its own: studies need not run on every change.
class SignalsToStudies : public Signals {};

TEST_F(Signals, ASimulationKeepsWhatItHasAndSaysThatItIsAPart) {
  for (const auto& [signal, name, code] :
       {std::tuple(SIGINT, "SIGINT", 130), std::tuple(SIGTERM, "SIGTERM", 143), std::tuple(SIGHUP, "SIGHUP", 129)}) {
    SCOPED_TRACE(name);
    fs::remove_all(folder_ / "results");
    const int end = ended({"simulate", "--mesh", "dome.ply", "--seconds", "2000", "--out", "results"}, signal,
                          [&] { return hasBytes("results/forces.csv.partial"); });
    EXPECT_EQ(end, code) << support::contentOf(folder_ / "err");
    EXPECT_EQ(report()["complete"], false);
    EXPECT_EQ(report()["ended_by"], name);
    EXPECT_LT(report()["duration_s"].get<double>(), 2000.0);
    EXPECT_EQ(report()["planned_s"], 2000.0);
    const auto fingers = trace::readForcesTable(folder_ / "results/forces.csv");
    EXPECT_EQ(fingers.front().time_s.size(), report()["ticks"].get<std::size_t>()) << "every tick has its row";
    EXPECT_FALSE(fs::exists(folder_ / "results/forces.csv.partial"));
    EXPECT_FALSE(fs::exists(folder_ / "results/pictures.png")) << "nobody waits for pictures";
  }
}

/// A window that runs a class starts such programs; it may crash, or be killed.
TEST_F(Signals, AProgramThatAnotherHasStartedEndsInOrderWithIt) {
  const pid_t starter = fork();
  if (starter == 0) {
    if (chdir(folder_.path().c_str()) != 0) _exit(99);
    ::signal(SIGINT, SIG_IGN);  // as a shell in a script does for what it lets run beside it
    const system::FedProgram program(support::builtProgram(), {"palpate", "simulate", "--mesh", "dome.ply", "--seconds",
                                                               "2000", "--out", "results"});
    for (;;) pause();
  }
  EXPECT_TRUE(support::waitFor([&] { return hasBytes("results/forces.csv.partial"); }));
  kill(starter, SIGKILL);
  waitpid(starter, nullptr, 0);
  ASSERT_TRUE(support::waitFor([&] { return hasBytes("results/report.json"); }));
  EXPECT_EQ(report()["ended_by"], "SIGTERM");
}

TEST_F(Signals, AProgramThatAnotherHasStartedHearsThatItShallEnd) {
  const auto before = ::signal(SIGINT, SIG_IGN);
  const std::string out = (folder_ / "results").string();
  system::FedProgram program(support::builtProgram(), {"palpate", "simulate", "--mesh", (folder_ / "dome.ply").string(),
                                                       "--seconds", "2000", "--out", out});
  ::signal(SIGINT, before);
  ASSERT_TRUE(support::waitFor([&] { return hasBytes("results/forces.csv.partial"); }));
  program.sendInterrupt();
  EXPECT_EQ(program.finish().how, "exit code 130");
}

TEST_F(Signals, SoDoesOneAgainstTheClock) {
  const int end = ended({"simulate", "--mesh", "dome.ply", "--seconds", "100", "--realtime", "--out", "results"},
                        SIGTERM, [&] { return hasBytes("results/forces.csv.partial"); });
  EXPECT_EQ(end, 143);
  EXPECT_EQ(report()["ended_by"], "SIGTERM");
  EXPECT_GT(trace::readForcesTable(folder_ / "results/forces.csv").front().time_s.size(), 10u);
}

TEST_F(Signals, ASeriesOfPicturesEndsWithAWholePicture) {
  const int end = ended({"render", "--mesh", "dome.ply", "--seconds", "200", "--at", "0", "--frames", "4000", "--size",
                         "64x48", "--json"},
                        SIGTERM, [&] { return fs::exists(folder_ / "picture_0003.png"); });
  EXPECT_EQ(end, 143) << support::contentOf(folder_ / "err");
  const auto json = nlohmann::json::parse(support::contentOf(folder_ / "out"));
  EXPECT_EQ(json["complete"], false);
  const std::size_t drawn = json["pictures"].size();
  EXPECT_GE(drawn, 3u);
  EXPECT_TRUE(fs::exists(folder_ / json["pictures"].back()["file"].get<std::string>()));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
  }
}

TEST_F(SignalsToStudies, AHuntTellsWhatItHasFoundSoFar) {
  if (!support::hasProgramOf("study")) GTEST_SKIP() << "not built";
  const int end = ended({"study", "hunt", "--seconds", "1000", "--threads", "2", "--json"}, SIGINT,
                        [&] { return support::contentOf(folder_ / "err").find("hunting") != std::string::npos; });
  EXPECT_EQ(end, 130);
  const auto json = nlohmann::json::parse(support::contentOf(folder_ / "out"));
  EXPECT_EQ(json["complete"], false);
  EXPECT_EQ(json["ended_by"], "SIGINT");
  EXPECT_GT(json["ticks"], 0);
}

TEST_F(SignalsToStudies, AStudyOfAllBindsTheChaptersThatAreDone) {
  if (!support::hasProgramOf("study")) GTEST_SKIP() << "not built";
  const int end = ended({"study", "all", "--quick", "--out", "book"}, SIGTERM,
                        [&] { return fs::exists(folder_ / "book/numbers.md"); });
  EXPECT_EQ(end, 143);
  EXPECT_NE(support::contentOf(folder_ / "book/report.html").find("This run was ended early: "), std::string::npos);
}

TEST_F(SignalsToStudies, WhatHasNothingToFinishEndsAtOnce) {
  if (!support::hasProgramOf("study")) GTEST_SKIP() << "not built";
  const Clock::time_point began = Clock::now();
  const int end = ended({"study", "bench", "servo", "--mesh", "dome.ply", "--seconds", "300"}, SIGTERM,
                        [&] { return secondsSince(began) > 0.5; });
  EXPECT_EQ(end, 143);
  EXPECT_LT(secondsSince(began), 60.0);
}

/// A body of a million triangles takes seconds.
TEST_F(Signals, WhoStillBuildsItsBodyEndsAtOnce) {
  setenv("PALPATE_BODY_CACHE_MB", "0", 1);  // a kept body is there at once
  const std::string scene =
      "[body]\nkind = \"trunk\"\ntriangles = 400000\n[[finger]]\nname = \"a\"\nat = \"T6\"\n"
      "script = [{ do = \"press\", depth_mm = 4, seconds = 0.1 }]\n";
  std::ofstream(folder_ / "large.toml") << scene;
  for (const std::vector<std::string>& command : {std::vector<std::string>{"simulate", "large.toml", "--out", "made"},
                                                  {"recording", "new", "large.toml", "--out", "made.session"}}) {
    SCOPED_TRACE(command.front());
    double took_s = 0.0;
    EXPECT_EQ(endedDuring("building the ", command, took_s), 130);
    EXPECT_LT(took_s, 1.0);
    EXPECT_FALSE(fs::exists(folder_ / "made") || fs::exists(folder_ / "made.session"));
  }
  unsetenv("PALPATE_BODY_CACHE_MB");
}

/// The same for what contact needs of a mesh file: tree, sides, deformable skin.
TEST_F(Signals, WhoStillPreparesTheSkinOfALargeMeshEndsAtOnce) {
  mesh::save(folder_ / "large.ply", zoo::grid(900, 300.0));
  double took_s = 0.0;
  EXPECT_EQ(endedDuring("building the contact surface", {"simulate", "--mesh", "large.ply", "--out", "made"}, took_s),
            130);
  EXPECT_LT(took_s, 1.0);
  EXPECT_FALSE(fs::exists(folder_ / "made"));
}

TEST_F(Signals, ARunThatWasKilledLeavesAPartThatIsExplainedAndNeverOverwritten) {
  const std::vector<std::string> run = {"simulate", "--mesh", "dome.ply", "--seconds", "2000", "--out", "results"};
  EXPECT_EQ(ended(run, SIGKILL, [&] { return hasBytes("results/forces.csv.partial"); }), -SIGKILL);
  const std::string part = support::contentOf(folder_ / "results/forces.csv.partial");
  const auto told = support::runPalpate("recording info results/forces.csv.partial", folder_.path());
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.out.find("unfinished"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("palpate run --replay results/forces.csv.partial"), std::string::npos) << told.out;
  const auto json = nlohmann::json::parse(
      support::runPalpate("recording info --json results/forces.csv.partial", folder_.path()).out);
  EXPECT_EQ(json["complete"], false);
  EXPECT_GT(json["fingers"][0]["rows"], 0);
  const auto again =
      support::runPalpate("simulate --mesh dome.ply --seconds 0.1 --no-pictures --out results", folder_.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(support::contentOf(folder_ / "results/forces.csv.partial"), part);
}

TEST_F(Signals, ATableThatCannotBeReplayedOpensNoWindow) {
  const auto missing = support::runPalpate("run --replay nothing.csv", folder_.path());
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err, "palpate: nothing.csv: no such file\n");
  std::ofstream(folder_ / "other.csv") << "a,b\n1,2\n";
  const auto other = support::runPalpate("run --replay other.csv", folder_.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(other.err, "palpate: other.csv:1: must be a table of forces; its columns differ\n");
}

TEST_F(Signals, ARecordingIsFinishedAndProven) {
  for (const auto& [signal, name, code] :
       {std::tuple(SIGINT, "SIGINT", 130), std::tuple(SIGTERM, "SIGTERM", 143), std::tuple(SIGHUP, "SIGHUP", 129)}) {
    SCOPED_TRACE(name);
    const auto written = [&] {
      std::error_code error;
      return fs::file_size(folder_ / "run.session.partial-wal", error) > 150'000 && !error;
    };
    EXPECT_EQ(ended({"recording", "new", "dome.ply", "--seconds", "600", "--overwrite", "-o", "run.session"}, signal,
                    written),
              code);
    const auto info = nlohmann::json::parse(
        support::runPalpate("recording info run.session --json", folder_.path()).out, nullptr, false);
    ASSERT_FALSE(info.is_discarded());
    EXPECT_EQ(info["ended_by"], name);
    EXPECT_EQ(support::runPalpate("recording replay run.session --verify", folder_.path()).exit_code, 0);
  }
}

TEST_F(Signals, ARecordingThatIsKilledKeepsWhatWasWrittenAndRepairFinishesIt) {
  const auto much = [&] {
    std::error_code error;
    return fs::file_size(folder_ / "run.session.partial-wal", error) > 200'000 && !error;
  };
  EXPECT_EQ(ended({"recording", "new", "dome.ply", "--seconds", "600", "-o", "run.session"}, SIGKILL, much), -SIGKILL);
  EXPECT_FALSE(fs::exists(folder_ / "run.session"));
  EXPECT_EQ(support::runPalpate("recording replay run.session.partial --verify", folder_.path()).exit_code, 0);
  EXPECT_EQ(support::runPalpate("recording repair run.session.partial -o mended.session", folder_.path()).exit_code, 0);
  EXPECT_EQ(support::runPalpate("recording replay mended.session --verify", folder_.path()).exit_code, 0);
}

TEST_F(Signals, ARecordingOverALumpThatMovesIsFeltAgainToTheBitAfterItWasKilled) {
  tissue::writeLayeredTable(folder_ / "back.json", test::inventedTable());
  std::ofstream(folder_ / "scene.toml")
      << "[body]\nkind = \"mesh\"\nfile = \"dome.ply\"\n[stiffness]\nconstant_n_per_mm = 8\n[tissue]\nlayer_table = "
         "\"back.json\"\n[[lump]]\ny_mm = 6\ndepth_mm = 5\nyoung_kpa = 200\nmobility_mm_per_n = 20\n[[finger]]\nname = "
         "\"index\"\nradius_mm = 8\npad = 4\nscript = [{ do = \"lift\", seconds = 1 }, { do = \"press\", depth_mm = 6, "
         "seconds = 0.1 }, { do = \"circle\", radius_mm = 8, turns = 900, seconds = 600 }]\n";
  const auto much = [&] {
    std::error_code error;
    return fs::file_size(folder_ / "run.session.partial-wal", error) > 500'000 && !error;
  };
  EXPECT_EQ(ended({"recording", "new", "scene.toml", "-o", "run.session"}, SIGKILL, much), -SIGKILL);
  const auto palpate = [&](const std::string& words) { return support::runPalpate(words, folder_.path()).exit_code; };
  EXPECT_EQ(palpate("recording replay run.session.partial --verify"), 0);
  EXPECT_EQ(palpate("recording export run.session.partial --pressure 4 --npz part.npz"), 0);
  EXPECT_EQ(palpate("recording repair run.session.partial -o mended.session"), 0);
  EXPECT_EQ(palpate("recording replay mended.session --verify"), 0);
  EXPECT_EQ(palpate("recording export mended.session --pressure 4 --npz mended.npz"), 0);
  const std::string arrays = support::contentOf(folder_ / "mended.npz");
  EXPECT_GT(arrays.size(), 10'000u);
  EXPECT_EQ(support::contentOf(folder_ / "part.npz"), arrays);
  // That the lump moved at all is in the recording.
  trace::RecordingReader recording(folder_ / "mended.session");
  double farthest_mm = 0.0;
  recording.forEachTick({}, [&](std::span<const trace::Sample> samples) {
    farthest_mm = std::max(farthest_mm, samples.front().contact.lump_moved_mm.norm());
    return true;
  });
  EXPECT_GT(farthest_mm, 0.05);
}

}  // namespace
}  // namespace palpate
