// `palpate study`: exit codes, files and messages.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {

namespace fs = std::filesystem;

class StudyCommand : public testing::Test {
 protected:
  support::CommandResult study(const std::string& arguments) const {
    return support::runProgram(support::buildFolder() / "palpate", "study " + arguments, folder.path());
  }

  const support::TemporaryFolder folder;
};

TEST_F(StudyCommand, NumbersHoldAndSayEachVerdict) {
  const auto run = study("numbers --json --out report");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_TRUE(json.at("holds").get<bool>());
  EXPECT_GT(json.at("rows").size(), 200u);
  EXPECT_TRUE(fs::exists(folder.path() / "report/numbers.md"));
  EXPECT_NE(study("numbers").out.find("misprint (E13)"), std::string::npos);
}

TEST_F(StudyCommand, DrawsTheFiguresThatAreAskedFor) {
  const auto run = study("figures --only 3.11,4.8 --scale 1 --out drawn");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(folder.path() / "drawn/figure_3_11.svg"));
  EXPECT_TRUE(fs::exists(folder.path() / "drawn/figure_4_8.png"));
  EXPECT_FALSE(fs::exists(folder.path() / "drawn/figure_4_9.png"));
  EXPECT_NE(study("figures --list").out.find("5.11"), std::string::npos);
}

TEST_F(StudyCommand, APageGoesIntoTheFolderAndItsNumbersToPrograms) {
  const auto run = study("complexity --quick --json --out page");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("study"), "complexity");
  EXPECT_LE(json.at("numbers").at("ways_over_bound_max").get<double>(), 1.0);
  EXPECT_FALSE(json.at("machine").get<std::string>().empty());
  for (const auto& figure : json.at("figures")) {
    EXPECT_TRUE(fs::exists(folder.path() / "page" / figure.get<std::string>())) << figure;
  }
  EXPECT_TRUE(fs::exists(folder.path() / "page/complexity.md"));
}

using CredibilityCommand = StudyCommand;  // its own suite: it takes a while even when quick

TEST_F(CredibilityCommand, WritesItsFileAsHtmlAndJson) {
  const auto run = study("credibility --quick --json --consequence high -o it.html -o it.json");
  EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_TRUE(json.at("holds").get<bool>());
  EXPECT_EQ(json.at("model_risk").at("risk"), "high");
  EXPECT_EQ(json.at("code_verification").at("evidence").at(0).at("name"), "numbers");
  EXPECT_TRUE(fs::exists(folder.path() / "it.html"));
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder.path() / "it.json")), json);
}

TEST_F(StudyCommand, WrongUseIsOneLineAndExitCodeTwo) {
  for (const std::string wrong :
       {"figures --only 9.9 --out x", "figures", "", "numbers --out /proc/nowhere", "all",
        "all --quick --out /proc/nowhere", "profile --quick --out /proc/nowhere", "credibility -o it.txt",
        "credibility -o /proc/nowhere.json", "credibility --influence none", "credibility --quick --living nowhere"}) {
    const auto run = study(wrong);
    EXPECT_EQ(run.exit_code, 2) << wrong;
    EXPECT_EQ(run.err.substr(0, 9), "palpate: ") << wrong;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
  }
}

}  // namespace palpate
