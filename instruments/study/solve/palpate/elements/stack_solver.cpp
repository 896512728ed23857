#include "palpate/elements/stack_solver.h"

#include "palpate/base/stopwatch.h"

namespace palpate::elements {

StackSolution solveStack(const tissue::LayerStack& stack, const StackSettings& settings, const Progress& progress,
                         const std::function<bool()>& stop) {
  const auto start = Clock::now();
  StackSolution solution;
  solution.press = solvePress(stack, settings.press, progress, stop);
  if (settings.drag && !(stop && stop())) {
    const DragField field = solveDragField(stack, *settings.drag, progress);
    FittedDrag fitted = fitDrag(field, solution.press.table.radii_mm);
    solution.press.table.drag = std::move(fitted.shape);
    solution.drag_rms = fitted.rms;
    solution.drag_n_per_mm = field.drag_n_per_mm;
    solution.press_n_per_mm = field.press_n_per_mm;
  }
  solution.seconds = secondsSince(start);
  return solution;
}

}  // namespace palpate::elements
