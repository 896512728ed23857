// The study of stability: its sentences follow its numbers, and programs find the numbers by their names.
#include <gtest/gtest.h>

#include <cmath>

#include "dissertation/stability/stability_measurement.h"
#include "report/tests/report/says.h"

namespace palpate::study {

namespace {

using lab::Protection;

/// A loop that behaves.
StabilityMeasurement someStability() {
  StabilityMeasurement found;
  found.plan.systems = 100;
  found.theory = {{1000.0, 1.0, 0.133, 0.135}};
  for (const bool controlled : {false, true}) {
    found.onsets.push_back(
        {scene::DeviceModel::touch_x, 1.0, controlled, controlled ? 5.0 : 1.0, controlled ? 5.0 : 1.5});
    found.onsets.push_back(
        {scene::DeviceModel::touch_x, 2.0, controlled, controlled ? 2.5 : 0.5, controlled ? 2.5 : 0.9});
  }
  found.cells = {{{2.0, 1.0, false, Protection::assumed}, 0},
                 {{1.0, 2.0, false, Protection::assumed}, 3},
                 {{1.5, 1.0, true, Protection::assumed}, 0},
                 {{2.0, 1.0, false, Protection::none}, 20}};
  found.touches = {{scene::DeviceModel::touch_x, 3.0, false, {.first_force_n = 1.5, .port_energy_mj = 60.0}},
                   {scene::DeviceModel::touch_x, 3.0, true, {.first_force_n = 0.3, .port_energy_mj = 0.0}}};
  found.presses = {{scene::DeviceModel::touch_x, 1.0, -0.013, 0.02, 0.01},
                   {scene::DeviceModel::touch_x, 3.0, 0.05, 0.1, 0.01}};
  found.bare_swing_mm = 38.0;
  return found;
}

double numberNamed(const StabilityMeasurement& found, const std::string& name) {
  for (const auto& [key, value] : stabilityPairs(found)) {
    if (key == name) return value;
  }
  return std::nan("");
}

}  // namespace

TEST(StabilityStudy, SaysNoEnergyOnlyWhereThereIsNone) {
  StabilityMeasurement found = someStability();
  EXPECT_TRUE(says(stabilityFindings(found), "the device gives no energy"));
  found.touches[1].worst.port_energy_mj = 0.5;
  EXPECT_FALSE(says(stabilityFindings(found), "the device gives no energy"));
}

TEST(StabilityStudy, PraisesTheControllerOnlyWhereItHelps) {
  StabilityMeasurement found = someStability();
  EXPECT_TRUE(says(stabilityFindings(found), "more than twice as stiff"));
  found.onsets[2].dead_load = 1.1;
  EXPECT_FALSE(says(stabilityFindings(found), "more than twice as stiff"));
}

TEST(StabilityStudy, AgreesWithTheoryOnlyWithinFivePercent) {
  StabilityMeasurement found = someStability();
  EXPECT_TRUE(says(stabilityFindings(found), "as theory says"));
  found.theory[0].measured_n_per_mm = 0.2;
  EXPECT_FALSE(says(stabilityFindings(found), "as theory says"));
}

TEST(StabilityStudy, NamesItsNumbersForPrograms) {
  const StabilityMeasurement found = someStability();
  EXPECT_EQ(numberNamed(found, "random_hand_1_tick_2"), 0.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "random_hand_2_ticks_1"), 0.03);
  EXPECT_EQ(numberNamed(found, "random_dead_load_1_tick_1_5"), 0.0);
  EXPECT_EQ(numberNamed(found, "off_touch_x_dead_load_p2p_mm"), 38.0);
  EXPECT_EQ(numberNamed(found, "first_contact_force_n_max"), 0.3) << "of the controlled loop";
  EXPECT_EQ(numberNamed(found, "port_energy_mj_max"), 0.0);
  EXPECT_DOUBLE_EQ(numberNamed(found, "stiffness_bias_percent_max"), 1.3) << "up to 1 N/mm";
  EXPECT_NEAR(numberNamed(found, "theory_error_percent_max"), 1.5, 0.01);
}

TEST(StabilityStudy, CountsWhatTheMapAllowsApartFromWhatItRefuses) {
  std::vector<lab::StabilityCell> cells(2);
  cells[0].oscillates_bare = 4;
  cells[0].port_energy_mj_max = 0.005;
  cells[1].refused = "no stiffness is stable";
  cells[1].oscillates_bare = cells[1].oscillates_controlled = 7;
  cells[1].port_energy_mj_max = 50.0;
  EXPECT_EQ(computeTotals(cells).allowed, 1u);
  EXPECT_EQ(computeTotals(cells).oscillates_bare, 11u);
  EXPECT_EQ(computeTotals(cells).oscillates_allowed, 0u);
  EXPECT_EQ(computeTotals(cells).port_energy_allowed_mj_max, 0.005);
  EXPECT_EQ(computeTotals(cells).controlled_above_bare, 0u);
  EXPECT_TRUE(says(stabilityMapPage(lab::stabilityMapPlan(), cells).findings, "what is allowed holds"));
  const std::string json = toJson(stabilityMapPage(lab::stabilityMapPlan(), cells));
  for (const char* key : {"\"cells\": [", "\"oscillates_bare\": 4.0", "\"port_energy_mj_max\": 50.0"}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
  cells[0].oscillates_controlled = 5;
  EXPECT_EQ(computeTotals(cells).controlled_above_bare, 1u);
  EXPECT_TRUE(says(stabilityMapPage(lab::stabilityMapPlan(), cells).findings, "does not hold"));
}

}  // namespace palpate::study
