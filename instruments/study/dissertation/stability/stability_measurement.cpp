// Every number comes from the product's own tick and limiter (instruments/study/lab/loops). One thread; the same
// numbers on every machine.
#include "dissertation/stability/stability_measurement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::study {

namespace {

using device::HandKind;
using lab::LoopPlan;
using lab::Protection;

constexpr std::array kStudiedHands{HandKind::stylus_x, HandKind::stylus_y, HandKind::stylus_z, HandKind::thimble,
                                   HandKind::arm};
constexpr double kMinStiffness = 0.1;

LoopPlan loopPlan(scene::DeviceModel device, HandKind hand, bool controlled) {
  LoopPlan plan;
  plan.device = device::profileOf(device);
  plan.hand = device::handModel(hand);
  plan.protection = controlled ? Protection::assumed : Protection::none;
  return plan;
}

std::vector<TheoryRow> measuredTheory() {
  std::vector<TheoryRow> rows;
  for (const double mass_kg : {0.05, 0.2}) {
    for (const double rate : {500.0, 1000.0}) {
      for (const double delay : {0.0, 1.0, 2.0}) {
        const LoopPlan plan = lab::idealPlan(mass_kg, 0.2e-3, rate, delay);
        const double line = lab::linearLimit(plan);
        rows.push_back({rate, delay, line, lab::growthOnset(plan, 0.7 * line, 1.4 * line)});
      }
    }
  }
  return rows;
}

double worstHand(LoopPlan plan, double factor) {
  double least = kMaxStiffness;
  for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z, HandKind::thimble}) {
    plan.hand = device::handModel(hand);
    least = std::min(least, lab::oscillationOnset(plan, kMinStiffness, least, factor));
  }
  return least;
}

OnsetRow measuredOnset(scene::DeviceModel device, double delay, bool controlled, double factor) {
  LoopPlan plan = loopPlan(device, HandKind::dead_load, controlled);
  plan.delay_ticks = delay;
  OnsetRow row{device, delay, controlled};
  row.dead_load = lab::oscillationOnset(plan, kMinStiffness, kMaxStiffness, factor);
  row.worst_hand = worstHand(plan, factor);
  return row;
}

MotionMap measuredMap(const StabilityPlan& plan, HandKind hand, bool controlled) {
  MotionMap map{hand, controlled, {}};
  LoopPlan loop = loopPlan(kMappedDevice, hand, controlled);
  for (const double stiffness : plan.stiffness) {
    for (const double delay : plan.delays) {
      loop.plate.stiffness_n_per_mm = stiffness;
      loop.delay_ticks = delay;
      map.motion_um.push_back(1000.0 * lab::kick(loop).peak_to_peak_mm);
    }
  }
  return map;
}

RateRow measuredRate(double ticks_per_s, double factor) {
  RateRow row{.ticks_per_s = ticks_per_s};
  LoopPlan plan = loopPlan(kMappedDevice, HandKind::dead_load, false);
  plan.ticks_per_s = ticks_per_s;
  row.line = lab::linearLimit(plan);
  row.friction_line = lab::frictionLimit(plan);
  for (const bool controlled : {false, true}) {
    plan.protection = controlled ? Protection::assumed : Protection::none;
    plan.hand = device::handModel(HandKind::dead_load);
    (controlled ? row.on_dead : row.off_dead) = lab::oscillationOnset(plan, 0.05, kMaxStiffness, factor);
    plan.hand = device::handModel(HandKind::stylus_z);
    (controlled ? row.on_hand : row.off_hand) = lab::oscillationOnset(plan, 0.05, kMaxStiffness, factor);
  }
  return row;
}

TouchRow measuredTouch(scene::DeviceModel device, double stiffness, bool controlled, int phases) {
  TouchRow row{device, stiffness, controlled, {}};
  for (const HandKind hand : kStudiedHands) {
    LoopPlan plan = loopPlan(device, hand, controlled);
    plan.plate.stiffness_n_per_mm = stiffness;
    for (int phase = 0; phase < phases; ++phase) {
      row.worst.mergeWorst(lab::tap(plan, 500.0, static_cast<double>(phase) / phases));
    }
  }
  return row;
}

PressRow measuredPress(scene::DeviceModel device, double stiffness) {
  PressRow row{device, stiffness};
  for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z, HandKind::thimble}) {
    LoopPlan plan = loopPlan(device, hand, true);
    plan.plate.stiffness_n_per_mm = stiffness;
    const lab::PressResult one = lab::press(plan);
    if (std::abs(one.stiffness_bias) > std::abs(row.bias)) row.bias = one.stiffness_bias;
    if (std::abs(one.hysteresis) > std::abs(row.hysteresis)) row.hysteresis = one.hysteresis;
    row.noise_n = std::max(row.noise_n, one.noise_n);
  }
  return row;
}

