// `palpate study bench load`, `edit`, `servo`, `contact --tool` and `palpate study bench recording` from the outside.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "support/timed.h"

namespace palpate {
namespace {

using support::runPalpate;
using support::TemporaryFolder;

TEST(BenchLoadCommand, SplitsTheWayFromAFileToAForce) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "back.stl").string();
  ASSERT_EQ(runPalpate("study bench workload back_2962 -o " + file).exit_code, 0);
  const auto result = runPalpate("study bench load " + file + " --peers --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["triangles"], 2962);
  EXPECT_GT(json["first_force_n"].get<double>(), 0.0);
  EXPECT_GT(json["peak_memory_gb"].get<double>(), 0.0);
  double sum = 0.0;
  for (const auto& step : json["steps"]) sum += step["seconds"].get<double>();
  EXPECT_GT(sum, 0.0);
  EXPECT_LE(sum, json["seconds"].get<double>());
  EXPECT_GT(json["tree_bytes_per_triangle"].get<double>(), 96.0) << "a record alone has so many";
  EXPECT_GT(json["change_ms"].get<double>(), 0.0);
  EXPECT_GT(json["peers"]["assimp"]["seconds"].get<double>(), 0.0);
  EXPECT_GT(json["ratio_to"]["assimp"].get<double>(), 0.0);
  EXPECT_FALSE(json["machine"]["cpu"].get<std::string>().empty());
}

TEST(BenchLoadCommand, TakesTheNameOfABenchmarkMesh) {
  const auto named = nlohmann::json::parse(runPalpate("study bench load back_2962 --json").out);
  const auto again = nlohmann::json::parse(runPalpate("study bench load back_2962 --json").out);
  EXPECT_EQ(named["file"], "back_2962");
  EXPECT_EQ(named["hash"], again["hash"]);
}

bool givesHugePagesOnRequest() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string said;
  std::getline(file, said);
  return said.find("[madvise]") != std::string::npos || said.find("[always]") != std::string::npos;
}

// Page by page a body of this size takes 60,000 faults and more: its records alone are 96 MB.
TEST(BenchLargeLoad, TakesItsArraysInHugePages) {
  if (!givesHugePagesOnRequest()) GTEST_SKIP() << "this system gives no huge pages";
  const auto json = nlohmann::json::parse(runPalpate("study bench load back_1000000 --json").out);
  const double small_pages = json["peak_memory_gb"].get<double>() * 1e9 / 4096.0;
  EXPECT_GT(small_pages, 60'000.0);
  EXPECT_LT(json["page_faults"].get<double>(), 0.6 * small_pages);
}

TEST(BenchLoadCommand, RefusesAnUnknownName) {
  const auto result = runPalpate("study bench load nonsense");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("nonsense"), std::string::npos) << result.err;
}

TEST(BenchContactCommand, TouchesWithATool) {
  const std::string slide = "study bench contact --mesh back_2962 --trajectory back_slide --from 2 --to 3 ";
  const auto result = runPalpate(slide + "--tool head --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["pads"], 33);
  EXPECT_GT(json["ticks"].get<int>(), 500);
  EXPECT_GT(json["tick_us"]["p50"].get<double>(), 0.0);
  EXPECT_EQ(json["different"], 0) << "each pad feels what a finger alone would";
  EXPECT_EQ(json["wrench"]["force_n"].size(), 3u);
  const auto unknown = runPalpate(slide + "--tool hoof");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("hoof"), std::string::npos) << unknown.err;
}

TEST(BenchContactCommand, RunsInRoundsAndFeelsTheSame) {
  const std::string slide = "study bench contact --mesh back_2962 --trajectory back_slide --radius-mm 8 --json ";
  const auto once = nlohmann::json::parse(runPalpate(slide).out);
  const auto often = nlohmann::json::parse(runPalpate(slide + "--rounds 4").out);
  EXPECT_EQ(often["hash"], once["hash"]);
  EXPECT_EQ(often["ticks"], once["ticks"]);
  EXPECT_GT(often["tick_us"]["p50"].get<double>(), 0.0);
  const auto with_tool = runPalpate(slide + "--rounds 4 --tool head");
  EXPECT_EQ(with_tool.exit_code, 2);
  EXPECT_NE(with_tool.err.find("--rounds"), std::string::npos) << with_tool.err;
}

