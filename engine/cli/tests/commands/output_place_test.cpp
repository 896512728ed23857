// Where a command cannot write, it says so before its long work, and what it made and left empty goes again.
#include "cli/kit/output_place.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "palpate/base/error.h"
#include "palpate/base/made_folder.h"
#include "support/error_message.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::app {
namespace {

namespace fs = std::filesystem;

TEST(OutputPlace, AFolderThatWasMadeAndIsStillEmptyGoesAgain) {
  const support::TemporaryFolder folder;
  {
    const MadeFolder made(folder / "a/b");
    EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  {
    const MadeFolder made(folder / "a/b");
    std::ofstream(folder / "a/c") << "kept";
  }
  EXPECT_FALSE(fs::exists(folder / "a/b"));
  EXPECT_TRUE(fs::exists(folder / "a/c"));
  { const MadeFolder there(folder.path()); }
  EXPECT_TRUE(fs::exists(folder.path())) << "it was there before";
}

TEST(OutputPlace, TryingLeavesNothing) {
  const support::TemporaryFolder folder;
  requireWritableFolder(folder / "a/b/");
  requireWritableFile(folder / "c.ply");
  requireWritableFile(folder / "a/b/c.ply");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  std::ofstream(folder / "c.ply") << "before";
  requireWritableFile(folder / "c.ply");
  EXPECT_EQ(support::contentOf(folder / "c.ply"), "before");
  requireWritableFile("/dev/null");
}

TEST(OutputPlace, WhatCannotBeIsToldWithItsReason) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "file") << "a";
  const std::string under = (folder / "file/under").string();
  EXPECT_EQ(support::thrownMessage([&] { requireWritableFolder(under); }),
            under + ": cannot be created as a results folder: Not a directory");
  EXPECT_EQ(support::thrownMessage([&] { requireWritableFile(under); }),
            under + ": cannot be written: Not a directory");
}

/// Their work takes seconds: nobody hears of it.
TEST(OutputPlace, CommandsSayItBeforeTheirWork) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "file") << "a";
  struct Row {
    std::string command;
    std::string error;
  };
  for (const auto& [command, error] :
       {Row{"body make trunk --triangles 1000000 -o file/under/a.ply",
            "file/under/a.ply: cannot be written: Not a directory"},
        Row{"render -o file/under/a.png", "file/under/a.png: cannot be written: Not a directory"},
        Row{"recording new --out file/under/a.session", "file/under/a.session: cannot be written: Not a directory"},
        Row{"simulate --out file/under", "file/under: cannot be created as a results folder: Not a directory"},
        Row{"measure synthesize -o file/under", "file/under: cannot be created as a results folder: Not a directory"},
        Row{"study all -o file/under", "file/under: cannot be created as a results folder: Not a directory"}}) {
    if (!support::hasProgramOf(command)) continue;
    const auto result = support::runPalpate(command, folder.path());
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_TRUE(result.err.starts_with("palpate: " + error)) << command << ": " << result.err;
  }
}

}  // namespace
}  // namespace palpate::app
