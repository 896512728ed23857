// `palpate lump`: the force that a lump adds to a press, compared with finite elements with the lump in the mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_tissue.h"
#include "palpate/tissue/library_fields.h"
#include "palpate/tissue/lump_energy.h"
#include "report/page/figures_text.h"
#include "solve/commands/commands.h"
#include "solve/realism/lump_judge.h"

namespace palpate::app {

namespace {

// --- check

struct LumpCheckArguments {
  std::string cases;
  std::optional<std::uint64_t> seed;
  std::size_t lumps = 12;
  bool json = false;
};

Json spreadJson(const lab::Spread& spread) {
  return {
      {"mean", spread.mean}, {"p90", spread.p90}, {"p95", spread.p95}, {"worst", spread.worst}, {"of", spread.count}};
}

/// Spreads of all lumps, and of those to 12 mm apart.
Json twoSpreadsJson(const lab::Spread& all, const lab::Spread& small) {
  Json json = spreadJson(all);
  json["to_12_mm"] = spreadJson(small);
  return json;
}

double shareWithin(const std::vector<double>& ratios, double from, double to) {
  if (ratios.empty()) return 1.0;
  const auto inside = std::ranges::count_if(ratios, [&](double ratio) { return ratio >= from && ratio <= to; });
  return static_cast<double>(inside) / static_cast<double>(ratios.size());
}

Json ratiosJson(const std::vector<double>& ratios) {
  Json json = {{"presses", ratios.size()},
               {"share_0.75_to_1.25", shareWithin(ratios, 0.75, 1.25)},
               {"share_0.9_to_1.1", shareWithin(ratios, 0.9, 1.1)}};
  if (ratios.empty()) return json;
  json["least"] = *std::ranges::min_element(ratios);
  json["greatest"] = *std::ranges::max_element(ratios);
  return json;
}

Json findingsJson(const lab::LumpFindings& findings) {
  Json json = {{"force_error_percent", twoSpreadsJson(findings.force, findings.force_small)},
               {"extra_force_within_25_percent", shareWithin(findings.extra_ratios, 0.75, 1.25)},
               {"extra_force_ratio", ratiosJson(findings.extra_ratios)},
               {"off_axis", Json::array()},
               {"pressure_rms_percent", twoSpreadsJson(findings.pressure, findings.pressure_small)},
               {"pressure_gain", findings.pressure_gain},
               {"surface_rms_percent", spreadJson(findings.surface_small)},
               {"field_error_percent", spreadJson(findings.field)},
               {"cases", Json::array()}};
  json["surface_rms_percent"]["over_12_mm"] = spreadJson(findings.surface_large);
  for (const lab::LumpFindings::Beside& beside : findings.beside) {
    json["off_axis"].push_back({{"name", beside.name},
                                {"at_mm", beside.at_mm},
                                {"kernel_ratio_error_percent", beside.ratio_percent},
                                {"lateral_error", beside.lateral}});
  }
  for (const lab::LumpFindings::One& one : findings.cases) {
    json["cases"].push_back({{"name", one.name},
                             {"force_error_percent", one.force_percent},
                             {"pressure_rms_percent", one.pressure_percent},
                             {"surface_rms_percent", one.surface_percent}});
  }
  return json;
}

void runLumpCheck(const LumpCheckArguments& arguments) {
  if (arguments.cases.empty() == !arguments.seed)
    throw Error("lump check: expected either --cases FILE or --solve SEED");
  ProgressLine progress;
  const lab::LumpCases cases = arguments.seed
                                   ? lab::solveLumpCases(*arguments.seed, arguments.lumps, progress.callback())
                                   : lab::readLumpCases(arguments.cases);
  const lab::LumpFindings findings = lab::judgeLumps(cases, progress.callback());
  progress.clear();
  const Json json = findingsJson(findings);
  fmt::print("{}", arguments.json ? jsonText(json) : study::figuresText(json));
}

// --- show

struct LumpShowArguments {
  double thickness_mm = 40.0;
  double fat_mm = 8.0;
  std::string table;
  double diameter_mm = 10.0;
  std::string half_axes;
  double depth_mm = 8.0;
  std::optional<double> ratio;
  std::optional<double> young_kpa;
  double edge = 0.0;
  bool json = false;
};

std::array<double, 3> halfAxesFrom(const LumpShowArguments& arguments) {
  std::array<double, 3> half_axes;
  half_axes.fill(0.5 * arguments.diameter_mm);
  if (arguments.half_axes.empty()) return half_axes;
  const std::vector<double> numbers = numbersFrom("--half-axes-mm", arguments.half_axes, between(1.0, 20.0, "mm"));
  if (numbers.size() != half_axes.size()) throw Error("--half-axes-mm: three numbers with commas, such as 6,6,3");
  std::ranges::copy(numbers, half_axes.begin());
  return half_axes;
}

void runLumpShow(const LumpShowArguments& arguments) {
  if (arguments.ratio && arguments.young_kpa) throw Error("lump show: expected --ratio or --young-kpa, not both");
  std::optional<tissue::LayeredTable> table;
  if (!arguments.table.empty()) table = tissue::readLayeredTable(arguments.table);
  const tissue::LayeredTissue without(table ? std::vector{tissue::nodeOf(*table)}
                                            : tissue::libraryNodes(arguments.fat_mm));
  const tissue::LumpPlace place = table ? tissue::tablePlace(*table, arguments.table)
                                        : tissue::libraryPlaceAt(arguments.thickness_mm, arguments.fat_mm);
  const tissue::LumpShape lump{.half_axes_mm = halfAxesFrom(arguments),
                               .depth_mm = arguments.depth_mm,
                               .stiffness_ratio = arguments.ratio.value_or(tissue::LumpShape{}.stiffness_ratio),
                               .young_kpa = arguments.young_kpa,
                               .edge = arguments.edge};
  const tissue::LumpEnergy energy = place.energyOf(lump);
  const double thickness = tissue::totalThickness(place.stack);
  Json json = {{"young_kpa", tissue::youngModulus(lump, place.stack)},
               {"bottom_mm", lump.bottomMm()},
               {"bone_mm", thickness},
               {"presses", Json::array()}};
  std::string text =
      fmt::format("lump of {:g} x {:g} mm, top {:g} mm under the skin, {:.4g} kPa; bone {:.4g} mm deep\n",
                  2.0 * lump.half_axes_mm[0], 2.0 * lump.half_axes_mm[2], lump.depth_mm,
                  tissue::youngModulus(lump, place.stack), thickness);
  text += "   depth     force    extra    share   sideways, at best\n";
  for (const double depth : {3.0, 5.0, 8.0}) {
    const double force = depth * without.secantAt(thickness, depth);
    const double extra = energy.at(0.0, depth).d_depth;
    double lateral = 0.0;
    for (double rho = 0.0; rho < energy.reachMm(); rho += 0.25)
      lateral = std::max(lateral, std::abs(energy.at(rho, depth).d_rho));
    text += fmt::format("{:5g} mm {:7.3f} N {:6.3f} N {:6.2f} % {:8.3f} N\n", depth, force, extra,
                        100.0 * extra / force, lateral);
    json["presses"].push_back({{"depth_mm", depth},
                               {"force_without_n", force},
                               {"extra_n", extra},
                               {"share_percent", 100.0 * extra / force},
                               {"lateral_n", lateral}});
  }
  const tissue::LumpSteepness steepest = energy.steepest();
  json["steepest_n_per_mm"] = {{"depth", steepest.depth}, {"sideways", steepest.rho}, {"snapping", steepest.snapping}};
  fmt::print("{}", arguments.json ? jsonText(json) : text);
}

void addLumpCheckCommand(Command& lump) {
  const auto [command, a] =
      addCommand(lump, "check", "Compare lumps with finite elements that have the lump in their mesh", runLumpCheck);
  Option& cases = *command.add_option("--cases", a.cases, "Solved presses over lumps (JSON)");
  addNumber(command, "--solve", a.seed, between(0.0, 1e9),
            "Draw stacks and lumps with this seed and solve them instead")
      ->excludes(&cases);
  addSetting(command, "--lumps", a.lumps, between(1.0, 200.0),
             "With --solve: number of lumps, four to a stack, about 10 s each");
  command.add_flag("--json", a.json, "Print one JSON object");
}

void addLumpShowCommand(Command& lump) {
  const auto [command, a] = addCommand(
      lump, "show", "Show what a lump adds to a press: kPa, share of the force at 3, 5 and 8 mm", runLumpShow);
  Option& diameter =
      *addSetting(command, "--diameter-mm", a.diameter_mm, between(2.0, 40.0, "mm"), "Diameter of a ball");
  command
      .add_option("--half-axes-mm", a.half_axes,
                  "Half axes of a flat or long lump instead: across, across (the same), into the body, such as 6,6,3")
      ->excludes(&diameter);
  addSetting(command, "--depth-mm", a.depth_mm, between(0.5, 200.0, "mm"), "Depth of its top under the skin");
  addNumber(command, "--ratio", a.ratio, between(0.2, 1000.0),
            "Ratio of its stiffness to that of the layer at its centre (default: 5)");
  addNumber(command, "--young-kpa", a.young_kpa, between(0.1, 1e6, "kPa"), "Stiffness in kPa instead");
  addSetting(command, "--edge", a.edge, between(0.0, 1.0), "0: sharp, to 1: soft all through");
  addSetting(command, "--thickness-mm", a.thickness_mm, between(9.0, 62.0, "mm"), "Depth of the bone at the place");
  addSetting(command, "--fat-mm", a.fat_mm, between(0.5, 60.0, "mm"), "Thickness of the fat between skin and muscle");
  command.add_option("--table", a.table, "Table with layers to use instead, solved with --field");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace

void addLumpCommand(Command& app) {
  Command& lump = *app.add_subcommand("lump", "Show, check and solve lumps under the skin");
  lump.require_subcommand(1);
  addLumpShowCommand(lump);
  addLumpCheckCommand(lump);
  addLumpSolveCommand(lump);
}

}  // namespace palpate::app
