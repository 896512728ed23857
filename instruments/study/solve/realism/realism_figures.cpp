// Three worlds a stack, each pressed as often as there are solved depths.
#include "solve/realism/fem_cases.h"
#include "solve/realism/realism.h"

#include <algorithm>
#include <cmath>

namespace palpate::lab {

namespace {

using World = std::shared_ptr<const scene::World>;

void judgeStack(const JudgedStack& stack, RealismFigures& figures) {
  const double secant = stack.tissue->secantAt(stack.thickness_mm, tissue::kReferenceDepthMm);
  const World layered = flatWorld(scene::TissueModel::layered, stack.tissue, stack.thickness_mm, secant);
  const World gaussian = flatWorld(scene::TissueModel::gaussian, nullptr, stack.thickness_mm, secant);
  const World literal = flatWorld(scene::TissueModel::literal, nullptr, stack.thickness_mm, secant);
  for (const FemCase& one : stack.truth.cases) {
    const auto error = [&](const World& world) { return pressError(*world, one, stack.truth.radii_mm); };
    figures.presses.push_back({one.name, one.truth.depth_mm, isLayered(one.stack), one.truth.force_n, error(layered),
                               error(gaussian), error(literal)});
  }
  if (stack.drag && !stack.truth.cases.empty()) {
    const auto error = [&](const World& world) { return dragError(*world, *stack.drag); };
    figures.drags.push_back({stack.name, isLayered(stack.truth.cases.front().stack), error(layered), error(gaussian)});
  }
  figures.left_out.insert(figures.left_out.end(), stack.truth.left_out.begin(), stack.truth.left_out.end());
}

}  // namespace

WorstErrors RealismFigures::worst(PressError JudgedPress::*of, double from_mm) const {
  WorstErrors worst;
  for (const JudgedPress& press : presses) {
    if (!press.layered_stack || press.depth_mm < from_mm) continue;
    const PressError& error = press.*of;
    worst.normal_rms = std::max(worst.normal_rms, error.shape.normal_rms);
    worst.vector_rms = std::max(worst.vector_rms, error.shape.vector_rms);
    worst.force_error = std::max(worst.force_error, std::abs(error.force_error));
  }
  return worst;
}

double RealismFigures::worstDrag(double JudgedDrag::*of) const {
  double worst = 0.0;
  for (const JudgedDrag& drag : drags) worst = std::max(worst, drag.layered_stack ? drag.*of : 0.0);
  return worst;
}

RealismFigures judgeRealism(const std::vector<JudgedStack>& stacks, const Progress& progress) {
  RealismFigures figures;
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    report(progress, "judging " + stacks[i].name, static_cast<double>(i) / static_cast<double>(stacks.size()));
    judgeStack(stacks[i], figures);
  }
  return figures;
}

}  // namespace palpate::lab
