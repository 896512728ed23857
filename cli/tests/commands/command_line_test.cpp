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

INSTANTIATE_TEST_SUITE_P(
    Words, WrongCommandLine,
    testing::Values(Wrong{"simulat", "unknown command 'simulat'; did you mean 'simulate'?"},
                    Wrong{"body map elipses", "unknown command 'elipses'; did you mean 'ellipses'?"},
                    Wrong{"body map nonsense", "unknown command 'nonsense'; known: ellipses, contours, stiffness, depth"},
                    Wrong{"study", "A subcommand is required"},
                    Wrong{"simulate --secnds 3",
                          "unknown option '--secnds' of palpate simulate; did you mean '--seconds'?"},
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

}  // namespace
}  // namespace palpate
