#include "dissertation/stability/stability_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "palpate/scene/words.h"

namespace palpate::study {

namespace {

using lab::StabilityCell;

TextTable cellTable(const std::vector<StabilityCell>& cells) {
  TextTable table{{"rate_hz", "delay_ticks", "device", "hand", "cap_n_per_mm", "allowed", "oscillates_bare",
                   "oscillates_controlled", "port_energy_bare_mj_max", "port_energy_mj_max", "reason"},
                  {}};
  for (const StabilityCell& cell : cells) {
    table.rows.push_back({fmt::format("{}", cell.ticks_per_s), fmt::format("{}", cell.delay_ticks),
                          std::string(wordFor(cell.device)), std::string(wordFor(cell.hand)),
                          fmt::format("{:.3f}", cell.cap_n_per_mm), cell.refused.empty() ? "yes" : "no",
                          fmt::format("{}", cell.oscillates_bare), fmt::format("{}", cell.oscillates_controlled),
                          fmt::format("{:.4f}", cell.port_energy_bare_mj_max),
                          fmt::format("{:.4f}", cell.port_energy_mj_max), cell.refused});
  }
  return table;
}

/// Table for each rate and delay, over devices and hands.
TextTable rateTable(const std::vector<StabilityCell>& cells, std::size_t systems) {
  std::map<std::pair<double, int>, std::vector<const StabilityCell*>> groups;
  for (const StabilityCell& cell : cells) groups[{cell.ticks_per_s, cell.delay_ticks}].push_back(&cell);
  TextTable table{{"rate (Hz)", "delay (ticks)", "devices allowed", "systems there", "oscillate, bare",
                   "oscillate, controlled", "port energy, bare (mJ)", "port energy, controlled (mJ)"},
                  {}};
  for (const auto& [key, group] : groups) {
    StabilityCell sum;
    std::size_t allowed = 0;
    std::vector<std::string> devices;
    for (const StabilityCell* cell : group) {
      if (!cell->refused.empty()) continue;
      ++allowed;
      if (devices.empty() || devices.back() != wordFor(cell->device)) devices.emplace_back(wordFor(cell->device));
      sum.oscillates_bare += cell->oscillates_bare;
      sum.oscillates_controlled += cell->oscillates_controlled;
      sum.port_energy_bare_mj_max = std::max(sum.port_energy_bare_mj_max, cell->port_energy_bare_mj_max);
      sum.port_energy_mj_max = std::max(sum.port_energy_mj_max, cell->port_energy_mj_max);
    }
    table.rows.push_back({fmt::format("{}", key.first), fmt::format("{}", key.second),
                          fmt::format("{}", devices.size()), fmt::format("{}", allowed * systems),
                          fmt::format("{}", sum.oscillates_bare), fmt::format("{}", sum.oscillates_controlled),
                          fmt::format("{:.2f}", sum.port_energy_bare_mj_max),
                          fmt::format("{:.2f}", sum.port_energy_mj_max)});
  }
  return table;
}

}  // namespace

StabilityMapTotals computeTotals(const std::vector<StabilityCell>& cells) {
  StabilityMapTotals totals;
  totals.cells = cells.size();
  for (const StabilityCell& cell : cells) {
    totals.oscillates_bare += cell.oscillates_bare;
    totals.oscillates_controlled += cell.oscillates_controlled;
    totals.controlled_above_bare += cell.oscillates_controlled > cell.oscillates_bare ? 1 : 0;
    if (!cell.refused.empty()) continue;
    ++totals.allowed;
    totals.oscillates_allowed += cell.oscillates_controlled;
    totals.port_energy_allowed_mj_max = std::max(totals.port_energy_allowed_mj_max, cell.port_energy_mj_max);
  }
  return totals;
}

StudyPage stabilityMapPage(const lab::StabilityMapPlan& plan, const std::vector<StabilityCell>& cells) {
  const StabilityMapTotals totals = computeTotals(cells);
  const bool holds = totals.oscillates_allowed == 0 && totals.port_energy_allowed_mj_max <= 0.01;
  StudyPage page;
  page.name = "stability_map";
  page.title = "Where a session may start";
  page.question = "At which rate and delay may which device push a hand, how stiffly, and does it rest there?";
  page.findings = {
      fmt::format(
          "{} of {} cells of rate, delay, device and hand are allowed. There {} of {} random systems oscillate, "
          "and the largest energy at the port after a tap is {:.3f} mJ: what is allowed {}.",
          totals.allowed, totals.cells, totals.oscillates_allowed, totals.allowed * plan.systems,
          totals.port_energy_allowed_mj_max, holds ? "holds" : "does not hold"),
      fmt::format("In {} cells more oscillate with the controller than without it.", totals.controlled_above_bare)};
  page.method = {fmt::format(
      "{} random systems a cell, seed {}, at the cap that the product gives: mass +-30 %, damping 0.1 to 2 times, "
      "friction 0 to 1.5 times the nominal (every third 0 to 0.15), amplifier lag to 0.5 ms, jitter to a quarter of a "
      "tick, hands within the spread of people. `unknown` is a device of which the loop knows nothing, with the "
      "mechanics of the seven in turn. A system oscillates when it swings by more than two encoder steps 0.4 to 0.8 s "
      "after a kick and still 1.6 to 2 s after. Taps arrive at 0.1 to 0.5 m/s, every second one at 0.5.",
      plan.systems, plan.seed)};
  page.tables = {
      {"stability_map_rates", "Where a session may start, by rate and delay.", rateTable(cells, plan.systems)},
      {"stability_map_cells", "Every cell.", cellTable(cells), false, "cells"}};
  page.numbers = {{"systems_per_cell", static_cast<double>(plan.systems)},
                  {"seed", static_cast<double>(plan.seed)},
                  {"cells_total", static_cast<double>(totals.cells)},
                  {"cells_allowed", static_cast<double>(totals.allowed)},
                  {"oscillates_bare", static_cast<double>(totals.oscillates_bare)},
                  {"oscillates_controlled", static_cast<double>(totals.oscillates_controlled)},
                  {"cells_controlled_above_bare", static_cast<double>(totals.controlled_above_bare)},
                  {"oscillates_controlled_allowed", static_cast<double>(totals.oscillates_allowed)},
                  {"port_energy_mj_max_allowed", totals.port_energy_allowed_mj_max}};
  page.numbers_on_top = true;
  return page;
}

StudyPage studyStabilityMap(const StudySettings& settings) {
  lab::StabilityMapPlan plan = lab::stabilityMapPlan();
  plan.seed = settings.seed.value_or(plan.seed);
  if (settings.quick) {
    plan.rates = {500.0, 1000.0};
    plan.delays = {0, 1, 3};
    plan.systems = 2;
  }
  StudyPage page = stabilityMapPage(plan, lab::measureStabilityMap(plan, settings.progress));
  page.command =
      fmt::format("palpate study stability --map --seed {}{} --out DIR", plan.seed, settings.quick ? " --quick" : "");
  return page;
}

}  // namespace palpate::study
