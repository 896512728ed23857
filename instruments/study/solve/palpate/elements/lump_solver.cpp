#include "palpate/elements/lump_solver.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::elements {

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

std::vector<scene::SolvedPush> solveLump(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  tissue::check(lump, stack);
  PressSettings settings = pressBeside(lump, stack);
  const PressSolution without = solvePress(stack, settings);
  settings.lump->young_kpa = tissue::youngModulus(lump, stack);
  const PressSolution with = solvePress(stack, settings);
  std::vector<scene::SolvedPush> pushes;
  const std::size_t count =
      std::min({without.table.shapes.size(), with.table.shapes.size(), settings.depths_mm.size()});
  for (std::size_t i = 0; i < count; ++i) {
    const tissue::PressedShape& shape = with.table.shapes[i];
    const tissue::PressedShape& plain = without.table.shapes[i];
    if (shape.depth_mm != plain.depth_mm) break;
    pushes.push_back({shape.depth_mm, shape.force_n - plain.force_n});
  }
  if (pushes.empty()) throw Error("cannot be solved: " + with.stopped_by);
  return pushes;
}

}  // namespace palpate::elements
