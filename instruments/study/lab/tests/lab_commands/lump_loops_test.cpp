// `palpate lump loops`, `palpate study bench lump` and `palpate study hunt --lumps` as a user calls them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lab/counters/thread_counts.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::runPalpate;

TEST(LumpLoopsCommand, LooksAtEnergyAndSaysSoByItsExitCode) {
  const std::string few = "lump loops --paths 20 --hands 4 --seconds 1 --systems 4 --seed 2 --json";
  const auto result = runPalpate(few);
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["holds"], true);
  EXPECT_EQ(json["paths"], 20);
  EXPECT_GT(json["worst_work_n_mm"].get<double>(), 0.0);
  EXPECT_LE(json["worst_work_share"].get<double>(), 1e-5);
  EXPECT_EQ(json["falls_with_the_square"], true);
  EXPECT_EQ(json["by_step"].size(), 3u);
  EXPECT_EQ(json["mobile"]["with_two_fingers"], 2);
  EXPECT_LE(json["mobile"]["given_back_n_mm"].get<double>(), 1e-5);
  EXPECT_EQ(json["mobile"]["oscillating"], 0);
  EXPECT_EQ(json["stiffest"]["systems"], 4);
  EXPECT_NEAR(json["stiffest"]["slope_n_per_mm"].get<double>(), 1.9, 1e-6);
  EXPECT_EQ(runPalpate(few).out, result.out) << "the same seed";
}

TEST(LumpLoopsCommand, ABrokenBarIsExitCodeOne) {
  // A path in few long steps is summed badly.
  const auto result = runPalpate("lump loops --paths 10 --step-mm 1 --hands 1 --seconds 0.5 --systems 1 --json");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["holds"], false);
}

TEST(LumpLoopsCommand, RefusesWrongNumbers) {
  EXPECT_EQ(runPalpate("lump loops --paths 0").exit_code, 2);
  EXPECT_EQ(runPalpate("lump loops --step-mm nothing").exit_code, 2);
}

TEST(BenchLumpCommand, TimesTicksAndPadsAndCountsAllocations) {
  const auto result = runPalpate("study bench lump --seconds 0.05 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_GT(json["tick_us"].get<double>(), 0.0);
  for (const char* key : {"1", "8", "8_mobile", "8_and_pad_4"})
    EXPECT_TRUE(json["tick_extra_us"][key].is_number()) << key;
  EXPECT_GT(json["tick_extra_us"]["8_and_pad_4"], json["tick_extra_us"]["8"]);
  for (const char* key : {"4", "8", "16", "4_of_8_lumps"}) EXPECT_GT(json["field_us"][key].get<double>(), 0.0) << key;
  if (lab::kCountsCalls) {
    EXPECT_EQ(json["allocations"], 0);
  }
}

TEST(HuntCommandWithLumps, CountsTheirFaultsApart) {
  const auto end = runPalpate("study hunt --ticks 6000 --bodies 2 --seed 4 --lumps 6 --json");
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json["lumps"], 6);
  for (const char* key : {"lump_forces", "lump_steps", "lumps_moved"}) EXPECT_EQ(json[key], 0) << key;
  EXPECT_EQ(runPalpate("study hunt --ticks 100 --lumps 3 --scale 2").exit_code, 2);
}

}  // namespace
}  // namespace palpate
