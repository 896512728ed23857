// The law of a layer: the energy of a deformation gradient, and its stress. A press is axisymmetric, so five numbers of
// the gradient are enough.
//
// W = mu/2 (F:F - 3) - mu ln J + lambda/2 (ln J)^2, P = mu (F - F^-T) + lambda ln J F^-T: compressible neo-Hookean.
// W splits into a part of shear and one of volume, which an element adds up over points of their own.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace palpate::elements {

/// kPa.
struct NeoHookean {
  double shear = 0.0;   ///< mu
  double volume = 0.0;  ///< lambda
};

inline NeoHookean neoHookean(double young_kpa, double poisson) {
  return {young_kpa / (2.0 * (1.0 + poisson)), young_kpa * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))};
}

/// F in the order rr, rz, zr, zz, hoop: row i, column j of the plane at 2 i + j.
inline constexpr std::size_t kGradients = 5;
using Gradient = std::array<double, kGradients>;

/// Energy of a unit of volume (kPa = uJ/mm^3), its first derivative and, below and on the diagonal, its second.
struct Answer {
  double energy = 0.0;
  Gradient stress{};  ///< first Piola-Kirchhoff
  std::array<std::array<double, kGradients>, kGradients> stiffness{};
};

/// det F, or something <= 0 where the material is turned inside out.
inline double volumeRatio(const Gradient& f) {
  const double plane = f[0] * f[3] - f[1] * f[2];
  return plane > 0.0 && f[4] > 0.0 ? plane * f[4] : -1.0;
}

/// `f` must not be turned inside out.
inline Answer evaluateLaw(const NeoHookean& law, const Gradient& f) {
  const double plane = f[0] * f[3] - f[1] * f[2];
  const double log_volume = std::log(plane * f[4]);
  const Gradient inverse = {f[3] / plane, -f[2] / plane, -f[1] / plane, f[0] / plane, 1.0 / f[4]};  // F^-T
  Answer answer;
  double squares = -3.0;
  for (std::size_t i = 0; i < kGradients; ++i) {
    squares += f[i] * f[i];
    answer.stress[i] = law.shear * (f[i] - inverse[i]) + law.volume * log_volume * inverse[i];
  }
  answer.energy = 0.5 * law.shear * squares - law.shear * log_volume + 0.5 * law.volume * log_volume * log_volume;

  const double turning = law.shear - law.volume * log_volume;
  for (std::size_t a = 0; a < kGradients; ++a) {
    for (std::size_t b = 0; b <= a; ++b) answer.stiffness[a][b] = law.volume * inverse[a] * inverse[b];
    answer.stiffness[a][a] += law.shear;
  }
  // dP_iJ / dF_kL holds G_iL G_kJ; the hoop couples with itself alone.
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      answer.stiffness[a][b] += turning * inverse[2 * (a / 2) + b % 2] * inverse[2 * (b / 2) + a % 2];
    }
  }
  answer.stiffness[4][4] += turning * inverse[4] * inverse[4];
  return answer;
}

}  // namespace palpate::elements