TEST(BenchEditCommand, TellsHowSoonAChangedDysfunctionIsFelt) {
  const auto result = runPalpate("study bench edit back_2962 --edits 5 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["triangles"], 2962);
  EXPECT_GT(json["rebuild_ms"]["p50"].get<double>(), 0.0);
  EXPECT_GE(json["felt_ms"]["p50"].get<double>(), json["rebuild_ms"]["p50"].get<double>());
  EXPECT_GT(json["force_n"].get<double>(), 0.1) << "the finger presses";
  EXPECT_GT(json["largest_step_n"].get<double>(), 0.0) << "another stiffness is felt";
  EXPECT_LT(json["largest_step_n"].get<double>(), 0.1 * json["force_n"].get<double>()) << "2 % at a time";
}

TEST(BenchServoCommand, MeasuresLatenessAndComputeTimeApart) {
  const auto result = runPalpate("study bench servo --seconds 0.3 --peers --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_LE(json["ticks"].get<int>() + json["overruns"].get<int>(), 300);
  EXPECT_GT(json["ticks"].get<int>(), 0);
  for (const char* key : {"lateness_us", "compute_us"}) {
    const auto& times = json[key];
    EXPECT_LE(times["p50"], times["p99"]) << key;
    EXPECT_LE(times["p99"], times["p99_9"]) << key;
    EXPECT_LE(times["p99_9"], times["max"]) << key;
  }
  const std::string scheduler = json["scheduler"];
  EXPECT_TRUE(scheduler == "SCHED_OTHER" || scheduler.starts_with("SCHED_FIFO")) << scheduler;
  const bool all_granted = scheduler != "SCHED_OTHER" && json["memory_locked"];
  EXPECT_EQ(json["fallback"].get<std::string>().empty(), all_granted) << "what was refused must be said";
  EXPECT_GT(json["safety_us_per_tick"].get<double>(), 0.0);
  EXPECT_LT(json["safety_us_per_tick"], json["safety_tick_us"]);
  EXPECT_EQ(json["peers"]["sleep_until"]["scheduler"], "SCHED_OTHER");
  EXPECT_TRUE(json["ratio_to"].contains("sleep_until"));
}

TEST(BenchRecordingCommand, MeasuresWhatARecordingCosts) {
  const auto result = runPalpate("study bench recording --seconds 3 --hours 0.01 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["fingers"], 2);
  EXPECT_EQ(json["identical"], true);
  EXPECT_TRUE(json["record_us_per_tick"].is_number());  // a difference of medians: below 0 beside other work
  EXPECT_GT(json["bytes_per_tick"].get<double>(), 10.0);
  EXPECT_LT(json["bytes_per_tick"].get<double>(), 400.0);
  EXPECT_GT(json["replay_times_real_time"].get<double>(), 0.0);
  EXPECT_GT(json["seek_s"].get<double>(), 0.0);
  if (!support::timesAreJudged()) return;
  // Its ticks wait for nobody: beside other work the recorder may come too late. engine.RecorderOf keeps time, and
  // loses nothing.
  EXPECT_EQ(json["dropped"], 0);
  EXPECT_GT(json["record_us_per_tick"].get<double>(), 0.0);
  EXPECT_LT(json["record_us_per_tick"].get<double>(), 0.25) << "0.09 us on a quiet core (docs/reference/benchmarks.md)";
  EXPECT_GT(json["replay_times_real_time"].get<double>(), 100.0) << "250 times on a quiet core";
  EXPECT_LT(json["seek_s"].get<double>(), 0.2);
}

}  // namespace
}  // namespace palpate
