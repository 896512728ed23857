// The study of stability: maps of the motion after a kick, onsets by device and rate, random systems, taps and presses.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dissertation/stability/stability_measurement.h"
#include "palpate/scene/words.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using device::HandKind;
using lab::Protection;

/// Less motion than this is drawn as rest, um.
constexpr double kMinMotion = 0.1;

std::string handTitle(HandKind hand) { return hand == HandKind::dead_load ? "dead load" : "stylus, fore and aft"; }

std::vector<figures::Tick> stiffnessTicks() {
  std::vector<figures::Tick> ticks;
  for (const double value : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) ticks.push_back({std::log10(value), rounded(value)});
  return ticks;
}

// ------------------------------------------------------------------------------------------------------------ plots

/// K = b / (T/2 + t_d) at 1 kHz over the delay, as far as the map reaches, and the line of friction and encoder.
std::vector<Series> theoryLines(const StabilityPlan& plan) {
  constexpr int kPoints = 60;
  lab::LoopPlan loop;
  loop.device = device::profileOf(kMappedDevice);
  Series line{.name = "b / (T/2 + t_d)", .stroke = Stroke::solid, .colour = figures::kOrange, .width_px = 2.2};
  Series friction{.name = "min(2b/T, 2c/step)", .stroke = Stroke::dashed, .colour = figures::kSky, .width_px = 2.2};
  const double bound = lab::frictionLimit(loop);
  for (int i = 0; i <= kPoints; ++i) {
    loop.delay_ticks = plan.delays.back() * i / kPoints;
    const double height = std::log10(lab::linearLimit(loop));
    if (height >= -1.0) {
      line.x.push_back(loop.delay_ticks);
      line.y.push_back(height);
    }
    friction.x.push_back(loop.delay_ticks);
    friction.y.push_back(std::log10(bound));
  }
  return {line, friction};
}

Plot mapPlot(const StabilityPlan& plan, const MotionMap& map) {
  Plot plot{.title = fmt::format("{}, {}", handTitle(map.hand), map.controlled ? "controlled" : "bare")};
  plot.x = {.label = "delay", .unit = "ticks of 1 ms", .from = plan.delays.front(), .to = plan.delays.back()};
  plot.y = {.label = "stiffness", .unit = "N/mm", .from = -1.0, .to = 1.0, .ticks = stiffnessTicks()};
  figures::Field field;
  field.columns = static_cast<int>(plan.delays.size());
  field.rows = static_cast<int>(plan.stiffness.size());
  field.origin = {plan.delays.front(), -1.0};
  field.step = {plan.delays[1] - plan.delays[0], 2.0 / (field.rows - 1)};
  for (const double motion : map.motion_um) field.values.push_back(std::log10(std::max(kMinMotion, motion)));
  field.label = "motion, 10^x um";
  field.from = -1.0;
  field.to = 5.0;
  plot.field = std::move(field);
  plot.series = theoryLines(plan);
  return plot;
}

Plot ratePlot(const StabilityMeasurement& found) {
  Plot plot{.title = "Where it stops resting, one tick of delay"};
  plot.x = {.label = "rate",
            .unit = "Hz",
            .scale = Scale::logarithmic,
            .from = found.plan.rates.front(),
            .to = found.plan.rates.back()};
  plot.x.ticks = ticksAt(found.plan.rates);
  plot.y = {.label = "stiffness", .unit = "N/mm", .scale = Scale::logarithmic, .from = 0.02, .to = 20.0};
  plot.y.ticks = ticksAt({0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0});
  const std::vector<double> rates = column(found.rates, &RateRow::ticks_per_s);
  plot.series.push_back(
      dissertationSeries("b / (T/2 + t_d)", rates, column(found.rates, &RateRow::line), Marker::none));
  plot.series.push_back(
      dissertationSeries("min(2b/T, 2c/step)", rates, column(found.rates, &RateRow::friction_line), Marker::cross));
  plot.series.push_back(
      measuredSeries("dead load, bare", rates, column(found.rates, &RateRow::off_dead), Marker::square));
  plot.series.push_back(measuredSeries("hand, bare", rates, column(found.rates, &RateRow::off_hand), Marker::diamond));
  plot.series.push_back(
      measuredSeries("dead load, controlled", rates, column(found.rates, &RateRow::on_dead), Marker::circle));
  plot.series.push_back(
      measuredSeries("hand, controlled", rates, column(found.rates, &RateRow::on_hand), Marker::triangle));
  return plot;
}

