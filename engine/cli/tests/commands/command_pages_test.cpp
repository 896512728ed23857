// What `palpate` says to shells that complete words, and to man.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

std::string completed(const std::string& words) {
  const auto result = support::runPalpate("--complete " + words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

TEST(Completion, NamesTheCommandsOfAGroup) {
  EXPECT_EQ(completed("rec"), "recording\n");
  EXPECT_EQ(completed("recording tr"), "trim\n");
  EXPECT_EQ(completed("nonsense"), "");
}

TEST(Completion, NamesOptionsAndWhatTheyTake) {
  EXPECT_EQ(completed("simulate --pres"), "--preset\n");
  EXPECT_EQ(completed("simulate --preset v"), "vhb\nvhb-literal\n");
  EXPECT_EQ(completed("simulate --out v"), "") << "a folder: the shell knows those";
}

TEST(Completion, AsksTheProgramThatHoldsTheCommand) {
  if (!support::hasProgramOf("study numbers")) GTEST_SKIP() << "not built";
  EXPECT_EQ(completed("study bench conta"), "contact\n");
  EXPECT_EQ(completed("study bench contact --radius"), "--radius-mm\n");
}

TEST(Completion, OfBashTakesTheWordsFromTheCommand) {
  const std::string script = "-c 'source " + support::sourceFolder().string() +
                             "/packaging/completions/palpate.bash; COMP_WORDS=(" + support::builtProgram() +
                             " recording re); COMP_CWORD=2; _palpate; echo \"${COMPREPLY[*]}\"'";
  const auto result = support::runProgram("/bin/bash", script);
  EXPECT_EQ(result.out.substr(0, 6), "replay") << result.err;
}

TEST(ManPage, HasEveryCommandWithItsOptions) {
  const auto result = support::runPalpate("--man palpate");
  ASSERT_EQ(result.exit_code, 0);
  for (const char* part : {".TH palpate 1", ".SS palpate simulate\n", ".SS palpate recording trim\n", "\\-\\-preset",
                           "palpate\\-teach(1)", "(default: "}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  }
}

TEST(ManPage, IsWrittenWithEachProgramAndGroffTakesItWithoutAWarning) {
  const std::filesystem::path folder = support::buildFolder() / "man";
  ASSERT_TRUE(std::filesystem::exists(folder / "palpate.1"));
  if (!std::filesystem::exists("/usr/bin/groff")) GTEST_SKIP() << "groff is not installed";
  for (const auto& page : std::filesystem::directory_iterator(folder)) {
    const auto result = support::runProgram("/usr/bin/groff", "-man -ww -z -Kutf8 -Tutf8 " + page.path().string());
    EXPECT_EQ(result.err, "") << page.path();
    EXPECT_EQ(result.exit_code, 0);
  }
}

}  // namespace
}  // namespace palpate
