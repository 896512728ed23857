// Several fingers on one skin: amplitudes for which each finger gets its requested displacement.
//
// Displacements of several contacts add up, so a finger in the other's dent would sink too deep. The amplitudes sought
// are those with sum_j coupling_ij amplitude_j = depth_i; a contact that the others press deeper than it wants drops
// out with amplitude 0 (E25: the dissertation uses two devices but never says how they combine). Solved by projected
// Gauss-Seidel sweeps: always bounded, and exact for the few fingers there are. Based on: the linear complementarity
// view of contact, Cottle, Pang, Stone, "The linear complementarity problem", 1992.
#pragma once

#include <span>

#include "palpate/base/vec.h"

namespace palpate::deform {

/// Motion of contact i's anchor by contact j per unit of its own amplitude: row i, column j; 1 on the diagonal.
class Coupling {
 public:
  Coupling(std::span<const double> values, std::size_t contacts) : values_(values), contacts_(contacts) {}
  double operator()(std::size_t i, std::size_t j) const { return values_[i * contacts_ + j]; }
  std::size_t size() const { return contacts_; }

 private:
  std::span<const double> values_;
  std::size_t contacts_;
};

/// Amplitudes >= 0. Each contact ends as deep as requested, or deeper with amplitude 0. Two contacts nearer than about
/// a hundredth of their radius may be left up to 0.01 mm short. A negative depth (as printed, E19) is its own
/// amplitude; the others do not feel it.
void solveDepths(const Coupling& coupling, std::span<const double> depths_mm, std::span<double> amplitudes_mm) noexcept;

/// The same for drags: shift vectors, none longer than the cap or the longest drag. Without the latter two fingers that
/// pull nearly the same skin apart would get large opposite shifts, and the skin around them would move and shear more
/// than any finger pulls; with it they get as much of their way as drags of that length can give.
void solveDrags(const Coupling& coupling, std::span<const Vec3> drags_mm, double cap_mm,
                std::span<Vec3> shifts_mm) noexcept;

}  // namespace palpate::deform
