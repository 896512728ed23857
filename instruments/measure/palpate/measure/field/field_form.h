// The forms that a skin field may have: how much of the peak is left at a distance, and how much of it moves sideways.
//
//   u = round peak + radial (e . peak) e,  e = the unit vector from the contact
//
//   smooth:   f = (1 + k rho^2)^(-1/k), from the half Gaussian (k = 0) to a long tail; round = f,
//             radial = kappa rho^2 / (1 + rho^2) f
//   pointed:  the same with rho, rounded in the middle, in place of rho^2, from the exponential (k = 0) to 1/rho
//   deep:     an elastic half space whose surface is dragged over a patch (Cerruti), 1/rho far away; k says how much
//             of the motion is the patch's own, kappa is twice Poisson's ratio
//   solved:   layers over bone by finite elements (solved_drag.h); radial is 1 + kappa times the solution
#pragma once

#include "palpate/measure/field/skin_field.h"

namespace palpate::measure {

struct FormValue {
  double round = 0.0;
  double radial = 0.0;
  double round_by_rho2 = 0.0;
  double radial_by_rho2 = 0.0;
  double round_by_tail = 0.0;
  double radial_by_tail = 0.0;
  double round_by_sideways = 0.0;
  double radial_by_sideways = 0.0;
};

FormValue formAt(FieldForm form, double rho2, double tail, double sideways);

/// Outward motion of the skin all around a stick that presses as well, as shares of the peak times the offset from the
/// contact in radii: 1/(1 + rho^2), as in a compressible half space, and its power of 3/2, which is nearer.
struct PressShape {
  Vec2 value = Vec2::Zero();
  Vec2 by_rho2 = Vec2::Zero();
};

PressShape pressShapeAt(double rho2);

/// "smooth", "pointed", "deep", "solved".
const char* nameOf(FieldForm form);

}  // namespace palpate::measure
