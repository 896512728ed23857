// The closed forms behind ProfileCurve, each with its derivative, before the rim is finished.
//
// Based on: Ji, dissertation 2008, (4.1), (4.2), Figure 4.4 and Table 4.2; two Gaussians and the power tail are fits to
// finite element models of layered tissue (docs/profiles.md).
#pragma once

#include "palpate/tissue/profile_curve.h"

namespace palpate::tissue {

/// exp(-pi (1.4 q)^2) (4.2).
ProfilePoint halfGaussianForm(double q) noexcept;

/// The Gaussian beyond its inflection point x = sigma, moved to the centre and scaled to 1 there; its end x = 1.4 stays
/// on the rim. Steepest under the finger, as under a point (Fig 4.4).
ProfilePoint sharpForm(double q) noexcept;

/// (1 + cos(pi q)) / 2.
ProfilePoint cosineForm(double q) noexcept;

/// 1 - ln(1 + c q) / ln(1 + c). Table 4.2 gives the logarithm an infinite slope under the finger, which no profile that
/// begins at 1 can have: with c = 100 it is -21.7, and -0.21 at the rim.
ProfilePoint logarithmForm(double q) noexcept;

ProfilePoint twoGaussiansForm(const TwoGaussians& shape, double q) noexcept;

/// Faded out over the last fifth: at the rim the tail alone would still be 5 %.
ProfilePoint powerForm(const PowerTail& shape, double q) noexcept;

/// The curve times a window that is 1 up to q = 0.8 and falls to 0 at q = 1 with slope 0 at both ends (smoothstep).
ProfilePoint fadedOut(const ProfilePoint& point, double q) noexcept;

}  // namespace palpate::tissue
