// The ellipse map as the dissertation prints it, wholly or erratum by erratum, kept to reproduce its results; the
// engine's own is ellipse_map.h.
//
// From the same key points and settings it answers the same queries as EllipseMap. With a Fidelity without literal
// errata it returns the same ellipses, only slower.
// Based on: Ji, dissertation 2008, sections 5.2 and 5.3, as printed.
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "palpate/base/fidelity.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/literal_interpolation.h"

namespace palpate::maps {

/// Method of blending directions.
enum class DirectionBlend : std::uint8_t {
  tensor,        ///< size, shape and direction together, log-Euclidean (E29)
  double_angle,  ///< size and ratio as numbers, directions as (cos 2d, sin 2d): the cheap cure
  raw_degrees,   ///< all three as numbers, the basic circle pointing to 90 degree: as printed
};

/// Printed forms in use. The defaults are the corrected ones.
struct LiteralForms {
  /// Empty: the engine's w = a / (1 - a).
  std::optional<LiteralWeights> weights;
  DirectionBlend direction = DirectionBlend::tensor;
  bool table_levels = false;        ///< effect levels from the 700-entry table
  bool base_without_value = false;  ///< E27: on coincident keys the basic circle instead of their mean
  bool diameter_as_radius = false;  ///< E28: key points reach twice the effect radius
  bool ratio_as_aspect = false;     ///< E15: aspect = major/minor, 1 or more: the long side is across
  bool full_axes_as_half = false;   ///< E16: key ellipses twice as large
  bool projected_length = false;    ///< E32: lifted along z, longer by 1/cos

  friend bool operator==(const LiteralForms&, const LiteralForms&) = default;
};

/// E26 takes the printed products (and blends directions by double angle, because an axis must not change with the sum
/// of weights); E27 the products, the table and the basic circle where (5.16) has no value; E29 raw degrees; E15, E16,
/// E28 and E32 as above. E30 is a matter of the key points (Averaging::plain).
LiteralForms literalForms(const Fidelity& fidelity);

class LiteralEllipseMap {
 public:
  /// Key points with an empty ellipse are left out. Throws Error if the basic radius is not a positive number.
  LiteralEllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings, const LiteralForms& forms);
  LiteralEllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings, const Fidelity& fidelity)
      : LiteralEllipseMap(keys, settings, literalForms(fidelity)) {}

  /// The ellipse at a place of the map plane. Never NaN: where the printed formula has no value it is the basic circle.
  /// The printed products give an empty ellipse at every key point but the first, and near them ratios below 1. The
  /// aspect is above 1 there and with E15: the other axis is the longer one.
  /// O(n), with product weights O(n^2); no allocation.
  Ellipse at(double x_mm, double y_mm) const noexcept;

  /// The ellipse at a surface point. With E32 the axis seen along z keeps its shadow's length; where the surface is
  /// vertical (n_z = 0) (5.3) has no value and the corrected axis is used.
  SurfaceEllipse on(const Vec3& point, const Vec3& normal) const noexcept;

 private:
  /// The blended quantity: by tensor (LogTensor, 0), by double angle (half-major, ratio, cos 2d, sin 2d), raw
  /// (half-major, ratio, degree, 0).
  using Blended = Eigen::Vector4d;
  struct Key {
    Vec2 position;
    Blended value;
  };

  Blended encoded(const Ellipse& ellipse) const;
  Ellipse decoded(const Blended& value) const;
  double levelOf(const Key& key, const Vec2& place) const;
  Blended blendedAt(const Vec2& place) const;
  Blended blendedByWeights(const Vec2& place) const;

  LiteralForms forms_;
  std::vector<Key> keys_;
  Blended base_;
  double reach_mm_;
};

/// (5.3): the half-major axis of the map projected along z on the tangent plane: longer by 1/cos of the slope along it.
/// On a vertical surface, where the projection has no end, the corrected axis.
SurfaceEllipse literallyLiftedOntoSurface(const Ellipse& ellipse, const Vec3& normal);

/// The ellipse map of a scene: the engine's own, or the printed one where an erratum of the maps is literal. Query it
/// like EllipseMap.
class AnyEllipseMap {
 public:
  /// Throws Error like EllipseMap.
  AnyEllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings, const LiteralForms& forms)
      : keys_(keys.begin(), keys.end()),
        map_(forms == LiteralForms{} ? Maps(EllipseMap(keys, settings))
                                     : Maps(LiteralEllipseMap(keys, settings, forms))) {}

  /// The key points it was made of.
  std::span<const KeyPoint> keys() const { return keys_; }

  Ellipse at(double x_mm, double y_mm) const noexcept {
    const auto* own = std::get_if<EllipseMap>(&map_);
    return own != nullptr ? own->at(x_mm, y_mm) : std::get_if<LiteralEllipseMap>(&map_)->at(x_mm, y_mm);
  }
  SurfaceEllipse on(const Vec3& point, const Vec3& normal) const noexcept {
    const auto* own = std::get_if<EllipseMap>(&map_);
    return own != nullptr ? own->on(point, normal) : std::get_if<LiteralEllipseMap>(&map_)->on(point, normal);
  }

 private:
  using Maps = std::variant<EllipseMap, LiteralEllipseMap>;
  std::vector<KeyPoint> keys_;
  Maps map_;
};

}  // namespace palpate::maps