Plot devicePlot(const StabilityMeasurement& found) {
  Plot plot{.title = "The worst of three hands, one tick at 1 kHz"};
  plot.x = {.label = "device", .from = -0.6, .to = static_cast<double>(found.plan.devices.size()) - 0.4};
  plot.y = {.label = "stiffness", .unit = "N/mm", .from = 0.0, .to = 12.0};
  std::vector<double> places;
  std::vector<double> off;
  std::vector<double> on;
  for (const OnsetRow& row : found.onsets) {
    if (row.delay_ticks != 1.0) continue;
    (row.controlled ? on : off).push_back(std::min(row.dead_load, row.worst_hand));
    if (row.controlled) continue;
    plot.x.ticks.push_back({static_cast<double>(places.size()), std::string(wordFor(row.device))});
    places.push_back(static_cast<double>(places.size()));
  }
  std::vector<double> left = places;
  std::vector<double> right = places;
  for (double& place : left) place -= 0.2;
  for (double& place : right) place += 0.2;
  plot.shapes = {figures::bars("bare", left, off, 0.38, figures::kVermilion),
                 figures::bars("controlled", right, on, 0.38, figures::kBlue)};
  return plot;
}

std::vector<StudyFigure> makeFigures(const StabilityMeasurement& found) {
  Figure maps{.columns = 2};
  for (const MotionMap& map : found.maps) maps.panels.emplace_back(mapPlot(found.plan, map));
  return {{"stability_map",
           "Motion of a simulated Touch X from 0.4 to 0.8 s after a kick of 1 N for 4 ms, pressed by 1 N. Dark is "
           "rest; one step of its assumed encoder is 1.4 on the scale.",
           maps},
          {"stability_rate", "The stiffness at which the same device stops resting, by the loop's rate.",
           Figure{.panels = {ratePlot(found)}, .panel_width_px = 640.0}},
          {"stability_devices",
           "The least stiffness at which a device stops resting, dead load or hand; 11.5 is the most that was tried.",
           Figure{.panels = {devicePlot(found)}, .panel_width_px = 760.0}}};
}

// ----------------------------------------------------------------------------------------------------------- tables

std::string onsetText(double stiffness) {
  return stiffness >= kMaxStiffness ? "> 11.5" : fmt::format("{:.2f}", stiffness);
}

TextTable onsetTable(const StabilityMeasurement& found) {
  TextTable table{{"device", "delay (ticks)", "controller", "dead load (N/mm)", "worst hand (N/mm)"}, {}};
  for (const OnsetRow& row : found.onsets) {
    table.rows.push_back({std::string(wordFor(row.device)), fmt::format("{}", row.delay_ticks),
                          row.controlled ? "on" : "off", onsetText(row.dead_load), onsetText(row.worst_hand)});
  }
  return table;
}

TextTable cellTable(const StabilityMeasurement& found) {
  TextTable table{{"user", "delay (ticks)", "stiffness (N/mm)", "controller", "oscillate"}, {}};
  for (const CellRow& row : found.cells) {
    table.rows.push_back({row.cell.dead_load ? "dead load" : "hand", fmt::format("{}", row.cell.delay_ticks),
                          fmt::format("{}", row.cell.stiffness_n_per_mm),
                          row.cell.protection == Protection::none ? "off" : "on",
                          fmt::format("{} of {}", row.oscillate, found.plan.systems)});
  }
  return table;
}

