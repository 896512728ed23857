// Key ellipses are stored as logarithms, blended by GRI at the queried place, turned back into an ellipse and lifted.
//
// Based on: Ji, dissertation 2008, sections 5.2 and 5.3, with E26 to E29 and E32.
#include "palpate/maps/ellipse_map.h"

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/maps/gaussian_interpolation.h"

namespace palpate::maps {

EllipseMap::EllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings)
    : base_(logTensor({settings.basic_radius_mm, 1.0})), effect_radius_mm_(settings.effect_radius_mm) {
  if (!(settings.basic_radius_mm > 0.0) || !std::isfinite(settings.basic_radius_mm)) {
    throw Error("ellipse map: the basic radius must be above 0 mm");
  }
  for (const KeyPoint& key : keys) {
    if (key.ellipse.half_major_mm > 0.0) keys_.push_back({key.position_mm, logTensor(key.ellipse)});
  }
}

Ellipse EllipseMap::at(double x_mm, double y_mm) const noexcept {
  GaussianBlend<LogTensor> blend(base_);
  for (const Key& key : keys_) {
    blend.add(effectLevel((Vec2(x_mm, y_mm) - key.position).norm(), effect_radius_mm_), key.tensor);
  }
  return ellipseOf(blend.result());
}

SurfaceEllipse EllipseMap::on(const Vec3& point, const Vec3& normal) const noexcept {
  return liftedOntoSurface(at(point.x(), point.y()), normal);
}

}  // namespace palpate::maps
