// The half Gaussian of the dissertation, from 1 at the touched point to (almost) 0 at the rim.
//
// One curve serves both the deformation profile (tissue/profile.h) and the reach of a key point (maps).
// Based on: Ji, dissertation 2008, (4.2): y = exp(-x^2 / (2 sigma^2)) with sigma^2 = 1 / (2 pi), cut at x = 1.4.
#pragma once

#include <cmath>

#include "palpate/base/elementary.h"

namespace palpate {

/// The curve is cut here: y(1.4) = 0.0021 counts as zero.
inline constexpr double kGaussianCut = 1.4;
/// Exponent per squared location ratio: pi 1.4^2, so that y = exp(-kGaussianRate q^2) for q = x / 1.4.
inline constexpr double kGaussianRate = 3.141592653589793 * kGaussianCut * kGaussianCut;

/// (4.2) without the cut: exp(-pi (1.4 q)^2), 1 at q = 0 and 0.0021 at q = 1.
inline double halfGaussian(double q) { return elementary::exp(-kGaussianRate * q * q); }

}  // namespace palpate