TextTable touchTable(const StabilityMeasurement& found) {
  TextTable table{{"device", "stiffness (N/mm)", "controller", "first tick (N)", "greatest step (N)",
                   "port energy (mJ)", "bounces"},
                  {}};
  for (const TouchRow& row : found.touches) {
    table.rows.push_back({std::string(wordFor(row.device)), fmt::format("{}", row.stiffness_n_per_mm),
                          row.controlled ? "on" : "off", fmt::format("{:.2f}", row.worst.first_force_n),
                          fmt::format("{:.2f}", row.worst.greatest_step_n),
                          fmt::format("{:.2f}", row.worst.port_energy_mj), fmt::format("{}", row.worst.bounces)});
  }
  return table;
}

TextTable pressTable(const StabilityMeasurement& found) {
  TextTable table{{"device", "stiffness (N/mm)", "bias (%)", "hysteresis (%)", "noise above 20 Hz (N)"}, {}};
  for (const PressRow& row : found.presses) {
    table.rows.push_back({std::string(wordFor(row.device)), fmt::format("{}", row.stiffness_n_per_mm),
                          fmt::format("{:.1f}", 100.0 * row.bias), fmt::format("{:.1f}", 100.0 * row.hysteresis),
                          fmt::format("{:.3f}", row.noise_n)});
  }
  return table;
}

TextTable theoryTable(const StabilityMeasurement& found) {
  TextTable table{{"rate (Hz)", "delay (ticks)", "theory (N/mm)", "measured (N/mm)", "ratio"}, {}};
  for (const TheoryRow& row : found.theory) {
    table.rows.push_back({fmt::format("{}", row.ticks_per_s), fmt::format("{}", row.delay_ticks),
                          fmt::format("{:.3f}", row.theory_n_per_mm), fmt::format("{:.3f}", row.measured_n_per_mm),
                          fmt::format("{:.3f}", row.measured_n_per_mm / row.theory_n_per_mm)});
  }
  return table;
}

std::vector<std::string> describeMethod(const StabilityMeasurement& found) {
  return {
      "Everything goes through the product's own tick: contact on a flat plate, the limiter, and a simulated device "
      "with a hand on it (`device/simulated_hand.h`), integrated in 40 steps a tick, with delay, hold, encoder, "
      "saturation and Coulomb friction. Bare is the same loop without toe and passivity. The controller knows the "
      "nominal device, trusts a quarter of its damping and a tenth of its friction, and assumes one tick of delay "
      "more than there is.",
      fmt::format("A kick is 1 N for 4 ms on a device that is pressed by 1 N; it oscillates when it moves by more "
                  "than two encoder steps 0.4 to 0.8 s later. Stiffnesses are tried in steps of {} %. Random "
                  "systems: mass +-30 %, damping 0.1 to 2 times, friction 0.5 to 1.5 times the nominal, amplifier "
                  "lag to 0.5 ms, jitter to a quarter of a tick, hands within the spread of people; fixed seeds. "
                  "Taps come in {} phases of the sampling.",
                  rounded(100.0 * (found.plan.onset_factor - 1.0)), found.plan.phases),
      "Not in the model: structural resonances, cable friction, gravity, motor heating, reflexes. All of a device's "
      "mechanics is assumed. Real limits are lower."};
}

}  // namespace

StudyPage studyStability(const StudySettings& settings) {
  if (settings.map) return studyStabilityMap(settings);
  const StabilityMeasurement found = measureStability(stabilityPlan(settings.quick), settings.progress);
  return {.title = "A loop that is safe to touch",
          .question =
              "A sampled spring gives more than it takes, and a delay makes that worse. Up to which stiffness does a "
              "device come to rest in a hand, and what does the servo's controller change?",
          .findings = stabilityFindings(found),
          .method = describeMethod(found),
          .tables = {{"stability_random", "Random devices and hands.", cellTable(found)},
                     {"stability_onsets", "Where a device stops resting after a kick.", onsetTable(found)},
                     {"stability_taps", "A touch at 0.5 m/s: the worst of five hands.", touchTable(found)},
                     {"stability_presses", "Pressed at 1 Hz with a tremor, controlled: the worst of three hands.",
                      pressTable(found)},
                     {"stability_theory", "An ideal device against theory.", theoryTable(found), false}},
          .figures = makeFigures(found),
          .numbers = stabilityPairs(found),
          .numbers_on_top = true};
}

}  // namespace palpate::study
