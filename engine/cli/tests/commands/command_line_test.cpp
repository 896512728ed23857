// What `palpate` says to words that it does not know.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

struct Wrong {
  const char* arguments;
  const char* said;
};

class WrongCommandLine : public testing::TestWithParam<Wrong> {};

TEST_P(WrongCommandLine, IsAnsweredInOneLineThatNamesTheWord) {
  if (!support::hasProgramOf(GetParam().arguments)) GTEST_SKIP() << "not built";
  const support::TemporaryFolder folder;
  const auto result = support::runPalpate(GetParam().arguments, folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, std::string("palpate: ") + GetParam().said + " (see --help)\n");
}

INSTANTIATE_TEST_SUITE_P(
    Words, WrongCommandLine,
    testing::Values(
        Wrong{"simulat", "unknown command 'simulat'; did you mean 'simulate'?"},
        Wrong{"body map elipses", "unknown command 'elipses'; did you mean 'ellipses'?"},
        Wrong{"body map nonsense", "unknown command 'nonsense'; known: ellipses, contours, stiffness, depth"},
        Wrong{"study", "A subcommand is required"},
        Wrong{"simulate --secnds 3", "unknown option '--secnds' of palpate simulate; did you mean '--seconds'?"},
        Wrong{"study bench contact --radius-cm=3",
              "unknown option '--radius-cm' of palpate study bench contact; did you mean "
              "'--radius-mm'?"},
        Wrong{"--verison",
              "unknown option '--verison' of palpate; did you mean "
              "'--version'?"},
        Wrong{"body repair a.obj --banana", "unknown option '--banana' of palpate body repair"},
        Wrong{"body info a.obj b.obj", "'b.obj' is one word too many for palpate body info"},
        Wrong{"study partition cube --tree bps", "--tree: 'bps' is not one of bsp|octree; did you mean 'bsp'?"},
        Wrong{"body map ellipses -o a.csv --quantity aspekt",
              "--quantity: 'aspekt' is not one of half-major|aspect|direction; did you "
              "mean 'aspect'?"},
        Wrong{"simulate --seconds 1e12", "--seconds: 1e12 is out of range: above 0 and at most 10,800 s"},
        Wrong{"simulate --seconds nan",
              "--seconds: 'nan' is not a finite number (above "
              "0 and at most 10,800 s)"},
        Wrong{"study hunt --ticks 1.5",
              "--ticks: '1.5' is not a whole number (1 to "
              "1,000,000,000,000)"}));

/// On a machine without a display.
support::CommandResult withoutDisplay(const std::string& arguments, const std::filesystem::path& in) {
  return support::runProgram("/usr/bin/env",
                             "-u DISPLAY -u WAYLAND_DISPLAY " + support::builtProgram() + " " + arguments, in);
}

TEST(CommandLine, WithoutACommandItSaysWhatThereIs) {
  const support::TemporaryFolder folder;
  const support::CommandResult result = withoutDisplay("", folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 6) << result.out;
  for (const char* command : {"palpate run", "palpate simulate", "palpate train", "palpate body", "palpate --help"}) {
    EXPECT_NE(result.out.find(command), std::string::npos) << command;
  }
}

TEST(CommandLine, HelpIsAWordToo) {
  EXPECT_EQ(support::runPalpate("help").out, support::runPalpate("--help").out);
  EXPECT_EQ(support::runPalpate("help simulate").out, support::runPalpate("simulate --help").out);
}

TEST(CommandLine, AFileInPlaceOfACommandIsRun) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << "seconds = 1\n";
  const support::CommandResult run = withoutDisplay("run scene.toml", folder.path());
  EXPECT_NE(run.err.find("there is no display"), std::string::npos) << run.err;
  EXPECT_EQ(withoutDisplay("scene.toml", folder.path()).err, run.err);
  EXPECT_EQ(withoutDisplay("./scene.toml", folder.path()).err, run.err);
  EXPECT_NE(withoutDisplay("gone.toml", folder.path()).err.find("unknown command 'gone.toml'"), std::string::npos);
}

TEST(CommandLine, AnEarlierNameOfACommandStillWorksAndSaysTheNewOne) {
  const support::CommandResult result = support::runPalpate("trim --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("palpate recording trim"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "palpate: note: `palpate trim` is called `palpate recording trim` now; the old name will go\n");
}

TEST(CommandLine, WhatAMissingProgramHoldsSaysWhichPackageAndHowItIsBuilt) {
  const support::TemporaryFolder folder;
  std::filesystem::copy_file(support::buildFolder() / "palpate", folder / "palpate");
  const support::CommandResult result = support::runProgram(folder / "palpate", "train --trainee weber=0.2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "palpate: palpate train requires the package palpate-teach, which is not installed; from source: ./run "
            "train, or cmake --build BUILD --target palpate_teach_family\n");
  EXPECT_EQ(support::runProgram(folder / "palpate", "body info --help").exit_code, 0) << "what it holds itself";
}

TEST(CommandLine, TheHelpHasAtMostTwelveEntries) {
  const std::string help = support::runPalpate("--help").out;
  int entries = 0;
  for (std::size_t at = help.find("\n\nTouch:"); at != std::string::npos && at < help.find("\nExamples:");
       at = help.find('\n', at + 1)) {
    entries += help.compare(at, 3, "\n  ") == 0 ? 1 : 0;
  }
  EXPECT_GE(entries, 10) << help;
  EXPECT_LE(entries, 12) << help;
}

}  // namespace
}  // namespace palpate
