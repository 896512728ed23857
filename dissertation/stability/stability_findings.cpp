#include "dissertation/stability/stability_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/scene/words.h"
#include "report/page/study_page.h"

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

std::string theoryFinding(const StabilityMeasurement& found) {
  const double error = numbersOf(found).theory_error_percent;
  return fmt::format(
      "An ideal device (no friction, no encoder) stops resting at b / (T/2 + t_d) {}: the worst of {} cases is off by "
      "{} %.",
      error <= 5.0 ? "as theory says" : "only roughly", found.theory.size(), rounded(error));
}

std::string onsetFinding(const StabilityMeasurement& found) {
  const double off = onsetRange(found, 1.0, false, &OnsetRow::dead_load).least;
  const double on = onsetRange(found, 1.0, true, &OnsetRow::dead_load).least;
  const double off_hand = onsetRange(found, 1.0, false, &OnsetRow::worst_hand).least;
  const double on_hand = onsetRange(found, 1.0, true, &OnsetRow::worst_hand).least;
  return fmt::format(
      "With one tick of delay the hardest device stops resting at {} N/mm under a dead load and {} N/mm in a hand "
      "without the "
      "controller, at {} and {} N/mm with it{}.",
      rounded(off), rounded(off_hand), rounded(on), rounded(on_hand),
      on > 2.0 * off && on_hand > 2.0 * off_hand ? ", more than twice as stiff" : "");
}

std::string delayFinding(const StabilityMeasurement& found) {
  const double one = onsetRange(found, 1.0, true, &OnsetRow::worst_hand).least;
  const double two = onsetRange(found, 2.0, true, &OnsetRow::worst_hand).least;
  return fmt::format("A second tick of delay lowers that to {} N/mm in a hand{}.", rounded(two),
                     two < 0.7 * one ? ": delay costs more than anything else" : "");
}

std::string randomFinding(const StabilityMeasurement& found) {
  const double hand = oscillatingShare(found, {2.0, 1.0, false, Protection::assumed});
  const double late = oscillatingShare(found, {1.0, 2.0, false, Protection::assumed});
  const double dead = oscillatingShare(found, {1.5, 1.0, true, Protection::assumed});
  const double bare = oscillatingShare(found, {2.0, 1.0, false, Protection::none});
  return fmt::format(
      "Of {} random devices and hands, of which the loop knows only the nominal device, {} oscillate at 2 N/mm and one "
      "tick "
      "({} without the controller), {} at 1 N/mm and two ticks, {} under a dead load at 1.5 N/mm.",
      found.plan.systems, percent(hand), percent(bare), percent(late), percent(dead));
}

std::string touchFinding(const StabilityMeasurement& found) {
  const StabilityNumbers numbers = numbersOf(found);
  double bare_force = 0.0;
  double bare_energy = 0.0;
  for (const TouchRow& row : found.touches) {
    if (row.controlled) continue;
    bare_force = std::max(bare_force, row.worst.first_force_n);
    bare_energy = std::max(bare_energy, row.worst.port_energy_mj);
  }
  return fmt::format(
      "A touch at 0.5 m/s on 1 to 3 N/mm: at most {} N in its first tick ({} N bare), and the device gives {} ({} mJ "
      "bare).",
      rounded(numbers.first_contact_force_n), rounded(bare_force),
      numbers.port_energy_mj <= 0.01 ? "no energy" : fmt::format("{} mJ", rounded(numbers.port_energy_mj)),
      rounded(bare_energy));
}

std::string feelFinding(const StabilityMeasurement& found) {
  double noise = 0.0;
  for (const PressRow& row : found.presses) {
    if (row.stiffness_n_per_mm <= 1.0) noise = std::max(noise, row.noise_n);
  }
  return fmt::format(
      "What is felt is still the skin: up to 1 N/mm the slope of force over true depth is within {} %, with at most {} "
      "N of noise above "
      "20 Hz.",
      rounded(numbersOf(found).stiffness_bias_percent), rounded(noise));
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
  return {onsetFinding(found), delayFinding(found), randomFinding(found),
          touchFinding(found), feelFinding(found),  theoryFinding(found)};
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
