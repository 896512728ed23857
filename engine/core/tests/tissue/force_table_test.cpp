#include "palpate/tissue/user_profile.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::tissue {
namespace {

std::string messageFor(const std::string& text) {
  return support::thrownMessage([&] { parseForceTable(text, "f.csv"); });
}

TEST(ForceTable, ReadsRowsAfterAHeader) {
  const ForceTable table = parseForceTable("depth_mm,force_n\n# measured in spring\n0,0\n2,0.9\n10,12.5\n", "f.csv");
  ASSERT_EQ(table.rows, 2u);
  EXPECT_EQ(table.depth_mm[1], 10.0);
  EXPECT_EQ(table.effective_mm[0], 0.9);
}

TEST(ForceTable, MayBeginBelowAMillimetre) { EXPECT_EQ(parseForceTable("0.3,0.1\n2,1\n", "f.csv").rows, 2u); }

TEST(ForceTable, IsReadFromAFile) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "f.csv") << "5,4\n";
  EXPECT_EQ(readForceTable(folder / "f.csv").rows, 1u);
  EXPECT_NE(support::thrownMessage([&] { readForceTable(folder / "none.csv"); }), "no error");
}

TEST(ForceTable, NamesTheLineThatIsWrong) {
  support::expectEach(messageFor, {{"2,1\n2,3\n", "f.csv:2: depth_mm must increase, but 2 follows 2"},
                                   {"2,1\n3,0.5\n", "f.csv:2: force_n must not decrease, but 0.5 follows 1"},
                                   {"\n2\n", "f.csv:2: expected depth_mm,force_n, found 1 fields"},
                                   {"0,1\n", "f.csv:1: force_n must be 0 at depth 0"},
                                   {"-2,1\n", "f.csv:1: depth_mm = -2 is out of range: 0 to 1,000,000"},
                                   {"2,x\n", "f.csv:1: force_n is not a number: 'x'"},
                                   {"2,inf\n", "f.csv:1: force_n must be finite, got inf"},
                                   {"depth_mm,force_n\n", "f.csv: requires at least one row with a depth above 0"}});
}

TEST(ForceTable, HoldsADeclaredNumberOfRows) {
  std::string text;
  for (std::uint32_t i = 1; i <= ForceTable::kMaxRows; ++i) text += std::to_string(i) + "," + std::to_string(i) + "\n";
  EXPECT_EQ(parseForceTable(text, "f.csv").rows, ForceTable::kMaxRows);
  EXPECT_EQ(messageFor(text + "65,65\n"), "f.csv:65: more than 64 rows");
}

}  // namespace
}  // namespace palpate::tissue
