#include "palpate/maps/key_points.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/error_message.h"
#include "support/expect_each.h"

namespace palpate::maps {

std::string messageForTable(std::string_view table) {
  return support::thrownMessage([&] { parseKeyPoints(table, "keys.csv"); });
}

TEST(KeyPoints, ReadsATableWithAndWithoutStiffness) {
  const auto keys = parseKeyPoints(
      "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm\n"
      "P1, 0, 73, 179, 1.25, 90, 0.6\n"
      "P2, 1, -62, 149, 1.0, 200,\n",
      "keys.csv");
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].name, "P1");
  EXPECT_EQ(keys[0].ellipse.half_major_mm, 179.0);
  EXPECT_DOUBLE_EQ(keys[0].ellipse.aspect, 0.8);
  EXPECT_EQ(keys[0].stiffness_n_per_mm, 0.6);
  EXPECT_FALSE(keys[1].stiffness_n_per_mm);
  EXPECT_NEAR(keys[1].ellipse.direction_rad, 20.0 * std::numbers::pi / 180.0, 1e-12);
}

TEST(KeyPoints, RatioBelowOneSwapsTheAxes) {
  const auto key = parseKeyPoints("P, 0, 0, 100, 0.5, 90\n", "keys.csv").front();
  EXPECT_DOUBLE_EQ(key.ellipse.half_major_mm, 200.0);
  EXPECT_DOUBLE_EQ(key.ellipse.aspect, 0.5);
  EXPECT_NEAR(key.ellipse.direction_rad, 0.0, 1e-15);
}

TEST(KeyPoints, EmptyTableHasNoKeyPoints) { EXPECT_TRUE(parseKeyPoints("# nothing measured\n", "keys.csv").empty()); }

TEST(KeyPoints, ErrorsNameTheLineAndTheCause) {
  support::expectEach(
      messageForTable,
      {{"P1,0,0,100,1.2,90\nP2,0,0,100,1.2\n",
        "keys.csv:2: expected 6 or 7 fields "
        "(name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg[,stiffness_n_per_mm]), found 5"},
       {"P1,0,abc,100,1.2,90\n", "keys.csv:1: y_mm is not a number: 'abc'"},
       {"P1,0,0,-3,1.2,90\n", "keys.csv:1: half_major_mm = -3 is out of range: 0.001 to 10,000"},
       {"P1,0,0,100,0,90\n", "keys.csv:1: major_over_minor = 0 is out of range: 0.001 to 1,000"},
       {"P1,0,0,100,1,nan\n", "keys.csv:1: direction_deg must be finite, got nan"},
       {"P1,0,0,100,1,0,-1\n", "keys.csv:1: stiffness_n_per_mm = -1 is out of range: 0 to 1,000"},
       {"P1,1e300,0,100,1,0\n", "keys.csv:1: x_mm = 1e+300 is out of range: -100,000 to 100,000"},
       {"P1,0,0,100,1,1e12\n", "keys.csv:1: direction_deg = 1000000000000 is out of range: -360 to 360"},
       {"name,x_cm,y_mm,half_major_mm,major_over_minor,direction_deg\n",
        "keys.csv:1: expected the header "
        "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg[,stiffness_n_per_mm], found "
        "'name,x_cm,y_mm,half_major_mm,major_over_minor,direction_deg'"}});
}

TEST(KeyPoints, ATableOfMeasurementsIsReadByItsHeader) {
  const auto keys = parseKeyPoints(
      "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm,half_major_4_mm,peak_mm,tail_p,"
      "drift_mm,rim_mm,drag_deg,sd_half_major_mm,sd_ratio,sd_direction_deg,sd_half_major_4_mm,sd_peak_mm\n"
      "P1,0,73,79,1.25,-60,,55,18,0.8,0.3,,-120,1.5,0.02,1.5,1,0.8\n",
      "keys.csv");
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].ellipse.half_major_mm, 79.0);
  EXPECT_FALSE(keys[0].stiffness_n_per_mm);
  const auto stiff = parseKeyPoints(
      "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,peak_mm,stiffness_n_per_mm\nP1,0,73,79,1,0,18,0.5\n",
      "keys.csv");
  EXPECT_EQ(stiff[0].stiffness_n_per_mm, 0.5);
}

TEST(KeyPoints, APlaceWhereOnlyTheStiffnessWasMeasuredHasNoEllipse) {
  const auto keys = parseKeyPoints("P1,0,73,100,1.25,90,0.4\nP2,0,0,,,,0.6\n", "keys.csv");
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[1].ellipse.half_major_mm, 0.0);
  EXPECT_EQ(keys[1].stiffness_n_per_mm, 0.6);
  EXPECT_EQ(messageForTable("P1,0,73,100,,90,0.4\n"), "keys.csv:1: major_over_minor is not a number: ''");
}

TEST(KeyPoints, AMeasuredTableThatDoesNotFitItsHeaderIsRefused) {
  const std::string header = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,peak_mm,drag_deg";
  EXPECT_EQ(messageForTable(header + "\nP1,0,0,100,1,0,18\n"),
            "keys.csv:2: expected the 8 fields of the header, found 7");
  EXPECT_EQ(messageForTable(header + "\nP1,0,0,100,1,0,18,inf\n"), "keys.csv:2: drag_deg must be finite, got inf");
  EXPECT_EQ(messageForTable(header + "\nP1,0,0,100,1,0,18,up\n"), "keys.csv:2: drag_deg is not a number: 'up'");
  EXPECT_EQ(messageForTable(header + ",peak_mm\n"), "keys.csv:1: column peak_mm appears twice");
  EXPECT_EQ(messageForTable(header + ",colour\n"),
            "keys.csv:1: 'colour' is not a column of key points; expected "
            "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg, then any of stiffness_n_per_mm, "
            "half_major_4_mm, peak_mm, tail_p, drift_mm, rim_mm, drag_deg, sd_half_major_mm, sd_ratio, "
            "sd_direction_deg, sd_half_major_4_mm, sd_peak_mm");
}

TEST(KeyPoints, BuiltInOnesAreMirrored) {
  const auto keys = dissertationKeyPoints();
  ASSERT_EQ(keys.size(), 7u);
  for (const auto& [left, right] : {std::pair{3, 5}, std::pair{4, 6}}) {
    EXPECT_EQ(keys[left].position_mm.x(), -keys[right].position_mm.x());
    EXPECT_EQ(keys[left].position_mm.y(), keys[right].position_mm.y());
    EXPECT_EQ(keys[left].ellipse.half_major_mm, keys[right].ellipse.half_major_mm);
    EXPECT_NEAR(keys[left].ellipse.direction_rad + keys[right].ellipse.direction_rad, std::numbers::pi, 1e-12);
  }
}

}  // namespace palpate::maps
