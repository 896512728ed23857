// The pressure under a fingertip: its pattern by depth of the press, and the bump that a lump makes in it.
//
// Without lump p0(r) = F (q + 1) / (pi c^2) (1 - r^2 / c^2)^q; stiff skin spreads the load, so the pattern is flat
// (Hertz would be q = 0.5). With lumps p = p0 (1 + sum of B (K - K0)). c and q are fitted to each solved press;
// docs/explanation/lumps.md has the errors.
#pragma once

#include <span>
#include <vector>

#include "palpate/tissue/lump_energy.h"
#include "palpate/tissue/press_field.h"

namespace palpate::tissue {

/// c and q of a place by depth. Immutable.
class PressureForm {
 public:
  /// Throws Error where no field is given.
  explicit PressureForm(std::span<const WeightedField> fields, double indenter_radius_mm = 8.0);

  /// Under a fingertip of this radius: c grows with its square root (not checked by finite elements for other radii
  /// than the solved one). Zero radius for d <= 0; beyond the last depth the pattern stays. No allocation.
  PressurePattern at(double depth_mm, double finger_mm = 8.0) const noexcept;

 private:
  std::vector<double> roots_;  ///< of the depths, mm
  std::vector<PressurePattern> patterns_;
  double indenter_radius_mm_;
};

/// The pattern of a press over lumps: large ones that lie deep are a harder ground, which is touched a little farther
/// out. `widening`: the sum over the lumps of what each adds to the force, as a share of the force without them, times
/// wideningOf. Fitted.
PressurePattern overLumps(PressurePattern pattern, double widening) noexcept;

/// 0 for lumps to 10 mm and those right under the skin's layer, to 1 for large and deep ones.
double wideningOf(const LumpShape& lump, double skin_mm) noexcept;

/// kPa at a distance from the tip, of a pattern whose sum is `force_n`; 0 outside.
double pressureAt(const PressurePattern& pattern, double force_n, double radius_mm) noexcept;

/// w: how wide the bump of a lump is, mm. `skin_mm`: thickness of the skin's layer.
double bumpWidth(const LumpShape& lump, double skin_mm, double depth_mm) noexcept;

/// K = (1 + s^2 / w^2)^(-5/2) at a distance s from the lump's foot.
double bumpAt(double distance_mm, double width_mm) noexcept;

/// K0 over the mean of K over the circle of radius c / 2 round the tip.
inline constexpr double kBumpBase = 0.53;

/// K0 where the tip is `offset_mm` from the foot.
double bumpBase(const PressurePattern& pattern, double offset_mm, double width_mm) noexcept;

}  // namespace palpate::tissue
