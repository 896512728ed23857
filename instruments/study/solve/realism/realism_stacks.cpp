// Solves stacks one after the other: a press to every depth of a table, and a drag.
#include "solve/realism/realism_stacks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/elements/drag_solver.h"
#include "palpate/elements/press_solver.h"
#include "palpate/tissue/layered_library.h"

namespace palpate::lab {

namespace {

struct SolvedPlace {
  const char* name;
  double thickness_mm;
  double fat_mm;
};
/// A rib of a lean and an average body, the scapula, beside the spine, the loin; and the loin of a heavy one.
constexpr SolvedPlace kPlaces[] = {{"rib, lean", 12, 4},        {"rib", 15, 8},  {"scapula", 25, 8},
                                   {"beside the spine", 35, 8}, {"loin", 55, 8}, {"loin, heavy", 55, 20}};

Progress part(const Progress& whole, std::size_t i, std::size_t count, const std::string& name) {
  return [=](std::string_view, double done) {
    report(whole, "solving " + name, (static_cast<double>(i) + done) / static_cast<double>(count));
  };
}

struct Solved {
  tissue::LayeredTable table;
  elements::DragField drag;
};

Solved solved(const tissue::LayerStack& stack, std::vector<double> depths, const std::string& name,
              const Progress& progress) {
  elements::PressSettings settings;
  settings.depths_mm = std::move(depths);
  elements::PressSolution solution = elements::solvePress(stack, settings, progress);
  if (solution.table.shapes.empty()) throw Error(fmt::format("{}: not solved: {}", name, solution.stopped_by));
  elements::DragField drag = elements::solveDragField(stack, {});
  solution.table.drag = elements::fitDrag(drag, solution.table.radii_mm).shape;
  return {std::move(solution.table), std::move(drag)};
}

/// Depths of a table, down to the deepest case.
std::vector<double> depthsTo(double deepest_mm) {
  std::vector<double> depths = {0.5};
  for (double depth = 1.0; depth < deepest_mm - 1e-9; depth += 1.0) depths.push_back(depth);
  depths.push_back(deepest_mm);
  return depths;
}

bool sameLayers(const tissue::LayerStack& a, const tissue::LayerStack& b) {
  return std::ranges::equal(a.layers, b.layers, [](const tissue::Layer& x, const tissue::Layer& y) {
    return x.thickness_mm == y.thickness_mm && x.young_kpa == y.young_kpa;
  });
}

}  // namespace

std::vector<JudgedPlace> placesOfBody() {
  std::vector<JudgedPlace> places;
  for (const SolvedPlace& place : kPlaces) {
    const double share = tissue::libraryFatShare(place.thickness_mm, place.fat_mm);
    places.push_back({place.name, place.thickness_mm, place.fat_mm, tissue::libraryStack(place.thickness_mm, share),
                      std::make_shared<const tissue::LayeredTissue>(tissue::libraryNodes(place.fat_mm))});
  }
  return places;
}

std::vector<JudgedStack> stacksOfBody(const Progress& progress) {
  const std::vector<JudgedPlace> places = placesOfBody();
  std::vector<JudgedStack> stacks;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const JudgedPlace& place = places[i];
    const auto [table, drag] =
        solved(place.stack, {2.0, 5.0, 7.5, 10.0}, place.name, part(progress, i, places.size(), place.name));
    JudgedStack judged{.name = place.name, .truth = toFemCases(table, place.name), .drag = drag};
    judged.tissue = place.tissue;
    judged.thickness_mm = place.thickness_mm;
    stacks.push_back(std::move(judged));
  }
  return stacks;
}

std::vector<JudgedStack> stacksOfCases(const FemCases& cases, const Progress& progress) {
  std::vector<JudgedStack> stacks;
  for (const FemCase& one : cases.cases) {
    auto found = std::ranges::find_if(
        stacks, [&](const JudgedStack& s) { return sameLayers(s.truth.cases.front().stack, one.stack); });
    if (found == stacks.end()) {
      stacks.push_back({.name = one.name, .truth = {cases.radii_mm, {}, {}}});
      found = stacks.end() - 1;
    }
    found->truth.cases.push_back(one);
  }
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    JudgedStack& judged = stacks[i];
    double deepest = 0.0;
    for (const FemCase& one : judged.truth.cases) deepest = std::max(deepest, one.truth.depth_mm);
    const tissue::LayerStack& stack = judged.truth.cases.front().stack;
    const auto [table, drag] =
        solved(stack, depthsTo(deepest), judged.name, part(progress, i, stacks.size(), judged.name));
    judged.drag = drag;
    judged.tissue = std::make_shared<const tissue::LayeredTissue>(std::vector{tissue::nodeOf(table)});
    judged.thickness_mm = tissue::totalThickness(stack);
  }
  if (!stacks.empty()) stacks.front().truth.left_out = cases.left_out;
  return stacks;
}

std::vector<JudgedStack> stacksOfFile(const std::filesystem::path& file, const Progress& progress) {
  return stacksOfCases(readFemCases(file), progress);
}

}  // namespace palpate::lab
