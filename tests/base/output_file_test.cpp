#include "palpate/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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
  const fs::path nowhere = folder / "no/such.csv", full = folder / "full";
  EXPECT_EQ(support::messageOf([&] { OutputFile{nowhere}; }),
            nowhere.string() + ": cannot be written: No such file or directory");
  fs::create_symlink("/dev/full", full);
  OutputFile file(full);
  file.write("a row that stays in the buffer\n");
  EXPECT_EQ(support::messageOf([&] { file.commit(); }), full.string() + ": cannot be written: No space left on device");
}

}  // namespace
}  // namespace palpate
