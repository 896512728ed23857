// What `palpate` says to words that it does not know.
#include <gtest/gtest.h>

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
  const support::TemporaryFolder folder;
  const auto result = support::runPalpate(GetParam().arguments, folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, std::string("palpate: ") + GetParam().said + " (see --help)\n");
}

INSTANTIATE_TEST_SUITE_P(Words, WrongCommandLine,
                         testing::Values(Wrong{"nonsense", "'nonsense' is no command here"},
                                         Wrong{"study nonsense", "'nonsense' is no command here"},
                                         Wrong{"study", "A subcommand is required"}));

}  // namespace
}  // namespace palpate
