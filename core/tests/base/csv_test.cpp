#include "palpate/base/csv.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/error_message.h"

namespace palpate {

TEST(ForEachCsvRow, SkipsBlanksAndCommentsAndKeepsLineNumbers) {
  std::vector<std::string> rows;
  forEachCsvRow("# title\n\na, b ,\n1,2,3 # last", "t.csv", [&](const CsvRow& row) {
    rows.push_back(std::to_string(row.line) + ":" + std::to_string(row.fields.size()) + ":" +
                   std::string(row.fields[1]));
  });
  EXPECT_EQ(rows, (std::vector<std::string>{"3:3:b", "4:3:2"}));
}

TEST(ForEachCsvRow, RefusesBinaryGarbageWithItsLine) {
  EXPECT_EQ(support::messageOf([] { forEachCsvRow("1,2\n\x01\x02", "t.csv", [](const CsvRow&) {}); }),
            "t.csv:2: not a text table (byte 0x01)");
}

TEST(CsvNumber, TakesFiniteNumbersOnly) {
  int rows = 0;
  forEachCsvRow("1.5,two,nan", "t.csv", [&](const CsvRow& row) {
    ++rows;
    EXPECT_EQ(csvNumber(row, 0, "a"), 1.5);
    EXPECT_THROW(csvNumber(row, 1, "b"), Error);
    EXPECT_THROW(csvNumber(row, 2, "c"), Error);
    EXPECT_FALSE(looksLikeCsvHeader(row));
  });
  EXPECT_EQ(rows, 1);
}

}  // namespace palpate
