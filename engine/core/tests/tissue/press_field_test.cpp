// The field of a press as a key of a table, what a stranger's may not have, and the pattern of pressure.
#include "palpate/tissue/press_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "palpate/tissue/layered_table.h"
#include "palpate/tissue/library_fields.h"
#include "palpate/tissue/pressure_form.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

PressField smallField() {
  PressField field{.radii_mm = {0.0, 10.0},
                   .rows_mm = {0.0, 2.0, 2.0, 10.0},
                   .row_layers = {0, 0, 1, 1},
                   .depths_mm = {1.0, 2.0},
                   .patterns = {{2.0, 0.1}, {3.0, 0.2}},
                   .shear = {},
                   .volume = {}};
  for (std::size_t i = 0; i < field.size(); ++i) {
    field.shear.push_back(0.1F * static_cast<float>(i));
    field.volume.push_back(0.3F);
  }
  return field;
}

LayeredTable tableWithField() {
  LayeredTable table;
  table.stack.layers = {{"skin", 2.0, 150.0}, {"fat", 8.0, 10.0}};
  table.radii_mm = {0.0, 5.0, 40.0};
  table.shapes = {{2.0, 1.99, 0.31, 3.0, {1.0, 0.4, 0.0}, {0.0, -0.05, 0.01}}};
  table.field = smallField();
  return table;
}

template <class Change>
std::string fieldFaultAfter(const Change& change) {
  PressField field = smallField();
  change(field);
  return support::thrownMessage([&] { check(field, tableWithField().stack); });
}

TEST(PressField, IsWrittenAndReadWithEveryDigit) {
  const LayeredTable table = tableWithField();
  const std::string text = layeredTableText(table);
  const LayeredTable again = parseLayeredTable(text, "t.json");
  ASSERT_TRUE(again.field.has_value());
  EXPECT_EQ(again.field->shear, table.field->shear);
  EXPECT_EQ(again.field->row_layers, table.field->row_layers);
  EXPECT_EQ(again.field->patterns[1].exponent, 0.2);
  EXPECT_EQ(layeredTableText(again), text);
  LayeredTable without = table;
  without.field.reset();
  EXPECT_EQ(layeredTableText(without).find("field"), std::string::npos);
}

TEST(PressField, RefusesWhatMakesNoSense) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(fieldFaultAfter([](PressField&) {}), "no error");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.shear.pop_back(); }), "field: shear has 15 numbers, expected 16");
  EXPECT_EQ(fieldFaultAfter([&](PressField& f) { f.volume[3] = nan; }),
            "field: volume, number 4, = nan is out of range: 0 to 10");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.shear[0] = -1.0F; }),
            "field: shear, number 1, = -1 is out of range: 0 to 10");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.radii_mm[0] = 1.0; }), "field: radii_mm: the first must be 0");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.depths_mm[1] = 1.0; }),
            "field: depths_mm must increase, but 1 follows 1");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.patterns.pop_back(); }),
            "field: contact_radius_mm and pressure_exponent have 1 numbers for 2 depths");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.rows_mm[3] = 9.0; }),
            "field: the rows of layer 2 must go from its top at 2 mm to its bottom at 10 mm");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.row_layers[3] = 7; }),
            "field: the rows of layer 2 must go from its top at 2 mm to its bottom at 10 mm");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.row_layers.pop_back(); }),
            "field: row_layers has 3 numbers for 4 rows");
  EXPECT_EQ(fieldFaultAfter([](PressField& f) { f.depths_mm.assign(33, 1.0); }),
            "field: depths_mm: expected at most 32 values");
}

TEST(PressField, NamesThePlaceOfAFaultInAFile) {
  std::string text = layeredTableText(tableWithField());
  const auto fault = [&](const std::string& before, const std::string& after) {
    std::string changed = text;
    const std::size_t at = changed.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    changed.replace(at, before.size(), after);
    return support::thrownMessage([&] { parseLayeredTable(changed, "t.json"); });
  };
  EXPECT_NE(fault("\"row_layers\": [0", "\"row_layers\": [0.5").find("whole numbers"), std::string::npos);
  EXPECT_NE(fault("\"shear\": [", "\"shear\": [\"a\", ").find("must be a list of numbers"), std::string::npos);
  EXPECT_NE(fault("\"volume\":", "\"volumes\":").find("has no \"volume\""), std::string::npos);
  EXPECT_NE(fault("\"row_layers\": [0", "\"row_layers\": [1e300").find("whole numbers"), std::string::npos);
}

TEST(PressField, IsNotInterpolatedAcrossTheBordersOfLayers) {
  const PressField field = smallField();
  const auto shear = [&](double depth) { return densityAt(field, placeAt(field, rowAt(field, depth), 0.0), 0).shear; };
  EXPECT_NEAR(shear(2.0 - 1e-9), std::pow(0.4, 4), 1e-6) << "the skin's last row";
  EXPECT_NEAR(shear(2.0), std::pow(0.8, 4), 1e-6) << "the fat's first row";
  EXPECT_EQ(shear(10.0), 0.0) << "bone";
  EXPECT_EQ(densityAt(field, placeAt(field, rowAt(field, 5.0), 11.0), 0).shear, 0.0) << "far away";
}

TEST(PressureForm, CarriesItsForceWhereItTouches) {
  const PressureForm form(libraryFieldsAt(40.0, 8.0));
  const PressurePattern pattern = form.at(5.0);
  EXPECT_NEAR(pattern.contact_radius_mm, 5.1, 0.2);
  constexpr double kStep = 0.001;
  double sum = 0.0;
  for (double r = 0.5 * kStep; r < 10.0; r += kStep)
    sum += pressureAt(pattern, 1.3, r) * 2.0 * std::numbers::pi * r * kStep;
  EXPECT_NEAR(1e-3 * sum, 1.3, 0.005);
  EXPECT_EQ(pressureAt(pattern, 1.3, 9.0), 0.0);
  EXPECT_EQ(form.at(0.0).contact_radius_mm, 0.0);
  EXPECT_EQ(form.at(20.0).contact_radius_mm, form.at(12.0).contact_radius_mm);
  EXPECT_NEAR(form.at(5.0, 4.0).contact_radius_mm, std::min(3.96, pattern.contact_radius_mm / std::sqrt(2.0)), 1e-12);
}

TEST(PressureForm, HasABumpThatWidensWithDepthAndSize) {
  const LumpShape small{.half_axes_mm = {1.5, 1.5, 1.5}, .depth_mm = 3.0};
  const LumpShape deep{.half_axes_mm = {5.0, 5.0, 5.0}, .depth_mm = 12.0};
  EXPECT_NEAR(bumpWidth(small, 2.0, 5.0), 0.66 + 0.78 * 1.5 + 0.92 - 0.6, 1e-9);
  EXPECT_GT(bumpWidth(deep, 2.0, 5.0), 10.0);
  EXPECT_EQ(bumpAt(0.0, 2.0), 1.0);
  EXPECT_NEAR(bumpAt(2.0, 2.0), std::pow(2.0, -2.5), 1e-12);
  EXPECT_NEAR(bumpBase({4.0, 0.1}, 0.0, 2.0), 0.53 * std::pow(2.0, -2.5), 1e-12);
}

}  // namespace
}  // namespace palpate::tissue
