// `palpate train` at the command line; its window is tested in instruments/teach/tests/teach_window/training_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "palpate/training/records/trainee_code.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

support::CommandResult train(const std::string& arguments, const std::filesystem::path& in) {
  return support::runProgram(
      "/usr/bin/env",
      "-u DISPLAY -u WAYLAND_DISPLAY PALPATE_SPEECH=off " + support::builtProgram() + " train " + arguments, in);
}

class TrainCommand : public testing::Test {
 protected:
  const support::TemporaryFolder folder;
};

TEST_F(TrainCommand, RefusesACodeWithATypingErrorBeforeAnythingOpens) {
  std::string code = training::makeTraineeCode(42);
  code.back() = code.back() == '0' ? '1' : '0';
  const auto result = train("--records r.results --code " + code, folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("is not a code"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "r.results"));
}

TEST_F(TrainCommand, SaysWhichKindsThereAre) {
  const auto result = train("--kind pretest", folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("pre-test"), std::string::npos) << result.err;
}

TEST_F(TrainCommand, NamesTheLineOfAProtocolThatMakesNoSense) {
  std::ofstream(folder / "p.toml") << "id = \"p\"\nversion = 1\n[pre_test]\nlimit_s = -4\n";
  const auto result = train("--protocol p.toml --records r.results", folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("p.toml:4"), std::string::npos) << result.err;
}

TEST_F(TrainCommand, SaysThatAWindowNeedsADisplay) {
  const auto result = train("--records r.results", folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("display"), std::string::npos) << result.err;
}

class TrainScreens : public TrainCommand {};

TEST_F(TrainScreens, AreDrawnWithoutAWindow) {
  std::ofstream(folder / "s.toml") << "[body]\ntriangles = 8164\n";
  std::ofstream(folder / "p.toml")
      << "id = \"p\"\nversion = 1\n[pre_test]\nwarm_up = 0\neasy = 0\nleast = 2\nmost = 2\n";
  const auto result =
      train("s.toml --protocol p.toml --no-state --screens screens --width 640 --height 480", folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"01-welcome", "06-choice", "11-practice-trial", "13-wrong", "17-test-trial"}) {
    const auto file = folder / (std::string("screens/") + name + ".png");
    EXPECT_GT(std::filesystem::exists(file) ? std::filesystem::file_size(file) : 0, 5000u) << file;
  }
}

}  // namespace
}  // namespace palpate
