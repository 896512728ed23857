#include "palpate/measure/field/skin_field.h"

#include <cmath>

#include "palpate/measure/field/field_form.h"

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
  const FormValue value = formAt(field.form, rho2, field.inverse_tail, field.sideways);
  const double distance2 = offset.squaredNorm();
  const double outwards = field.peak_mm.norm() * pressShapeAt(rho2).value.dot(field.pressed) *
                          std::exp(0.25 * (field.log_shape[0] + field.log_shape[2]));
  const Vec2 moved = value.round * field.peak_mm + outwards * offset;
  if (distance2 == 0.0) return moved;
  return moved + value.radial * offset * (offset.dot(field.peak_mm) / distance2);
}

}  // namespace palpate::measure
