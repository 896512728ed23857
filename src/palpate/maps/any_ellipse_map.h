// The ellipse map a scene asks for: the engine's own, or the printed one where an erratum of the maps is taken
// literally. Ask it like EllipseMap.
#pragma once

#include <variant>

#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/literal_ellipse_map.h"

namespace palpate::maps {

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
