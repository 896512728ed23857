// The forms that a skin field may have: how much of the peak is left at a distance, and how much of it moves sideways.
//
//   u = round peak + radial (e . peak) e,  e = the unit vector from the contact
//
// smooth:  f = (1 + k rho^2)^(-1/k): the half Gaussian (k = 0) to a long tail; round = f, radial = kappa
// rho^2/(1+rho^2) f pointed: the same with rho, rounded in the middle, instead of rho^2: the exponential (k = 0) to
// 1/rho deep:    smooth with k = 2, which is 1/rho far away as in an elastic half space, whose kappa is near 1 solved:
// layers over bone by finite elements (solved_drag.h); radial is (1 + kappa) times what was solved
#pragma once

#include "palpate/measure/skin_field.h"

namespace palpate::measure {

struct FormValue {
  double round = 0.0;
  double radial = 0.0;
  double round_by_rho2 = 0.0;
  double radial_by_rho2 = 0.0;
  double round_by_tail = 0.0;
  double radial_by_tail = 0.0;
  double radial_by_sideways = 0.0;
};

FormValue formAt(FieldForm form, double rho2, double tail, double sideways);

/// "smooth", "pointed", "deep", "solved".
const char* nameOf(FieldForm form);

}  // namespace palpate::measure