std::vector<CellRow> cellsToMeasure(bool every) {
  std::vector<CellRow> cells;
  if (!every) {
    return {{{2.0, 1.0, false, Protection::none}},
            {{2.0, 1.0, false, Protection::assumed}},
            {{1.0, 2.0, false, Protection::assumed}},
            {{1.5, 1.0, true, Protection::assumed}}};
  }
  for (const Protection protection : {Protection::none, Protection::assumed}) {
    for (const double stiffness : {1.0, 2.0, 3.0}) cells.push_back({{stiffness, 1.0, false, protection}});
    for (const double stiffness : {1.0, 2.0}) cells.push_back({{stiffness, 2.0, false, protection}});
    for (const double stiffness : {1.0, 1.5, 2.0}) cells.push_back({{stiffness, 1.0, true, protection}});
  }
  return cells;
}

double logarithmic(double from, double to, int step, int steps) {
  return from * std::pow(to / from, static_cast<double>(step) / steps);
}

}  // namespace

StabilityPlan stabilityPlan(bool quick) {
  StabilityPlan plan;
  if (quick) {
    plan.onset_factor = 1.6;
    plan.phases = 4;
    plan.systems = 100;
    plan.devices = {scene::DeviceModel::omni, scene::DeviceModel::touch_x, scene::DeviceModel::premium_1_5};
    plan.every_cell = false;
  }
  const int delays = quick ? 4 : 12;
  const int steps = quick ? 8 : 20;
  for (int i = 0; i <= delays; ++i) plan.delays.push_back(3.0 * i / delays);
  for (int i = 0; i <= steps; ++i) plan.stiffness.push_back(logarithmic(0.1, 10.0, i, steps));
  plan.rates =
      quick ? std::vector<double>{500.0, 1000.0, 2000.0} : std::vector<double>{250.0, 500.0, 1000.0, 2000.0, 4000.0};
  return plan;
}

StabilityMeasurement measureStability(const StabilityPlan& plan, const Progress& progress) {
  StabilityMeasurement found;
  found.plan = plan;
  report(progress, "an ideal device", 0.0);
  found.theory = measuredTheory();
  LoopPlan bare = loopPlan(kMappedDevice, HandKind::dead_load, false);
  found.bare_swing_mm = lab::kick(bare).peak_to_peak_mm;

  for (std::size_t i = 0; i < plan.devices.size(); ++i) {
    for (const double delay : {1.0, 2.0}) {
      for (const bool controlled : {false, true}) {
        report(progress, "kicking devices",
               (static_cast<double>(i) + (delay - 1.0) / 2.0) / static_cast<double>(plan.devices.size()));
        found.onsets.push_back(measuredOnset(plan.devices[i], delay, controlled, plan.onset_factor));
      }
    }
  }
  for (const HandKind hand : {HandKind::dead_load, HandKind::stylus_z}) {
    for (const bool controlled : {false, true}) {
      report(progress, "mapping delay and stiffness", static_cast<double>(found.maps.size()) / 4.0);
      found.maps.push_back(measuredMap(plan, hand, controlled));
    }
  }
  for (const double rate : plan.rates) {
    report(progress, "sweeping the rate",
           static_cast<double>(found.rates.size()) / static_cast<double>(plan.rates.size()));
    found.rates.push_back(measuredRate(rate, plan.onset_factor));
  }
  found.cells = cellsToMeasure(plan.every_cell);
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    report(progress, "random devices and hands", static_cast<double>(i) / static_cast<double>(found.cells.size()));
    found.cells[i].oscillate = lab::oscillating(found.cells[i].cell, plan.systems);
  }
  for (const scene::DeviceModel device : lab::nominalDevices()) {
    report(progress, "tapping and pressing",
           static_cast<double>(found.touches.size()) / (6.0 * static_cast<double>(lab::nominalDevices().size())));
    for (const double stiffness : {1.0, 2.0, 3.0}) {
      for (const bool controlled : {false, true}) {
        found.touches.push_back(measuredTouch(device, stiffness, controlled, plan.phases));
      }
      found.presses.push_back(measuredPress(device, stiffness));
    }
    found.presses.push_back(measuredPress(device, 0.3));
  }
  return found;
}

}  // namespace palpate::study
