// Tables of dots: what a person or another program may hand over in place of photographs.
#include "palpate/measure/tables/dot_table.h"

#include <gtest/gtest.h>

#include "support/error_message.h"

namespace palpate::measure {
namespace {

std::string tableRefusal(std::string_view table) {
  return support::thrownMessage([&] { parseDotTable(table, "dots.csv"); });
}

TEST(DotTable, IsReadWithAndWithoutAreas) {
  const DotPair pair = parseDotTable(
      "picture,x_px,y_px,area_px\nbefore,1.5,2,30\n# moved by hand\nafter,3,-4,\nbefore, 5, 6, 0\n", "dots.csv");
  ASSERT_EQ(pair.before.size(), 2u);
  ASSERT_EQ(pair.after.size(), 1u);
  EXPECT_EQ(pair.before[0].place_px, Vec2(1.5, 2.0));
  EXPECT_EQ(pair.before[0].area_px, 30.0);
  EXPECT_EQ(pair.before[1].place_px, Vec2(5.0, 6.0));
  EXPECT_EQ(pair.after[0].place_px, Vec2(3.0, -4.0));
  EXPECT_EQ(pair.after[0].area_px, 0.0);
  EXPECT_EQ(parseDotTable("picture,x_px,y_px\nbefore,1,2\nafter,1,2\n", "dots.csv").before.size(), 1u);
}

TEST(DotTable, ErrorsNameTheLineAndTheCause) {
  EXPECT_EQ(tableRefusal("before,1,2\n"),
            "dots.csv:1: expected the header picture,x_px,y_px[,area_px], found 'before,1,2'");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px,colour\n"),
            "dots.csv:1: expected the header picture,x_px,y_px[,area_px], found 'picture,x_px,y_px,colour'");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nbefore,1,2,3\n"),
            "dots.csv:2: expected the 3 fields of the header, found 4");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nlater,1,2\n"), "dots.csv:2: picture 'later' must be before or after");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nbefore,1,x\n"), "dots.csv:2: y_px is not a number: 'x'");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nbefore,1,nan\n"), "dots.csv:2: y_px must be finite, got nan");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nbefore,1e7,1\n"),
            "dots.csv:2: x_px = 10000000 is out of range: -100,000 to 100,000");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\nbefore,1,2\n"), "dots.csv: has no dots of the picture after");
  EXPECT_EQ(tableRefusal("picture,x_px,y_px\n"), "dots.csv: has no dots of the picture before");
}

TEST(DotTable, TooManyDotsAreRefusedBeforeTheyAreOrdered) {
  std::string table = "picture,x_px,y_px\n";
  for (std::size_t i = 0; i <= kMaxTableMarks; ++i) table += "before,1,2\n";
  EXPECT_EQ(tableRefusal(table), "dots.csv:20002: too many dots for one picture; at most 20000");
}

TEST(DotTable, HoldsAllMarksOfAMeasurement) {
  Measurement measurement;
  measurement.grid.dots = {{{0, 0}, {{10.0, 20.0}, 30.0}}, {{1, 0}, {{50.0, 20.0}, 31.0}}};
  measurement.grid.strays = {{{7.0, 8.0}, 9.0}};
  measurement.after_dots = {{{11.5, 21.25}, 30.0}};
  const DotPair pair = parseDotTable(formatDotTable(measurement), "dots.csv");
  ASSERT_EQ(pair.before.size(), 3u);
  ASSERT_EQ(pair.after.size(), 1u);
  EXPECT_EQ(pair.before[2].place_px, Vec2(7.0, 8.0));
  EXPECT_EQ(pair.after[0].place_px, Vec2(11.5, 21.25));
  EXPECT_EQ(pair.after[0].area_px, 30.0);
}

}  // namespace
}  // namespace palpate::measure
