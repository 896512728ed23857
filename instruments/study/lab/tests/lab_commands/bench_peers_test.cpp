// `palpate study bench ... --peers` as a user runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {

namespace {

using nlohmann::json;

json runForJson(const std::string& arguments) {
  const support::CommandResult result = support::runPalpate(arguments + " --json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out);
}

/// All peers are there, with figures or with the reason why not; `time` is the key of their times.
void expectPeers(const json& report, const std::string& time, const std::string& reason = "not installed") {
  for (const char* name : {"embree", "cgal", "fcl", "literal"}) {
    ASSERT_TRUE(report["peers"].contains(name)) << name;
    const json& peer = report["peers"][name];
    if (peer.contains("skipped")) {
      EXPECT_EQ(peer["skipped"], reason) << name;
      EXPECT_FALSE(report["ratio_to"].contains(name)) << name;
      continue;
    }
    for (const char* key : {"p50", "p99", "p99_9", "max"}) EXPECT_TRUE(peer[time].contains(key)) << name << key;
    for (const char* key : {"queries", "bytes_per_triangle", "build_ns_per_triangle", "hash"}) {
      EXPECT_TRUE(peer.contains(key)) << name << key;
    }
    EXPECT_EQ(peer["disagreements"], 0) << name;
    const double ratio = report[time]["p50"].get<double>() / peer[time]["p50"].get<double>();
    EXPECT_DOUBLE_EQ(report["ratio_to"][name].get<double>(), ratio) << name;
  }
  EXPECT_FALSE(report["peers"]["literal"].contains("skipped"));
}

}  // namespace

TEST(BenchPeers, AnswerTheQueriesOfTheFinger) {
  const std::string run = "study bench contact --mesh back_2962 --trajectory back_slide --from 2 --to 4";
  const json report = runForJson(run + " --peers --peer-seconds 0.5");
  expectPeers(report, "tick_us");
  EXPECT_EQ(report["hash"], runForJson(run)["hash"]);  // ours is the same run
  EXPECT_EQ(report["peer_queries"]["segments"], report["ticks"]);
  const double distance = report["peers"]["literal"]["mean_distance_mm"];
  EXPECT_GT(distance, 5.0);
  EXPECT_LT(distance, 10.0);
}

TEST(BenchPeers, OfAToolSayWhichPadsTouch) {
  const json report = runForJson(
      "study bench contact --mesh back_2962 --trajectory back_slide --from 2 --to 4 --tool head --peers --peer-seconds "
      "0.5");
  for (const char* name : {"bullet", "fcl"}) {
    ASSERT_TRUE(report["peers"].contains(name)) << name;
    const json& peer = report["peers"][name];
    if (peer.contains("skipped")) continue;
    EXPECT_EQ(peer["disagreements"], 0) << name;
    EXPECT_GT(peer["mean_touching"], 1.0) << name;
    const double ratio = report["any_tick_us"]["p50"].get<double>() / peer["tick_us"]["p50"].get<double>();
    EXPECT_DOUBLE_EQ(report["ratio_to"][name].get<double>(), ratio) << name;
  }
}

TEST(BenchPeers, AnswerTheBoxes) {
  const json report = runForJson("study bench partition --mesh back_2962 --ticks 200 --peers --peer-seconds 0.5");
  expectPeers(report, "hdb_query_us");
  EXPECT_DOUBLE_EQ(report["peers"]["literal"]["mean_triangles"].get<double>(), report["mean_triangles"].get<double>());
}

TEST(BenchPeers, WithoutTheirProgramAreSkippedAndNoPackageIsBlamed) {
  // A copy elsewhere has no palpate_peers beside it, as an installed command.
  const support::TemporaryFolder folder;
  const auto copy = folder.path() / "palpate";
  for (const char* program : {"palpate", "palpate-study"}) {
    std::filesystem::copy_file(support::buildFolder() / program, folder.path() / program);
  }
  const std::string run =
      "study bench contact --mesh back_2962 --trajectory back_slide --from 2.2 --to 3 --peers --peer-seconds 0.2";
  const support::CommandResult text = support::runProgram(copy, run);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("embree:"), std::string::npos);
  EXPECT_NE(text.out.find("palpate_peers is not next to this program"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("libembree-dev"), std::string::npos) << text.out;
  const json report = json::parse(support::runProgram(copy, run + " --json").out);
  expectPeers(report, "tick_us", "not run, palpate_peers is not next to this program");
}

TEST(BenchPeers, AreNotForTheDetectingBoxAsASource) {
  const auto result =
      support::runPalpate("study bench contact --mesh back_2962 --trajectory back_slide --source hdb --peers");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--source surface"), std::string::npos);
}

}  // namespace palpate
