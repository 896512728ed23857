// The dissertation's formulae that are used as printed; the others are corrected.
//
// The checked errata E1 to E34 (scene/errata.h has their texts) each name a place where the printed text is wrong,
// ambiguous or incomplete. This set is empty by default: no switchable printed form is used. (A few errata are settings
// of their own or keep the printed form; scene::errataByDefault lists them.) The literal forms live in files
// of their own, which query this set, so that a published result can be reproduced or one erratum studied alone.
#pragma once

#include <bitset>
#include <cstdint>

namespace palpate {

/// The value is the erratum's number in the list.
enum class Erratum : std::uint8_t {
  none = 0,
  E1_anchor = 1,
  E2_drag_spring,
  E3_stiffness_place,
  E4_else_if,
  E5_cell_box,
  E6_three_octants,
  E7_leaf_threshold,
  E8_empty_child,
  E9_vertex_on_plane,
  E10_half_spaces,
  E11_sphere_corners,
  E12_box_edges,
  E13_misprints,
  E14_location_ratio,
  E15_aspect,
  E16_full_axes,
  E17_depth_or_force,
  E18_profile_rim,
  E19_drag_cap,
  E20_zero_boundary,
  E21_press_region,
  E22_one_ellipse,
  E23_region_search,
  E24_pure_shear,
  E25_two_fingers,
  E26_weight_formulae,
  E27_weight_zero_by_zero,
  E28_effect_radius,
  E29_mean_of_angles,
  E30_key_averages,
  E31_down_like_up,
  E32_vertical_skin,
  E33_unnamed_radii,
  E34_drag_direction,
};
inline constexpr int kErrata = 34;

constexpr int numberOf(Erratum erratum) { return static_cast<int>(erratum); }

/// Erratum::none for a number that is not in the list.
constexpr Erratum erratumOf(int number) {
  return number >= 1 && number <= kErrata ? static_cast<Erratum>(number) : Erratum::none;
}

/// Plain data. Any thread.
class Fidelity {
 public:
  /// True where the printed form is wanted.
  bool literal(Erratum erratum) const { return literal_[placeOf(erratum)]; }
  /// Erratum::none is ignored.
  void setLiteral(Erratum erratum, bool literal = true) {
    if (erratum != Erratum::none) literal_[placeOf(erratum)] = literal;
  }
  void setAll(bool literal) {
    for (int number = 1; number <= kErrata; ++number) setLiteral(erratumOf(number), literal);
  }
  bool anyLiteral() const { return literal_.any(); }

  friend bool operator==(const Fidelity&, const Fidelity&) = default;

 private:
  static constexpr std::size_t placeOf(Erratum erratum) { return static_cast<std::size_t>(erratum); }
  std::bitset<kErrata + 1> literal_;  // bit 0 is not used
};

inline Fidelity literalFidelity() {
  Fidelity fidelity;
  fidelity.setAll(true);
  return fidelity;
}

}  // namespace palpate
