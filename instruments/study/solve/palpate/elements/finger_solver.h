// The force of fingers of other radii on a stack of layers: the press of a sphere, once for each radius of the force
// law.
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/elements/press_solver.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// Greatest depth of a sphere, mm: small ones puncture the model's skin (docs/explanation/tissue.md), fingertips
/// and larger ones go as deep as requested.
double maxPressDepth(double finger_mm);

/// A press of one sphere with a disc that is large enough for it.
PressSettings settingsOf(double finger_mm, std::vector<double> depths_mm);

/// Forces at every radius of tissue::LayeredForce but the indenter's, at its depths (or the deepest possible if all are
/// deeper); less deep without an equilibrium. `stop` ends it with the results so far. Throws Error as solvePress.
std::vector<tissue::FingerForces> solveFingers(const tissue::LayerStack& stack, const PressSettings& indenter,
                                               const Progress& progress = {}, const std::function<bool()>& stop = {});

}  // namespace palpate::elements
