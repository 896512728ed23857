// The displacement profile: how far a point of the skin follows the finger, by its location ratio q.
//
// 1 under the finger (q = 0), 0 on the rim of the deformation ellipse (q = 1) and beyond. The half Gaussian of the
// dissertation is lowered by its rest at the rim and stretched back to 1, so that the surface has no step there (E18);
// the closed form is what a finely interpolated table of it converges to. `deform` evaluates it in its kernels from the
// constants below; the functions serve everything that asks for single values.
// Based on: Ji, dissertation 2008, (4.1) to (4.3).
#pragma once

#include "palpate/base/gaussian.h"

namespace palpate::tissue {

/// halfGaussian(1) = exp(-1.96 pi): what is left of the Gaussian at the rim.
inline constexpr double kProfileRim = 0.0021174947706328428;
/// profile = kProfileScale exp(-kGaussianRate q^2) - kProfileOffset.
inline constexpr double kProfileScale = 1.0 / (1.0 - kProfileRim);
inline constexpr double kProfileOffset = kProfileRim * kProfileScale;
/// The largest slope of the profile, at q = 1 / sqrt(2 kGaussianRate): sqrt(2 kGaussianRate / e) kProfileScale.
inline constexpr double kProfileSteepest = 2.1330022826720994;

/// Share of the finger's displacement at location ratio q >= 0, in [0, 1]; continuous (E18). NaN gives 0.
inline double profile(double q) noexcept { return q < 1.0 ? kProfileScale * halfGaussian(q) - kProfileOffset : 0.0; }

}  // namespace palpate::tissue
