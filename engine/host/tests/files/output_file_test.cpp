#include "palpate/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, AppearsWholeAndOnlyWhenItIsCommitted) {
  const support::TemporaryFolder folder;
  const fs::path target = folder / "a.csv", partial = folder / "a.csv.partial";
  OutputFile file(target);
  file.write("one,");
  file.write("two\n");
  EXPECT_TRUE(fs::exists(partial));
  EXPECT_FALSE(fs::exists(target));
  file.commit();
  EXPECT_FALSE(fs::exists(partial));
  EXPECT_EQ(readFile(target, 100), "one,two\n");
}

TEST(OutputFile, WithoutACommitLeavesWhatWasThere) {
  const support::TemporaryFolder folder;
  writeFile(folder / "a.csv", "old");
  { OutputFile(folder / "a.csv").write("new"); }
  EXPECT_EQ(readFile(folder / "a.csv", 100), "old");
  EXPECT_FALSE(fs::exists(folder / "a.csv.partial"));
}

TEST(OutputFile, WhatAnInterruptedRunLeftIsNotOverwritten) {
  const support::TemporaryFolder folder;
  writeFile(folder / "a.csv.partial", "left by a crash");
  OutputFile file(folder / "a.csv");
  EXPECT_EQ(file.partial(), folder / "a.csv.2.partial");
  file.write("whole");
  file.commit();
  EXPECT_EQ(readFile(folder / "a.csv", 100), "whole");
  EXPECT_EQ(readFile(folder / "a.csv.partial", 100), "left by a crash");
  EXPECT_FALSE(fs::exists(folder / "a.csv.2.partial"));
}

TEST(OutputFile, ARecordingKeepsWhatWasWritten) {
  const support::TemporaryFolder folder;
  { OutputFile(folder / "a.csv", OutputFile::Unfinished::keep).write("a row\n"); }
  EXPECT_EQ(readFile(folder / "a.csv.partial", 100), "a row\n");
  EXPECT_FALSE(fs::exists(folder / "a.csv"));
}

TEST(OutputFile, FollowsALinkAndKeepsThePermissions) {
  const support::TemporaryFolder folder;
  writeFile(folder / "real.csv", "old");
  fs::permissions(folder / "real.csv", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.csv", folder / "link.csv");
  writeFile(folder / "link.csv", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(readFile(folder / "real.csv", 100), "new");
  EXPECT_EQ(fs::status(folder / "real.csv").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

mode_t modeOf(const fs::path& file) {
  struct stat facts = {};
  return ::stat(file.c_str(), &facts) == 0 ? facts.st_mode & 07777 : 0;
}

TEST(OutputFile, FollowsNoLinkInAFolderWhereAnybodyMayLayOne) {
  const support::TemporaryFolder folder;
  const fs::path open = folder / "open";
  fs::create_directories(open);
  ASSERT_EQ(::chmod(open.c_str(), 01777), 0);
  writeFile(folder / "mine.csv", "mine");
  fs::create_symlink(folder / "mine.csv", open / "laid.csv");
  fs::create_directory_symlink(folder.path(), open / "laid");
  fs::create_symlink(open / "laid.csv", folder / "far.csv");
  const std::string refusal = ": is a link in a world-writable folder; name the file that it points to";
  EXPECT_EQ(support::thrownMessage([&] { writeFile(open / "laid.csv", "new"); }),
            (open / "laid.csv").string() + refusal);
  EXPECT_EQ(support::thrownMessage([&] { writeFile(open / "laid/mine.csv", "new"); }),
            (open / "laid").string() + refusal);
  EXPECT_EQ(support::thrownMessage([&] { writeFile(folder / "far.csv", "new"); }),
            (open / "laid.csv").string() + refusal);
  EXPECT_EQ(readFile(folder / "mine.csv", 100), "mine");
  writeFile(open / "plain.csv", "new");
  EXPECT_EQ(readFile(open / "plain.csv", 100), "new") << "what is not a link is written there as anywhere";
}

TEST(OutputFile, ForItsOwnerAloneIsSoFromTheFirstByte) {
  const support::TemporaryFolder folder;
  const mode_t before = ::umask(0);
  writeFile(folder / "a.key", "old");  // for all
  {
    OutputFile file(folder / "a.key", OutputFile::Unfinished::remove, OutputFile::Access::owner_only);
    EXPECT_EQ(modeOf(file.partial()), 0600u);
    file.write("secret");
    file.commit();
  }
  EXPECT_EQ(modeOf(folder / "a.key"), 0600u) << "whatever stood there";
  createPrivateFile(folder / "b");
  EXPECT_EQ(modeOf(folder / "b"), 0600u);
  EXPECT_EQ(support::thrownMessage([&] { createPrivateFile(folder / "b"); }),
            (folder / "b").string() + ": cannot be written: File exists");
  ::umask(before);
}

TEST(OutputFile, TellsThatItsFileWasDeleted) {
  const support::TemporaryFolder folder;
  fs::create_directories(folder / "disk");
  OutputFile file(folder / "disk/a.csv");
  fs::remove_all(folder / "disk");
  EXPECT_EQ(support::thrownMessage([&] { file.write("a row\n"); }),
            (folder / "disk/a.csv").string() + ": cannot be written: No such file or directory");
}

TEST(OutputFile, MakesItsFolder) {
  const support::TemporaryFolder folder;
  writeFile(folder / "monday/first/a.csv", "a row\n");
  EXPECT_EQ(readFile(folder / "monday/first/a.csv", 100), "a row\n");
  createPrivateFile(folder / "tuesday/b");
  EXPECT_TRUE(fs::exists(folder / "tuesday/b"));
}

TEST(OutputFile, TakesAwayAFolderIntoWhichNothingCame) {
  const support::TemporaryFolder folder;
  { OutputFile file(folder / "monday/first/a.csv"); }
  EXPECT_FALSE(fs::exists(folder / "monday"));
}

/// A limit on the size of files fails in the middle, as a full disk does.
TEST(OutputFile, AFailureInTheMiddleLeavesTheEarlierFileWhole) {
  const support::TemporaryFolder folder;
  writeFile(folder / "a.csv", "old");
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = support::thrownMessage([&] { writeFile(folder / "a.csv", std::string(5000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(message, (folder / "a.csv").string() + ": cannot be written: File too large");
  EXPECT_EQ(readFile(folder / "a.csv", 100), "old");
  EXPECT_FALSE(fs::exists(folder / "a.csv.partial"));
}

TEST(OutputFile, WritesAPipeDirectly) {
  const support::TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  OutputFile file(pipe);
  file.write("row\n");
  file.commit();
  char bytes[8] = {};
  EXPECT_EQ(read(reader, bytes, sizeof bytes), 4);
  EXPECT_STREQ(bytes, "row\n");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe)) << "no file took its place";
}

TEST(OutputFile, SaysWhatCannotBeWrittenAndWhy) {
  const support::TemporaryFolder folder;
  writeFile(folder / "file", "a");
  const fs::path under = folder / "file/under/a.csv", full = folder / "full";
  EXPECT_EQ(support::thrownMessage([&] { OutputFile{under}; }),
            under.string() + ": cannot be written: Not a directory");
  fs::create_symlink("/dev/full", full);
  OutputFile file(full);
  EXPECT_EQ(support::thrownMessage([&] { file.write("a row\n"); }),
            full.string() + ": cannot be written: No space left on device");
}

}  // namespace
}  // namespace palpate
