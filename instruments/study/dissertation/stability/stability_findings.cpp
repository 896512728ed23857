// Fills in the sentences of stability_findings.txt and the verdicts that the numbers decide.
#include "dissertation/stability/stability_measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

using lab::Protection;

Extent onsetRange(const StabilityMeasurement& found, double delay, bool controlled, double OnsetRow::*who) {
  Extent range;
  for (const OnsetRow& row : found.onsets) {
    if (row.delay_ticks == delay && row.controlled == controlled) range.add(row.*who);
  }
  return range;
}

FindingValues onsetOfOscillation(const StabilityMeasurement& found) {
  const double off = onsetRange(found, 1.0, false, &OnsetRow::dead_load).least;
  const double on = onsetRange(found, 1.0, true, &OnsetRow::dead_load).least;
  const double off_hand = onsetRange(found, 1.0, false, &OnsetRow::worst_hand).least;
  const double on_hand = onsetRange(found, 1.0, true, &OnsetRow::worst_hand).least;
  return {{"bare_load", off},
          {"bare_hand", off_hand},
          {"load", on},
          {"hand", on_hand},
          {"twice", on > 2.0 * off && on_hand > 2.0 * off_hand}};
}

FindingValues randomLoops(const StabilityMeasurement& found) {
  return {{"systems", found.plan.systems},
          {"hand", oscillatingShare(found, {2.0, 1.0, false, Protection::assumed})},
          {"bare", oscillatingShare(found, {2.0, 1.0, false, Protection::none})},
          {"late", oscillatingShare(found, {1.0, 2.0, false, Protection::assumed})},
          {"load", oscillatingShare(found, {1.5, 1.0, true, Protection::assumed})}};
}

FindingValues touchesAtSpeed(const StabilityMeasurement& found) {
  const StabilityNumbers numbers = numbersOf(found);
  double bare_force = 0.0;
  double bare_energy = 0.0;
  for (const TouchRow& row : found.touches) {
    if (row.controlled) continue;
    bare_force = std::max(bare_force, row.worst.first_force_n);
    bare_energy = std::max(bare_energy, row.worst.port_energy_mj);
  }
  return {{"force_n", numbers.first_contact_force_n},
          {"bare_force_n", bare_force},
          {"gives", numbers.port_energy_mj > 0.01},
          {"energy_mj", numbers.port_energy_mj},
          {"bare_energy_mj", bare_energy}};
}

double noiseOfSoftPresses(const StabilityMeasurement& found) {
  double noise = 0.0;
  for (const PressRow& row : found.presses) {
    if (row.stiffness_n_per_mm <= 1.0) noise = std::max(noise, row.noise_n);
  }
  return noise;
}

}  // namespace

StabilityNumbers numbersOf(const StabilityMeasurement& found) {
  StabilityNumbers numbers;
  for (const TheoryRow& row : found.theory) {
    numbers.theory_error_percent =
        std::max(numbers.theory_error_percent, 100.0 * std::abs(row.measured_n_per_mm / row.theory_n_per_mm - 1.0));
  }
  for (const TouchRow& row : found.touches) {
    if (!row.controlled) continue;
    numbers.first_contact_force_n = std::max(numbers.first_contact_force_n, row.worst.first_force_n);
    numbers.port_energy_mj = std::max(numbers.port_energy_mj, row.worst.port_energy_mj);
  }
  for (const PressRow& row : found.presses) {
    if (row.stiffness_n_per_mm > 1.0) continue;
    numbers.stiffness_bias_percent = std::max(numbers.stiffness_bias_percent, 100.0 * std::abs(row.bias));
  }
  return numbers;
}

double oscillatingShare(const StabilityMeasurement& found, const lab::RandomCell& cell) {
  for (const CellRow& row : found.cells) {
    if (row.cell.stiffness_n_per_mm == cell.stiffness_n_per_mm && row.cell.delay_ticks == cell.delay_ticks &&
        row.cell.dead_load == cell.dead_load && row.cell.protection == cell.protection) {
      return static_cast<double>(row.oscillate) / static_cast<double>(found.plan.systems);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> stabilityFindings(const StabilityMeasurement& found) {
  const StabilityNumbers numbers = numbersOf(found);
  const double error = numbers.theory_error_percent;
  const double one = onsetRange(found, 1.0, true, &OnsetRow::worst_hand).least;
  const double two = onsetRange(found, 2.0, true, &OnsetRow::worst_hand).least;
  return formatFindings(
      texts::stability_findings,
      {{"onset", onsetOfOscillation(found)},
       {"delay", {{"hand", two}, {"costly", two < 0.7 * one}}},
       {"random", randomLoops(found)},
       {"touch", touchesAtSpeed(found)},
       {"feel", {{"bias_percent", numbers.stiffness_bias_percent}, {"noise_n", noiseOfSoftPresses(found)}}},
       {"theory", {{"holds", error <= 5.0}, {"cases", found.theory.size()}, {"error_percent", error}}}});
}

std::vector<std::pair<std::string, double>> stabilityPairs(const StabilityMeasurement& found) {
  const StabilityNumbers numbers = numbersOf(found);
  return {{"random_hand_1_tick_2", oscillatingShare(found, {2.0, 1.0, false, Protection::assumed})},
          {"random_hand_2_ticks_1", oscillatingShare(found, {1.0, 2.0, false, Protection::assumed})},
          {"random_dead_load_1_tick_1_5", oscillatingShare(found, {1.5, 1.0, true, Protection::assumed})},
          {"off_touch_x_dead_load_p2p_mm", found.bare_swing_mm},
          {"first_contact_force_n_max", numbers.first_contact_force_n},
          {"port_energy_mj_max", numbers.port_energy_mj},
          {"stiffness_bias_percent_max", numbers.stiffness_bias_percent},
          {"theory_error_percent_max", numbers.theory_error_percent}};
}

}  // namespace palpate::study
