// Rows of key points: what a measurement found, in the columns that maps read.
#include "palpate/measure/key_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"

namespace palpate::measure {
namespace {

Measurement rowMeasurement() {
  Measurement measurement;
  FieldFit fit;
  fit.at_2_mm = {2.0, {79.25, 1.5}, {63.4, 1.25}, {1.25, 0.02}, {-60.0, 1.5}};
  fit.at_4_mm = {4.0, {55.5, 0.5}, {44.4, 0.5}, {1.25, 0.02}, {-60.0, 1.5}};
  fit.peak_mm = {18.0, 0.75};
  fit.drag_deg = {-120.0, 1.0};
  fit.inverse_tail = {1.25, 0.1};
  fit.drift.length_mm = 0.3;
  measurement.fit = fit;
  return measurement;
}

std::string keyFieldOf(const Measurement& measurement, std::string_view column) {
  const std::string header = keyRowHeader();
  const std::string row = keyRow(measurement, "P1", {-12.0, 73.5});
  const auto names = split(trimmed(header), ',');
  const auto fields = split(trimmed(row), ',');
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == column) return std::string(fields.at(i));
  }
  return "no such column";
}

TEST(KeyRow, IsReadByTheMaps) {
  const auto keys = maps::parseKeyPoints(keyRowHeader() + keyRow(rowMeasurement(), "P1", {-12.0, 73.5}), "keys.csv");
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].name, "P1");
  EXPECT_EQ(keys[0].position_mm, Vec2(-12.0, 73.5));
  EXPECT_EQ(keys[0].ellipse.half_major_mm, 79.25);
  EXPECT_NEAR(keys[0].ellipse.aspect, 0.8, 1e-12);
  EXPECT_NEAR(keys[0].ellipse.direction_rad, 2.0 / 3.0 * std::numbers::pi, 1e-12);
  EXPECT_FALSE(keys[0].stiffness_n_per_mm);
}

TEST(KeyRow, HoldsWhatWasMeasuredBesideTheEllipse) {
  Measurement measurement = rowMeasurement();
  measurement.fit->gaussian_rim_mm = 130.0;
  for (const auto& [column, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"stiffness_n_per_mm", ""},
                                                                  {"half_major_4_mm", "55.5"},
                                                                  {"peak_mm", "18"},
                                                                  {"tail_p", "0.8"},
                                                                  {"drift_mm", "0.3"},
                                                                  {"rim_mm", "130"},
                                                                  {"drag_deg", "-120"},
                                                                  {"sd_half_major_mm", "1.5"},
                                                                  {"sd_ratio", "0.02"},
                                                                  {"sd_direction_deg", "1.5"},
                                                                  {"sd_half_major_4_mm", "0.5"},
                                                                  {"sd_peak_mm", "0.75"}}) {
    EXPECT_EQ(keyFieldOf(measurement, column), value) << column;
  }
}

TEST(KeyRow, WhatIsNotKnownIsEmpty) {
  Measurement measurement = rowMeasurement();
  measurement.fit->inverse_tail = {0.0, 0.1};
  measurement.fit->at_4_mm = {4.0, {0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}};
  measurement.fit->at_2_mm.direction_deg.sd = std::nan("");
  for (const char* column : {"tail_p", "rim_mm", "half_major_4_mm", "sd_half_major_4_mm", "sd_direction_deg"}) {
    EXPECT_EQ(keyFieldOf(measurement, column), "") << column;
  }
  EXPECT_EQ(maps::parseKeyPoints(keyRowHeader() + keyRow(measurement, "P1", {0.0, 0.0}), "keys.csv").size(), 1u);
  EXPECT_EQ(keyRow(Measurement(), "P1", {0.0, 0.0}), "");
}

TEST(KeyRow, NamesThatATableCannotHoldAreToldApart) {
  for (const char* name : {"", "a,b", "#1", "a\nb", " P1", "name"}) EXPECT_NE(faultOfKeyName(name), "") << name;
  for (const char* name : {"P1", "T6 right", "vor dem Stab ä"}) EXPECT_EQ(faultOfKeyName(name), "") << name;
}

}  // namespace
}  // namespace palpate::measure
