// The closed forms behind ProfileCurve, each with its derivative, before the rim is finished.
//
// Based on: Ji, dissertation 2008, (4.1), (4.2), Figure 4.4 and Table 4.2; two Gaussians and the power tail are fits to
// finite element models of layered tissue (docs/reference/deformation-forms.md).
#pragma once

#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/fidelity.h"
#include "palpate/tissue/profile_curve.h"
#include "palpate/tissue/profile_settings.h"

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

/// These settings with what the fidelity takes literally: the profile as printed is the half Gaussian through 700
/// stored entries, nearest lookup, with its step at the rim. Based on: Ji, dissertation 2008, (4.2), (4.3); E18.
inline ProfileSettings withFidelity(ProfileSettings settings, const Fidelity& fidelity) {
  if (!fidelity.literal(Erratum::E18_profile_rim)) return settings;
  settings.rim = ProfileRim::step;
  if (settings.kind == ProfileKind::half_gaussian) settings.kind = ProfileKind::table;
  return settings;
}

/// The pull towards the finger: pressed skin does not only sink, it is drawn in sideways.
///
/// A share of the depth, zero under the finger, largest at q = width, faded out towards the rim. Layered tissue shows 5
/// to 11 % of the depth at half the half Gaussian's radius (finite elements, docs/reference/deformation-forms.md); the
/// dissertation has no such term, so it is off by default.
/// inward displacement = share depth (q/width) exp(1/2 - q^2 / (2 width^2)).
struct RadialTerm {
  double share = 0.0;  ///< of the depth, at its largest; 0 = off, below 0 pushes outward
  double width = 0.4;  ///< the q where it is largest
};

/// The inward share of the depth at location ratio q, and its derivative by q.
inline ProfilePoint radialPull(const RadialTerm& term, double q) noexcept {
  if (!(q < 1.0)) return {};
  const double x = q / term.width;
  const double bell = term.share * elementary::exp(0.5 * (1.0 - x * x));
  return fadedOut({x * bell, (1.0 - x * x) / term.width * bell}, q);
}

}  // namespace palpate::tissue
