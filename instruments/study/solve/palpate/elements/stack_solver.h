// Solves one stack of layers completely: pressed deeper and deeper, and dragged.
#pragma once

#include <functional>
#include <optional>

#include "palpate/elements/drag_solver.h"
#include "palpate/elements/press_solver.h"

namespace palpate::elements {

struct StackSettings {
  PressSettings press;
  std::optional<DragSettings> drag = DragSettings{};  ///< none: not dragged
};

struct StackSolution {
  PressSolution press;    ///< its table has the drag too
  double drag_rms = 0.0;  ///< misfit of the form, share of the drag
  double drag_n_per_mm = 0.0;
  double press_n_per_mm = 0.0;  ///< stiffness of the same bonded patch, linear
  double seconds = 0.0;
};

/// `stop` ends the press at the depth reached; then the drag is left out.
StackSolution solveStack(const tissue::LayerStack& stack, const StackSettings& settings, const Progress& progress = {},
                         const std::function<bool()>& stop = {});

}  // namespace palpate::elements
