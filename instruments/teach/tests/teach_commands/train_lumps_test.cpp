// `palpate train --kind lump-exam` as a script runs it: a sitting and an examination, kept, verified, and reported.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/training/protocol.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::runPalpate;

class TrainLumps : public testing::Test {
 protected:
  TrainLumps() {
    std::ofstream(folder_ / "small.toml") << "[body]\nkind = \"trunk\"\ntriangles = 14000\n";
    training::Protocol protocol = training::builtInLumpProtocol();
    protocol.id = "short";
    protocol.lump->bodies = 5;
    std::ofstream(folder_ / "short.toml") << training::protocolText(protocol);
  }

  support::CommandResult train(const std::string& arguments) const {
    return runPalpate("train small.toml --records r.results " + arguments, folder_.path());
  }

  support::TemporaryFolder folder_;
};

TEST_F(TrainLumps, APracticeAndAnExaminationRunToTheReport) {
  const std::string who = " --seed 4 --no-session-file --trainee observer=lump,spread=1.5,pattern_weber=0.05";
  const auto practice = train("--protocol short.toml --kind lump --json" + who);
  ASSERT_EQ(practice.exit_code, 0) << practice.err;
  const json sat = json::parse(practice.out)["trainees"][0]["sittings"][0];
  EXPECT_EQ(sat["trials"], 5);
  EXPECT_EQ(sat["lumps"]["bodies"], 5);
  const auto exam = train("--kind lump-exam --verbose" + who);
  ASSERT_EQ(exam.exit_code, 0) << exam.err;
  EXPECT_NE(exam.out.find("of 18 lumps found"), std::string::npos) << exam.out;
  EXPECT_NE(exam.out.find("body  6:"), std::string::npos) << exam.out;

  const auto verified = runPalpate("train results verify r.results --json", folder_.path());
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  const auto told = runPalpate("train results report r.results --json", folder_.path());
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const json groups = json::parse(told.out)["lumps"];
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0]["kind"], "lump");
  EXPECT_EQ(groups[1]["kind"], "lump_exam");
  const json& all = groups[1]["all"];
  EXPECT_EQ(all["found"]["whole"], 18);
  EXPECT_EQ(all["by_size"][0]["whole"], 6);
  EXPECT_EQ(all["by_depth"][0]["whole"], 9);
  EXPECT_EQ(all["by_depth"][1]["whole"], 0);
  EXPECT_EQ(all["by_hardness"][2]["whole"], 6);
  EXPECT_LE(all["by_size"][0]["part"], all["by_size"][2]["part"]) << "large ones are found more often";
  const auto page = runPalpate("train results report r.results --out page.html", folder_.path());
  ASSERT_EQ(page.exit_code, 0) << page.err;
  const std::string html = support::contentOf(folder_ / "page.html");
  EXPECT_NE(html.find("Examination with lumps"), std::string::npos);
  EXPECT_NE(html.find("10 mm large"), std::string::npos);
}

TEST_F(TrainLumps, WhatDoesNotFitIsSaidBeforeABodyIsBuilt) {
  EXPECT_NE(train("--kind lump --trainee weber=0.2").err.find("key"), std::string::npos);
  EXPECT_NE(train("--kind lump --trainee seed=3").err.find("observer=lump"), std::string::npos);
  EXPECT_NE(train("--kind pre-test --trainee observer=lump").err.find("observer"), std::string::npos);
  EXPECT_NE(train("--kind lump --fast --trainee observer=lump").err.find("--fast"), std::string::npos);
  EXPECT_NE(train("--kind lump --trainee observer=lump,spreed=2").err.find("spread"), std::string::npos);
  EXPECT_NE(train("--kind lump --trainee observer=lump,field=maybe").err.find("true or false"), std::string::npos);
}

}  // namespace
}  // namespace palpate
