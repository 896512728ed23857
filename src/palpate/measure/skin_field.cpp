// Based on: Ji, dissertation 2008, (4.14) (the half Gaussian, E19), with a tail of free length in its place.
#include "palpate/measure/skin_field.h"

#include <cmath>

namespace palpate::measure {

namespace {

/// exp of a symmetric matrix given by xx, xy, yy.
Mat2 shapeOf(const Vec3& log_shape) {
  const double mean = 0.5 * (log_shape[0] + log_shape[2]);
  const double half_difference = 0.5 * (log_shape[0] - log_shape[2]);
  const double spread = std::hypot(half_difference, log_shape[1]);
  // sinh(s)/s has the limit 1, and that is all a circle needs.
  const double ratio = spread > 1e-9 ? std::sinh(spread) / spread : 1.0;
  const double size = std::exp(mean);
  Mat2 shape;
  shape << size * (std::cosh(spread) + ratio * half_difference), size * ratio * log_shape[1],
      size * ratio * log_shape[1], size * (std::cosh(spread) - ratio * half_difference);
  return shape;
}

}  // namespace

Vec2 displacementAt(const SkinField& field, const Vec2& place_mm) {
  const Vec2 offset = place_mm - field.contact_mm;
  const double rho2 = offset.dot(shapeOf(field.log_shape) * offset);
  const double k = field.inverse_tail;
  const double fall = k * rho2 > 1e-7 ? std::exp(-std::log1p(k * rho2) / k) : std::exp(-rho2 + 0.5 * k * rho2 * rho2);
  const double distance2 = offset.squaredNorm();
  Vec2 strength = field.peak_mm;
  if (distance2 > 0.0)
    strength += field.sideways * rho2 / (1.0 + rho2) * offset * (offset.dot(field.peak_mm) / distance2);
  return fall * strength;
}

}  // namespace palpate::measure
