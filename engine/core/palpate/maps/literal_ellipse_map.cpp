// The literal errata choose a form of the weights, of the direction's blend, of sizes and of the lift; literalForms has
// the table of that choice.
//
// Based on: Ji, dissertation 2008, sections 5.2 and 5.3, as printed (E15, E16, E26 to E29, E32).
#include "palpate/maps/literal_ellipse_map.h"

#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/maps/gaussian_interpolation.h"

namespace palpate::maps {

namespace {

/// d_c of (5.2).
constexpr double kBasicDirectionDeg = 90.0;

/// In (0, 180]: Appendix C writes a level axis as 180 degree.
double printedDegree(double direction_rad) { return direction_rad == 0.0 ? 180.0 : direction_rad / kRadPerDeg; }

/// Weights that do not sum to 1 may leave no ellipse (0 or less): an empty one.
Ellipse ellipseOfNumbers(double half_major_mm, double ratio, double direction_rad) {
  if (!(half_major_mm > 0.0) || !(ratio > 0.0)) return {};
  return {half_major_mm, 1.0 / ratio, canonicalEllipse(1.0, 1.0, direction_rad).direction_rad};
}

}  // namespace

LiteralForms literalForms(const Fidelity& fidelity) {
  LiteralForms forms;
  if (fidelity.literal(Erratum::E27_weight_zero_by_zero)) forms.weights = LiteralWeights::products;
  if (fidelity.literal(Erratum::E26_weight_formulae)) {
    forms.weights = LiteralWeights::printed_products;
    forms.direction = DirectionBlend::double_angle;
  }
  if (fidelity.literal(Erratum::E29_mean_of_angles)) forms.direction = DirectionBlend::raw_degrees;
  forms.table_levels = forms.base_without_value = fidelity.literal(Erratum::E27_weight_zero_by_zero);
  forms.diameter_as_radius = fidelity.literal(Erratum::E28_effect_radius);
  forms.ratio_as_aspect = fidelity.literal(Erratum::E15_aspect);
  forms.full_axes_as_half = fidelity.literal(Erratum::E16_full_axes);
  forms.projected_length = fidelity.literal(Erratum::E32_vertical_skin);
  return forms;
}

LiteralEllipseMap::LiteralEllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings,
                                     const LiteralForms& forms)
    : forms_(forms), reach_mm_(settings.effect_radius_mm * (forms.diameter_as_radius ? 2.0 : 1.0)) {  // E28
  if (!(settings.basic_radius_mm > 0.0) || !std::isfinite(settings.basic_radius_mm)) {
    throw Error("ellipse map: the basic radius must be above 0 mm");
  }
  base_ = encoded({settings.basic_radius_mm, 1.0, kBasicDirectionDeg * kRadPerDeg});
  if (forms.direction == DirectionBlend::double_angle) base_.tail<2>().setZero();  // a circle has no direction
  for (const KeyPoint& key : keys) {
    Ellipse ellipse = key.ellipse;
    if (!(ellipse.half_major_mm > 0.0)) continue;
    if (forms.full_axes_as_half) ellipse.half_major_mm *= 2.0;  // E16
    keys_.push_back({key.position_mm, encoded(ellipse)});
  }
}

LiteralEllipseMap::Blended LiteralEllipseMap::encoded(const Ellipse& ellipse) const {
  const double ratio = 1.0 / ellipse.aspect;
  const double twice = 2.0 * ellipse.direction_rad;
  switch (forms_.direction) {
    case DirectionBlend::tensor: {
      const LogTensor tensor = logTensor(ellipse);
      return {tensor.x(), tensor.y(), tensor.z(), 0.0};
    }
    case DirectionBlend::double_angle:
      return {ellipse.half_major_mm, ratio, elementary::cos(twice), elementary::sin(twice)};
    case DirectionBlend::raw_degrees:
      break;
  }
  return {ellipse.half_major_mm, ratio, printedDegree(ellipse.direction_rad), 0.0};
}

Ellipse LiteralEllipseMap::decoded(const Blended& value) const {
  switch (forms_.direction) {
    case DirectionBlend::tensor:
      return ellipseOf(value.head<3>());
    case DirectionBlend::double_angle: {
      const bool undirected = value.tail<2>().isZero(1e-12);  // rounding alone: no direction, as for a circle
      const double twice = undirected ? std::numbers::pi : elementary::atan2(value[3], value[2]);
      return ellipseOfNumbers(value[0], value[1], 0.5 * twice);
    }
    case DirectionBlend::raw_degrees:
      break;
  }
  return ellipseOfNumbers(value[0], value[1], value[2] * kRadPerDeg);
}

double LiteralEllipseMap::levelOf(const Key& key, const Vec2& place) const {
  const double distance = (place - key.position).norm();
  return forms_.table_levels ? tabulatedEffectLevel(distance, reach_mm_) : effectLevel(distance, reach_mm_);
}

LiteralEllipseMap::Blended LiteralEllipseMap::blendedByWeights(const Vec2& place) const {
  GaussianBlend<Blended> blend(base_);
  for (const Key& key : keys_) blend.add(levelOf(key, place), key.value);
  return blend.result();
}

LiteralEllipseMap::Blended LiteralEllipseMap::blendedAt(const Vec2& place) const {
  if (!forms_.weights) return blendedByWeights(place);
  const auto level = [&](std::size_t i) { return levelOf(keys_[i], place); };
  const auto value = [&](std::size_t i) { return keys_[i].value; };
  const std::optional<Blended> blend = literalBlend<Blended>(*forms_.weights, keys_.size(), level, value, base_);
  if (blend) return *blend;
  return forms_.base_without_value ? base_ : blendedByWeights(place);  // E27
}

Ellipse LiteralEllipseMap::at(double x_mm, double y_mm) const noexcept {
  Ellipse ellipse = decoded(blendedAt(Vec2(x_mm, y_mm)));
  if (forms_.ratio_as_aspect) ellipse.aspect = 1.0 / ellipse.aspect;  // E15
  return ellipse;
}

SurfaceEllipse LiteralEllipseMap::on(const Vec3& point, const Vec3& normal) const noexcept {
  const Ellipse ellipse = at(point.x(), point.y());
  return forms_.projected_length ? literallyLiftedOntoSurface(ellipse, normal) : liftedOntoSurface(ellipse, normal);
}

SurfaceEllipse literallyLiftedOntoSurface(const Ellipse& ellipse, const Vec3& normal) {
  SurfaceEllipse lifted = liftedOntoSurface(ellipse, normal);
  const double shadow_mm = lifted.half_major.head<2>().norm();
  // A lifted axis without a shadow is on a vertical surface.
  const double n_z = std::abs(normal.z()) / normal.norm();
  if (!(shadow_mm > 0.0) || !(n_z > 1e-9)) return lifted;
  lifted.half_major *= ellipse.half_major_mm / shadow_mm;  // E32
  return lifted;
}

}  // namespace palpate::maps
