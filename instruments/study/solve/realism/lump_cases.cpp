// Cases of lumps: read from a file, or drawn and solved. Solved ones are pressed twice on one mesh, with the lump and
// without, so that they differ by the lump alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/elements/lump_solver.h"
#include "solve/realism/lump_judge.h"

namespace palpate::lab {

namespace {

constexpr std::uint64_t kMaxLumpBytes = 64u << 20u;
constexpr double kPercent = 0.01;

/// Whether the first of two alternative keys is given.
bool hasFirst(const Json& json, const char* first, const char* second) {
  if (json.contains(first) == json.contains(second))
    throw Error(fmt::format("a lump must have either {} or {}", first, second));
  return json.contains(first);
}

/// Reads the keys of [[lump]] in scenes (scene/lump_keys.cpp). Its place on a body does not matter here; keys that
/// would change the press are refused. Other keys are the solver's notes.
tissue::LumpShape lumpFrom(const Json& json) {
  for (const char* key : {"mobility_mm_per_n", "raise_mm"}) {
    if (json.value(key, 0.0) != 0.0) throw Error(fmt::format("a lump of a solved press must not have {}", key));
  }
  tissue::LumpShape lump;
  if (hasFirst(json, "half_axes_mm", "diameter_mm")) {
    const Json& half = json.at("half_axes_mm");
    if (half.size() != lump.half_axes_mm.size()) throw Error("half_axes_mm must be three numbers");
    for (std::size_t i = 0; i < half.size(); ++i) lump.half_axes_mm[i] = half.at(i).get<double>();
  } else {
    lump.half_axes_mm.fill(0.5 * json.at("diameter_mm").get<double>());
  }
  lump.depth_mm = json.at("depth_mm").get<double>();
  if (hasFirst(json, "young_kpa", "stiffness_ratio")) {
    lump.young_kpa = json.at("young_kpa").get<double>();
  } else {
    lump.stiffness_ratio = json.at("stiffness_ratio").get<double>();
  }
  lump.edge = json.value("edge", 0.0);
  return lump;
}

std::size_t stackNamed(const LumpCases& cases, const std::string& name) {
  const auto found = std::ranges::find(cases.stack_names, name);
  if (found == cases.stack_names.end()) throw Error("unknown stack '" + oneLine(name) + "'");
  return static_cast<std::size_t>(found - cases.stack_names.begin());
}

void readStacks(const Json& root, LumpCases& cases) {
  for (const Json& json : root.at("stacks")) {
    cases.stack_names.push_back(json.at("name").get<std::string>());
    tissue::LayerStack& stack = cases.stacks.emplace_back();
    stack.poisson = root.value("poisson", stack.poisson);
    for (const Json& layer : json.at("layers_mm_kpa"))
      stack.layers.push_back({"", layer.at(0).get<double>(), layer.at(1).get<double>()});
    tissue::check(stack);
    std::vector<double>& forces = cases.forces_n.emplace_back();
    for (const Json& press : json.value("presses", Json::array())) forces.push_back(press.at("force_n").get<double>());
  }
}

LumpCase caseFrom(const Json& json, const LumpCases& cases) {
  LumpCase one{.name = json.at("name").get<std::string>(),
               .stack = stackNamed(cases, json.at("stack").get<std::string>()),
               .lump = lumpFrom(json.at("lump")),
               .presses = {}};
  for (const Json& from : json.at("presses")) {
    LumpPress& press = one.presses.emplace_back();
    press.depth_mm = from.at("depth_mm").get<double>();
    press.force_n = from.at("force_n").get<double>();
    press.force_without_n = from.at("force_without_n").get<double>();
    if (from.contains("pressure_kpa")) {
      press.contact_radius_mm = from.at("contact_radius_mm").get<double>();
      press.pressure_kpa = from.at("pressure_kpa").get<std::vector<double>>();
      if (press.pressure_kpa.empty()) throw Error(one.name + ": pressure_kpa is empty");
    }
    for (const Json& percent : from.value("surface_change_percent_of_depth", Json::array()))
      press.surface_change_share.push_back(kPercent * percent.get<double>());
    if (press.surface_change_share.size() > cases.surface_radii_mm.size())
      throw Error(one.name + ": surface_change_percent_of_depth is too long");
  }
  tissue::check(one.lump, cases.stacks[one.stack]);
  return one;
}

BesideCase parseBesideCase(const Json& json, const LumpCases& cases) {
  BesideCase one{.name = json.at("name").get<std::string>(),
                 .stack = stackNamed(cases, json.at("stack").get<std::string>()),
                 .lump = lumpFrom(json.at("lump")),
                 .at_mm = json.at("at_mm").get<double>(),
                 .presses = {}};
  for (const Json& press : json.at("presses")) {
    one.presses.push_back({press.at("depth_mm").get<double>(), press.at("force_over_force_without").get<double>() - 1.0,
                           press.at("lateral_away_from_lump_over_force_without").get<double>()});
  }
  return one;
}

void readField(const Json& root, LumpCases& cases) {
  for (const Json& kernel : root.value("kernels", Json::array())) {
    const std::size_t stack = stackNamed(cases, kernel.at("stack").get<std::string>());
    for (const Json& entry : kernel.at("entries")) {
      for (std::size_t i = 0; i < entry.at("press_mm").size(); ++i) {
        cases.field.push_back({stack, entry.at("centre_depth_mm").get<double>(), entry.at("at_mm").get<double>(),
                               entry.at("press_mm").at(i).get<double>(), entry.at("shear_mm3").at(i).get<double>(),
                               entry.at("volume_mm3").at(i).get<double>()});
      }
    }
  }
}

// --- drawn and solved

/// Evenly on a scale of factors.
double drawnFactor(Random& random, double from, double to) {
  return std::exp(random.uniform(std::log(from), std::log(to)));
}

/// Fat from nearly liquid to firm.
tissue::LayerStack drawnStack(Random& random) {
  tissue::LayerStack stack;
  stack.layers.push_back({"skin", random.uniform(1.0, 2.5), random.uniform(60.0, 150.0)});
  stack.layers.push_back({"fat", random.uniform(5.0, 18.0), drawnFactor(random, 2.0, 20.0)});
  stack.layers.push_back({"muscle", random.uniform(12.0, 30.0), random.uniform(12.0, 40.0)});
  return stack;
}

/// From as near under the skin as a lump may lie.
tissue::LumpShape drawnLump(Random& random, const tissue::LayerStack& stack) {
  constexpr double kDeepestTopMm = 12.0;
  tissue::LumpShape lump;
  lump.half_axes_mm.fill(random.uniform(1.5, 7.0));
  const tissue::TopRange top = tissue::topRange(lump, stack);
  lump.depth_mm = random.uniform(top.from_mm, std::min(kDeepestTopMm, top.to_mm - 0.5));
  lump.stiffness_ratio = drawnFactor(random, 1.5, 40.0);
  return lump;
}

std::vector<double> padded(std::vector<double> pressures, std::size_t count) {
  pressures.resize(std::max(count, pressures.size()), 0.0);
  return pressures;
}

void solve(LumpCase& one, const tissue::LayerStack& stack, const std::vector<double>& surface_radii) {
  constexpr std::size_t kRings = 9;
  const elements::LumpPresses solved = elements::solveLumpPresses(one.lump, stack);
  const tissue::LayeredTable& with = solved.with.table;
  for (std::size_t i = 0; i < solved.common; ++i) {
    const tissue::PressedShape& shape = with.shapes[i];
    const tissue::PressedShape& plain = solved.without.table.shapes[i];
    LumpPress& press = one.presses.emplace_back();
    press.depth_mm = shape.depth_mm;
    press.force_n = shape.force_n;
    press.force_without_n = plain.force_n;
    // Up to the end of the last ring that touches.
    press.contact_radius_mm = static_cast<double>(solved.with.ring_pressures_kpa[i].size());
    press.pressure_kpa = padded(solved.with.ring_pressures_kpa[i], kRings);
    for (const double radius : surface_radii) {
      const auto at = std::ranges::lower_bound(with.radii_mm, radius - 1e-9) - with.radii_mm.begin();
      const auto r = static_cast<std::size_t>(at);
      press.surface_change_share.push_back((shape.down[r] * shape.surface_mm - plain.down[r] * plain.surface_mm) /
                                           shape.depth_mm);
    }
  }
}

}  // namespace

LumpCases readLumpCases(const std::filesystem::path& file) {
  return parseLumpCases(readFile(file, kMaxLumpBytes), file);
}

LumpCases parseLumpCases(std::string_view text, const std::filesystem::path& file) {
  LumpCases cases;
  cases.surface_radii_mm = {0, 2, 4, 6, 8, 10, 12, 15, 20, 25, 30, 40};
  try {
    const Json root = Json::parse(text);
    readStacks(root, cases);
    for (const Json& json : root.at("cases")) cases.cases.push_back(caseFrom(json, cases));
    for (const Json& json : root.value("off_axis", Json::array())) cases.beside.push_back(parseBesideCase(json, cases));
    readField(root, cases);
  } catch (const JsonError& error) {
    throw Error::inFile(file.string(), fmt::format("is not a file of lump cases: {}", error.what()));
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
  return cases;
}

LumpCases drawLumpCases(std::uint64_t seed, std::size_t lumps) {
  constexpr std::size_t kLumpsAStack = 4;
  Random random(seed);
  LumpCases cases;
  cases.surface_radii_mm = {0, 2, 4, 6, 8, 10, 12, 15, 20, 25, 30, 40};
  while (cases.cases.size() < lumps) {
    if (cases.cases.size() % kLumpsAStack == 0) {
      cases.stacks.push_back(drawnStack(random));
      cases.stack_names.push_back(fmt::format("stack {}", cases.stacks.size()));
      cases.forces_n.emplace_back();
    }
    const tissue::LumpShape lump = drawnLump(random, cases.stacks.back());
    const std::string name = fmt::format("{}: {:.1f} mm, {:.1f} mm deep, ratio {:.1f}", cases.stack_names.back(),
                                         2.0 * lump.half_axes_mm[0], lump.depth_mm, lump.stiffness_ratio);
    cases.cases.push_back({.name = name, .stack = cases.stacks.size() - 1, .lump = lump, .presses = {}});
  }
  return cases;
}

LumpCases solveLumpCases(std::uint64_t seed, std::size_t lumps, const Progress& progress) {
  LumpCases cases = drawLumpCases(seed, lumps);
  for (std::size_t i = 0; i < lumps; ++i) {
    report(progress, "solving lumps", static_cast<double>(i) / static_cast<double>(lumps));
    solve(cases.cases[i], cases.stacks[cases.cases[i].stack], cases.surface_radii_mm);
  }
  return cases;
}

}  // namespace palpate::lab
