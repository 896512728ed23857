#include "palpate/base/private_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

mode_t modeOfFolder(const fs::path& folder) {
  struct stat facts = {};
  return ::stat(folder.c_str(), &facts) == 0 ? facts.st_mode & 07777 : 0;
}

TEST(PrivateFolder, IsItsOwnersAlone) {
  const support::TemporaryFolder folder;
  const mode_t before = ::umask(0);
  makePrivateFolder(folder / "a/b");
  EXPECT_EQ(modeOfFolder(folder / "a/b"), 0700u);
  EXPECT_EQ(modeOfFolder(folder / "a"), 0777u) << "those above it are nobody's secret";
  ::umask(before);
}

TEST(PrivateFolder, OneThatIsThereIsClosedOnlyWhereThatIsAskedFor) {
  const support::TemporaryFolder folder;
  fs::create_directories(folder / "old");
  ASSERT_EQ(::chmod((folder / "old").c_str(), 0755), 0);
  makePrivateFolder(folder / "old");
  EXPECT_EQ(modeOfFolder(folder / "old"), 0755u);
  makePrivateFolder(folder / "old", ExistingFolder::closed);
  EXPECT_EQ(modeOfFolder(folder / "old"), 0700u);
  writeFile(folder / "file", "");
  EXPECT_EQ(support::thrownMessage([&] { makePrivateFolder(folder / "file"); }),
            (folder / "file").string() + ": cannot be created: File exists");
}

TEST(PrivateFolder, OfSomebodyElseOrOpenOrALinkIsRefused) {
  const support::TemporaryFolder folder;
  makePrivateFolder(folder / "mine");
  requirePrivateFolder(folder / "mine");
  fs::create_directory_symlink(folder / "mine", folder / "link");
  EXPECT_THROW(requirePrivateFolder(folder / "link"), Error);
  ASSERT_EQ(::chmod((folder / "mine").c_str(), 0750), 0);
  EXPECT_THROW(requirePrivateFolder(folder / "mine"), Error);
}

TEST(PrivateFolder, AFileThatOthersMayReadIsRefusedAndOneOfAGroupWhereItMay) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "key";
  EXPECT_EQ(support::thrownMessage([&] { requireClosedFile(file); }), file.string() + ": No such file or directory");
  writePrivateFile(file, "secret");
  requireClosedFile(file);
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  requireClosedFile(file, OtherReaders::group);
  const std::string words = file.string() + ": other users can read or write it: chmod 600 " + file.string();
  EXPECT_EQ(support::thrownMessage([&] { requireClosedFile(file); }), words);
  ASSERT_EQ(::chmod(file.c_str(), 0602), 0);
  EXPECT_EQ(support::thrownMessage([&] { requireClosedFile(file, OtherReaders::group); }), words);
}

TEST(PrivateFolder, ForTemporaryFilesHasANameThatNobodyForesees) {
  fs::path first, second;
  {
    const TemporaryFolder one("palpate-test"), two("palpate-test");
    first = one.path();
    second = two.path();
    EXPECT_EQ(modeOfFolder(first), 0700u);
    writeFile(first / "a", "a");
  }
  EXPECT_NE(first, second);
  EXPECT_FALSE(fs::exists(first)) << "gone with all that was in it";
}

TEST(PrivateFolder, OfRunningProgramsIsCheckedBeforeItIsUsed) {
  const support::TemporaryFolder folder;
  const char* before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  EXPECT_EQ(runtimeFolder(), folder / "palpate");
  EXPECT_EQ(modeOfFolder(folder / "palpate"), 0700u);
  ASSERT_EQ(::chmod((folder / "palpate").c_str(), 0777), 0);
  EXPECT_EQ(support::thrownMessage([] { runtimeFolder(); }),
            (folder / "palpate").string() + ": must be a folder that only this user can access (mode 700, not a link)");
  before == nullptr ? ::unsetenv("XDG_RUNTIME_DIR") : ::setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace palpate
