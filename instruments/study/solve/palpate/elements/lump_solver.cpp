#include "palpate/elements/lump_solver.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::elements {

namespace {

/// `settings.lump` has no modulus: as it is, the press is one of the tissue alone, on the mesh of the lump.
PressSettings pressBeside(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  constexpr double kDeepestMm = 8.0;
  constexpr double kShare = 0.5;  // share of the thickness
  PressSettings settings;
  settings.depths_mm.clear();
  const double deepest_mm = std::min(kDeepestMm, kShare * tissue::totalThickness(stack));
  for (double depth = 1.0; depth <= deepest_mm; depth += 1.0) settings.depths_mm.push_back(depth);
  settings.lump = Inclusion{.across_mm = lump.half_axes_mm[0],
                            .into_mm = lump.half_axes_mm[2],
                            .top_mm = lump.depth_mm,
                            .edge = lump.edge,
                            .young_kpa = {}};
  return settings;
}

}  // namespace

LumpPresses solveLumpPresses(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  PressSettings settings = pressBeside(lump, stack);
  LumpPresses presses{.without = solvePress(stack, settings), .with = {}};
  settings.lump->young_kpa = tissue::youngModulus(lump, stack);
  presses.with = solvePress(stack, settings);
  const auto& plain = presses.without.table.shapes;
  const auto& hard = presses.with.table.shapes;
  const std::size_t most = std::min({plain.size(), hard.size(), settings.depths_mm.size()});
  while (presses.common < most && hard[presses.common].depth_mm == plain[presses.common].depth_mm) ++presses.common;
  return presses;
}

std::vector<scene::SolvedPush> solveLump(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  tissue::check(lump, stack);
  const LumpPresses presses = solveLumpPresses(lump, stack);
  std::vector<scene::SolvedPush> pushes;
  for (std::size_t i = 0; i < presses.common; ++i) {
    const tissue::PressedShape& shape = presses.with.table.shapes[i];
    pushes.push_back({shape.depth_mm, shape.force_n - presses.without.table.shapes[i].force_n});
  }
  if (pushes.empty()) throw Error("cannot be solved: " + presses.with.stopped_by);
  return pushes;
}

}  // namespace palpate::elements
