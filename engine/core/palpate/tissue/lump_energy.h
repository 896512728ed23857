// A lump in layered tissue as an energy U(rho, d) that it adds to a press: rho the distance of the tip from the lump's
// axis, d the depth of the press. The force that it adds is the gradient, so closed paths cost nothing.
//
// U is the strain energy density of the press without lump, integrated over the lump, times Eshelby's saturation
// (m - 1) / (1 + beta (m - 1)) of its stiffness ratio m. First order in the modulus by reciprocity; how the saturation
// ends near skin, bone and other layers, and under a deep press, is fitted (docs/explanation/lumps.md: errors, limits).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpate/tissue/layered_table.h"
#include "palpate/tissue/press_field.h"

namespace palpate::tissue {

/// An ellipsoid under the skin, round when seen along the normal.
struct LumpShape {
  std::array<double, 3> half_axes_mm = {5.0, 5.0, 5.0};  ///< across, across, into the body; the first two are equal
  double depth_mm = 8.0;                                 ///< of its top under the skin at rest, along the normal
  double stiffness_ratio = 5.0;                          ///< Young's modulus over that of the layer at its centre
  std::optional<double> young_kpa = {};                  ///< instead of the ratio
  double edge = 0.0;  ///< 0 sharp to 1: share of the radius over which the modulus falls smoothly to the tissue's

  double radiusMm() const;  ///< a: cube root of the product of the half axes
  double centreMm() const { return depth_mm + half_axes_mm[2]; }
  double bottomMm() const { return depth_mm + 2.0 * half_axes_mm[2]; }
};

/// kPa in the middle of the lump.
double youngModulus(const LumpShape& lump, const LayerStack& stack);

/// Throws Error for a lump that cannot be in this stack: sizes out of range, a top less than 0.5 mm under the skin's
/// layer, a bottom less than 1 mm over the bone, a modulus below 0.2 times the layer's, a stack without skin over
/// another layer.
void check(const LumpShape& lump, const LayerStack& stack);

/// Where tops may be, mm: from half a millimetre under the skin's layer to where 1 mm is left over the bone.
struct TopRange {
  double from_mm = 0.0;
  double to_mm = 0.0;
};
TopRange topRange(const LumpShape& lump, const LayerStack& stack);

/// The field of a stack and how much of it is at a place: shares add up to 1. The pointers are not owned.
struct WeightedField {
  const LayerStack* stack = nullptr;
  const PressField* field = nullptr;
  double share = 1.0;
};

/// A factor for the force on the axis at a depth, from a solve of the lump itself (`lumps = "solved"`). Depths
/// increasing; straight between them, constant beyond.
struct ForceCorrection {
  double depth_mm = 0.0;
  double factor = 1.0;  ///< of the extra force
};

struct LumpAnswer {
  double energy_n_mm = 0.0;
  double d_rho = 0.0;      ///< dU/drho, N; the tip feels -d_rho away from the lump's axis
  double d_depth = 0.0;    ///< dU/dd, N: what the lump adds to the normal force
  double d_rho_rho = 0.0;  ///< N/mm; a lump that moves needs it
};

struct LumpSlopes {
  double d_rho = 0.0;
  double d_depth = 0.0;
};

/// The steepest of a table, N/mm, for bounds of stability.
struct LumpSteepness {
  double depth = 0.0;     ///< of |d2U/dd2|
  double rho = 0.0;       ///< of |d2U/drho2|
  double snapping = 0.0;  ///< of -d2U/drho2: a lump on a spring softer than this slips away with a snap
};

/// Immutable table of 32 distances x 24 depths, bicubic, C1; even in rho. Copies share the table.
class LumpEnergy {
 public:
  static constexpr std::size_t kRhos = 32;
  static constexpr std::size_t kDepths = 24;

  /// Costs some 10 ms a field. `stack` is that of the place: its layers and borders decide the saturation. Throws Error
  /// as check(lump, stack) does, and where no field is given.
  LumpEnergy(const LumpShape& lump, const LayerStack& stack, std::span<const WeightedField> fields,
             std::span<const ForceCorrection> correction = {});

  /// U times a factor: of the stiffness of the place over that of its stack, or to keep a bound of stability.
  LumpEnergy scaled(double factor) const;

  /// 0 from reachMm() on and for d <= 0; beyond deepestMm() the force goes straight on with its last slope. Negative
  /// rho is as positive. No allocation.
  LumpAnswer at(double rho_mm, double depth_mm) const noexcept;
  /// dU/drho and dU/dd alone, and the latter alone, to the same bits in less time.
  LumpSlopes slopesAt(double rho_mm, double depth_mm) const noexcept;
  double forceAt(double rho_mm, double depth_mm) const noexcept;

  double reachMm() const noexcept;    ///< the lump is felt up to here: 30 mm + a from its axis
  double deepestMm() const noexcept;  ///< last depth of the table
  double radiusMm() const noexcept;   ///< a
  LumpSteepness steepest() const noexcept;

 private:
  struct Table;
  std::shared_ptr<const Table> table_;
  double factor_ = 1.0;
};

}  // namespace palpate::tissue
