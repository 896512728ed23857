// Solved curves -> a dragged place: knots are even in ln(1 + rho^2), so that they are dense at the contact; between
// knots the curve of Catmull and Rom (1974), whose slope is continuous, between stacks linear in the tail.
#include "palpate/tissue/solved_drag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "palpate/base/elementary.h"

namespace palpate::tissue {

namespace {

constexpr double kStep = 0.16;  // of ln(1 + rho^2)

using Curve = double[kSolvedKnots];

// Along and across, by turns.
#include "palpate/tissue/solved_drag_numbers.inc"

constexpr std::size_t kStacks = kSolvedStacks.size();
static_assert(std::size(kCurves) == 2 * kStacks);

/// Weights of four neighbouring knots for a value and its derivative (Catmull and Rom).
struct KnotWeights {
  std::size_t first;
  std::array<double, 4> value;
  std::array<double, 4> slope;  // by ln(1 + rho^2)
};

KnotWeights weightsAt(double place) {
  const double cell = std::clamp(std::floor(place), 1.0, static_cast<double>(kSolvedKnots) - 3.0);
  const double t = place - cell;
  return {static_cast<std::size_t>(cell) - 1,
          {0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
           0.5 * t * (t * (4.0 - 3.0 * t) + 1.0), 0.5 * t * t * (t - 1.0)},
          {0.5 * (t * (4.0 - 3.0 * t) - 1.0) / kStep, 0.5 * t * (9.0 * t - 10.0) / kStep,
           0.5 * (t * (8.0 - 9.0 * t) + 1.0) / kStep, 0.5 * t * (3.0 * t - 2.0) / kStep}};
}

double sum(const Curve& curve, std::size_t first, const std::array<double, 4>& weights) {
  return weights[0] * curve[first] + weights[1] * curve[first + 1] + weights[2] * curve[first + 2] +
         weights[3] * curve[first + 3];
}

}  // namespace

double solvedKnotMm(std::size_t i) {
  return kSolvedPatchMm * std::sqrt(elementary::expm1(kStep * static_cast<double>(i)));
}

SolvedDrag solvedDragAt(double rho2, double tail) {
  const double place = elementary::log1p(rho2) / kStep;
  if (!(place < static_cast<double>(kSolvedKnots) - 2.0)) return {};
  const KnotWeights w = weightsAt(place);
  constexpr double kPerTail = (kStacks - 1) / kSolvedLongestTail;
  const double stack = std::clamp(tail * kPerTail, 0.0, static_cast<double>(kStacks) - 1.0);
  const auto lower = static_cast<std::size_t>(std::min(std::floor(stack), static_cast<double>(kStacks) - 2.0));
  const double share = stack - static_cast<double>(lower);
  const double by_rho2 = 1.0 / (1.0 + rho2);
  SolvedDrag drag;
  const auto read = [&](std::size_t which, double& value, double& slope, double& by_tail) {
    const Curve& a = kCurves[2 * lower + which];
    const Curve& b = kCurves[2 * lower + 2 + which];
    const double from = sum(a, w.first, w.value);
    const double to = sum(b, w.first, w.value);
    value = from + share * (to - from);
    by_tail = kPerTail * (to - from);
    const double slope_from = sum(a, w.first, w.slope);
    slope = by_rho2 * (slope_from + share * (sum(b, w.first, w.slope) - slope_from));
  };
  read(0, drag.along, drag.along_by_rho2, drag.along_by_tail);
  read(1, drag.across, drag.across_by_rho2, drag.across_by_tail);
  return drag;
}

}  // namespace palpate::tissue
