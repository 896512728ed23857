// The pull towards the finger: pressed skin does not only sink, it is drawn in sideways.
//
// A share of the depth, zero under the finger, largest at q = width, faded out towards the rim. Layered tissue shows 5
// to 11 % of the depth at half the half Gaussian's radius (finite elements, docs/profiles.md); the dissertation has no
// such term, so it is off by default.
#pragma once

#include <cmath>

#include "palpate/tissue/profile_forms.h"

namespace palpate::tissue {

/// inward displacement = share depth (q/width) exp(1/2 - q^2 / (2 width^2)).
struct RadialTerm {
  double share = 0.0;  ///< of the depth, at its largest; 0 = off, below 0 pushes outward
  double width = 0.4;  ///< the q where it is largest
};

/// The inward share of the depth at location ratio q, and its derivative by q.
inline ProfilePoint radialPull(const RadialTerm& term, double q) noexcept {
  if (!(q < 1.0)) return {};
  const double x = q / term.width;
  const double bell = term.share * std::exp(0.5 * (1.0 - x * x));
  return fadedOut({x * bell, (1.0 - x * x) / term.width * bell}, q);
}

}  // namespace palpate::tissue
