#include "palpate/base/csv.h"

#include <gtest/gtest.h>

#include "support/expect_each.h"

namespace palpate {
namespace {

TEST(CsvTextCell, IsNoFormula) {
  support::expectEach([](const std::string& text) { return csvTextCell(text); },
                      {{"=1+1", "'=1+1"},
                       {"=cmd|'/c calc'!A1", "'=cmd|'/c calc'!A1"},
                       {"@SUM(1)", "'@SUM(1)"},
                       {"-2+3", "'-2+3"},
                       {"+49 30 1", "'+49 30 1"},
                       {"\t=1", "'\t=1"},
                       {"\r=1", "\"'\r=1\""},
                       {"-inf", "'-inf"}});
  EXPECT_EQ(csvTextCell("\xef\xbc\x9d"
                        "1"),
            "'\xef\xbc\x9d"
            "1")
      << "an equals sign in full width";
  EXPECT_EQ(csvTextCell("=A(\"x\",1)"), "\"'=A(\"\"x\"\",1)\"");
}

TEST(CsvTextCell, LeavesNumbersAndWordsAsTheyAre) {
  for (const char* text : {"-1.5", "+2", "-1e-3", "index", "a=b", "", "left hand", "1-2"}) {
    EXPECT_EQ(csvTextCell(text), text);
  }
}

TEST(CsvTextCell, ForProgramsIsTheTextItself) {
  EXPECT_EQ(csvTextCell("=1+1", CsvText::raw), "=1+1");
  EXPECT_EQ(csvTextCell("=1,2", CsvText::raw), "\"=1,2\"");
}

}  // namespace
}  // namespace palpate
