#include "palpate/base/csv.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/error_message.h"

namespace palpate {

TEST(ForEachCsvRow, SkipsBlanksAndCommentsAndKeepsLineNumbers) {
  std::vector<std::string> rows;
  forEachCsvRow("# title\n\na, b ,c\n1,2,3 # last", "t.csv", [&](const CsvRow& row) {
    rows.push_back(std::to_string(row.line) + ":" + std::to_string(row.fields.size()) + ":" +
                   std::string(row.fields[1]));
  });
  EXPECT_EQ(rows, (std::vector<std::string>{"3:3:b", "4:3:2"}));
}

TEST(ForEachCsvRow, RefusesBinaryGarbageWithItsLine) {
  EXPECT_EQ(support::thrownMessage([] { forEachCsvRow("1,2\n\x01\x02", "t.csv", [](const CsvRow&) {}); }),
            "t.csv:2: not a text table (byte 0x01); expected comma-separated text");
}

/// All fields, rows after a slash: "1|2/3|4".
std::string joinFields(std::string_view text) {
  std::string all;
  forEachCsvRow(text, "t.csv", [&](const CsvRow& row) {
    if (!all.empty()) all += "/";
    for (std::size_t i = 0; i < row.fields.size(); ++i) all += (i == 0 ? "" : "|") + std::string(row.fields[i]);
  });
  return all;
}

TEST(ForEachCsvRow, TakesTablesAsSpreadsheetsWriteThem) {
  for (const char* text :
       {"a,b\n1,2\n3,4\n", "a,b\r\n1,2\r\n3,4\r\n", "a,b\r1,2\r3,4\r", "a,b\r1,2\n3,4", "a,b\n\r\n1,2\r\r3,4",
        "\xef\xbb\xbf\"a\",\"b\"\r\n\"1\", \"2\" \r\n3,\"4\"", "a,b,\n1,2,\n3,4,\n", "a,b,,,\n1,2,,\n3,4\n"}) {
    EXPECT_EQ(joinFields(text), "a|b/1|2/3|4") << text;
  }
  EXPECT_EQ(joinFields("name,n\n\"T6, left # 2\",1 # there\n"), "name|n/T6, left # 2|1");
  EXPECT_EQ(joinFields("a,b,c\n1,2,\n"), "a|b|c/1|2|") << "an empty field of a column that has a name";
  EXPECT_EQ(joinFields("a,b,\n1,2,3\n"), "a|b/1|2|3") << "a value of a column that has none stays, and is one too many";
}

TEST(ForEachCsvRow, SaysWhyItDoesNotReadATable) {
  const auto refusal = [](std::string_view text) {
    return support::thrownMessage([&] { forEachCsvRow(text, "t.csv", [](const CsvRow&) {}); });
  };
  const std::string semicolons =
      "t.csv:2: fields are separated by semicolons; save the table with commas between fields and decimal points";
  EXPECT_EQ(refusal("\nt_s;x_mm\n0;1\n"), semicolons);
  EXPECT_EQ(refusal("\n0,5;1,25\n"), semicolons);
  EXPECT_EQ(refusal("t_s\tx_mm\n"), "t.csv:1: fields are separated by tabs; save the table with commas between them");
  EXPECT_EQ(refusal("0 1 2\n"), "t.csv:1: fields are separated by spaces; save the table with commas between them");
  EXPECT_EQ(refusal("a,b\n1,\"2\n"), "t.csv:2: a quoted field is not closed on its line; add the closing quote");
  EXPECT_EQ(refusal("a,b\n1,\"2\"\"3\"\n"),
            "t.csv:2: unexpected text after a quoted field; quotes inside a field are not supported");
  EXPECT_EQ(refusal(std::string_view("\xff\xfe"
                                     "a\0",
                                     4)),
            "t.csv:1: the text is UTF-16; save it as UTF-8");
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
