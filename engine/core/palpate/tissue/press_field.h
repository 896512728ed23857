// How much a press strains the tissue below it: strain energy densities per kPa of modulus, by place and by depth of
// the press.
//
// The finite element solver writes it as the optional key `field` of a layered table; lumps are felt through it
// (lump_energy.h). Rows jump at the borders of layers, so every layer has rows of its own from its top to its bottom,
// and nothing is interpolated across. Places are those of the tissue at rest.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace palpate::mesh {
class JsonValue;
}

namespace palpate::tissue {

struct LayerStack;

/// How the pressure of a press falls off from the middle: p = F (q + 1) / (pi c^2) (1 - r^2 / c^2)^q.
struct PressurePattern {
  double contact_radius_mm = 0.0;  ///< c, seen along the axis
  double exponent = 0.0;           ///< q; 0: flat, 0.5: Hertz
};

/// Densities are kept as their fourth roots, which change nearly straight between neighbours.
struct PressField {
  std::vector<double> radii_mm;   ///< from the axis, increasing from 0
  std::vector<double> rows_mm;    ///< under the skin at rest; a layer's first row at its top, its last at its bottom
  std::vector<int> row_layers;    ///< of the stack, one per row
  std::vector<double> depths_mm;  ///< of the presses, increasing, > 0
  std::vector<PressurePattern> patterns;  ///< one per press
  /// Fourth roots of w_s = (F:F - 3) / 2 - ln J and w_v = (ln J)^2 / 2: that of row i, radius j, press k at
  /// (i * radii + j) * presses + k.
  std::vector<float> shear;
  std::vector<float> volume;

  std::size_t size() const { return rows_mm.size() * radii_mm.size() * depths_mm.size(); }
};

/// Throws Error naming what makes no sense for this stack: sizes, numbers that are not finite or out of range, radii,
/// rows or depths that do not increase, a layer whose rows do not reach from its top to its bottom.
void check(const PressField& field, const LayerStack& stack);

/// The value of a table's key `field`, and back. Reading throws Error at a value of the wrong kind; check() is the
/// caller's.
std::string fieldText(const PressField& field);
PressField fieldFrom(const mesh::JsonValue& value);

/// For a depth at rest: up to four neighbouring rows of its layer and their weights, which add up to 1. No rows at or
/// in the bone, where nothing is strained.
struct FieldRow {
  std::size_t first = 0;
  std::size_t count = 0;
  std::array<double, 4> weight{};
};
FieldRow rowAt(const PressField& field, double depth_mm) noexcept;

/// A place among the field's knots, found once for all presses: cubic down a layer, straight outwards.
struct FieldPlace {
  std::size_t count = 0;            ///< 0: nothing is strained
  std::array<std::size_t, 8> at{};  ///< of the first press, in `shear` and `volume`
  std::array<float, 8> weight{};    ///< of fourth roots
};
FieldPlace placeAt(const PressField& field, const FieldRow& row, double radius_mm) noexcept;

/// w_s and w_v of one press.
struct StrainDensity {
  double shear = 0.0;
  double volume = 0.0;
};
StrainDensity densityAt(const PressField& field, const FieldPlace& place, std::size_t press) noexcept;

}  // namespace palpate::tissue
