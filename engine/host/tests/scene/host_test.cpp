// What installHost gives the core; main has called it.
#include "palpate/scene/host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "palpate/base/environment.h"
#include "palpate/base/text.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

TEST(Host, GivesTheCoreFilesAndEveryProcessor) {
  const support::TemporaryFolder folder;
  writeFile(folder / "note.txt", "felt");
  EXPECT_EQ(readFile(folder / "note.txt", 100), "felt");
  EXPECT_EQ(environment().processors(), std::max(1u, std::thread::hardware_concurrency()));
}

TEST(Host, LeavesWhatAProgramHasChangedSince) {
  const Environment installed = environment();
  Environment own = installed;
  own.processors = [] { return std::size_t{7}; };
  useEnvironment(own);
  installHost();
  EXPECT_EQ(environment().processors(), 7u);
  useEnvironment(installed);
}

}  // namespace
}  // namespace palpate
