// The pressure under a fingertip, taxel by taxel: computed on demand from what a finger felt in a tick. Nothing
// of it is stored, so a replay gives the same bits.
//
//   FingerOutput, Lumps, PressureGround ─ pressureField ─► n x n taxels, kPa; shear
//
// Without lumps the pattern is that of the layers, p0 = F (q + 1) / (pi c^2) (1 - r^2 / c^2)^q. A lump makes a bump in
// it, p0 (1 + B (K - K0)), as large as what it adds to the force (tissue/pressure_form.h). Two sums hold then:
//
//   sum of p A = normal force
//   sum of p A x / sqrt(R^2 - r^2) = minus the lateral force of the lumps
//
// the second because every pressure on a frictionless sphere points to its middle. The sums are those of a grid at
// least 8 x 8 fine, of which a taxel is the mean.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"
#include "palpate/contact/lump_force.h"
#include "palpate/tissue/pressure_form.h"

namespace palpate::contact {

inline constexpr std::size_t kMinTaxels = 2;
inline constexpr std::size_t kMaxTaxels = 16;

/// A square of taxels on a fingertip, in the plane of the contact. The contact should lie within it: a smaller pad gets
/// the whole force all the same.
struct PressurePad {
  std::size_t taxels = 4;  ///< along a side, kMinTaxels to kMaxTaxels
  double size_mm = 16.0;   ///< of a side
};

/// The pad's axes: v towards the head, u = v x n to the right of who looks at the skin from outside.
struct PadPlane {
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
};
PadPlane padPlane(const Vec3& normal) noexcept;

/// The patterns of a body's tissue, by its thickness over the bone. Immutable; any number of threads.
class PressureGround {
 public:
  struct Place {
    double thickness_mm = 0.0;
    tissue::PressureForm form;
  };
  /// Thicknesses increase. Throws Error for none.
  explicit PressureGround(std::vector<Place> places);

  /// Straight in the logarithm of the thickness; thinner and thicker tissue counts as the first and last. No
  /// allocation.
  tissue::PressurePattern at(double tissue_mm, double depth_mm, double finger_mm) const noexcept;

 private:
  std::vector<Place> places_;
  std::vector<double> logs_;  ///< of their thicknesses
};

/// Sums over the taxels.
struct PadSums {
  double normal_n = 0.0;
  Vec2 lateral_n = Vec2::Zero();  ///< along u and v: of the lumps, without friction
};

/// Pressure of what a finger felt, kPa, `pad.taxels` rows of as many: the first row is nearest to the head, the first
/// taxel of a row lowest along u. Zeros for a finger that touches nothing. `kpa` and, unless empty, `shear_kpa` hold a
/// taxel each; shear is along u and v and acts on the finger: friction's share, the same part of the pressure
/// everywhere. A mobile lump is where FingerOutput says; others that move count as at their place. `lumps` may be null.
/// Move `felt` to rest first on a body that breathes (servo::atRest). No allocation; any thread. The sums are within
/// rounding where any pressures >= 0 have them, as those of a contact do.
PadSums pressureField(const PressureGround& ground, const Lumps* lumps, const FingerOutput& felt,
                      const PressurePad& pad, std::span<double> kpa, std::span<Vec2> shear_kpa = {}) noexcept;

}  // namespace palpate::contact
