// Projected Gauss-Seidel sweeps over the few contacts there are.
//
// Data flow: couplings and requests of the plan -> here -> its amplitudes and shifts.
// Based on: Cottle, Pang, Stone, "The linear complementarity problem" (1992); E25.
#include "palpate/deform/together.h"

#include <algorithm>

#include "palpate/deform/contact.h"

namespace palpate::deform {

namespace {

/// Two contacts coupled by g approach their solution by g^2 a sweep; the error after n sweeps is at most depth / (e n)
/// whatever g: 0.007 mm of 10.
constexpr int kSweeps = 512;
/// Largest amplitude over the request: a finger in the bulge around another presses that down too. Bulges are below a
/// tenth.
constexpr double kMaxAmplitude = 1.5;
/// mm; far below what a float surface can show.
constexpr double kSettled = 1e-12;

}  // namespace

void solveDepths(const Coupling& coupling, std::span<const double> depths_mm,
                 std::span<double> amplitudes_mm) noexcept {
  std::fill(amplitudes_mm.begin(), amplitudes_mm.end(), 0.0);
  double change = 1.0;
  for (int sweep = 0; sweep < kSweeps && !(change < kSettled); ++sweep) {
    change = 0.0;
    for (std::size_t i = 0; i < coupling.size(); ++i) {
      const double wanted = std::max(0.0, depths_mm[i]);
      double missing = wanted;
      for (std::size_t j = 0; j < coupling.size(); ++j) missing -= j == i ? 0.0 : coupling(i, j) * amplitudes_mm[j];
      missing = std::clamp(missing, 0.0, kMaxAmplitude * wanted);
      change = std::max(change, std::abs(missing - amplitudes_mm[i]));
      amplitudes_mm[i] = missing;
    }
  }
  for (std::size_t i = 0; i < coupling.size(); ++i) amplitudes_mm[i] += std::min(0.0, depths_mm[i]);  // E19
}

void solveDrags(const Coupling& coupling, std::span<const Vec3> drags_mm, double cap_mm,
                std::span<Vec3> shifts_mm) noexcept {
  double longest = 0.0;
  for (const Vec3& drag : drags_mm) longest = std::max(longest, drag.norm());
  const double bound = std::min(cap_mm, longest);
  std::fill(shifts_mm.begin(), shifts_mm.end(), Vec3::Zero());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t i = 0; i < coupling.size(); ++i) {
      Vec3 missing = drags_mm[i];
      for (std::size_t j = 0; j < coupling.size(); ++j) {
        if (j != i) missing -= coupling(i, j) * shifts_mm[j];
      }
      missing = cappedLength(missing, bound);
      change = std::max(change, (missing - shifts_mm[i]).norm());
      shifts_mm[i] = missing;
    }
    if (change < kSettled) return;
  }
}

}  // namespace palpate::deform
