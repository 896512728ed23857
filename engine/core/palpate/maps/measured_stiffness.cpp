// One of three fields through the keys that have a stiffness, clamped to credible values.
//
// Based on: Ji, dissertation 2008, section 5.2 (GRI); the limits are our own.
#include "palpate/maps/measured_stiffness.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "palpate/maps/gaussian_interpolation.h"

namespace palpate::maps {

namespace {

/// Softer than any tissue; ensures a force where a fit gives none or less.
constexpr double kSoftestNPerMm = 0.01;
/// Factor beyond the measured range up to which a fit is accepted.
constexpr double kMaxExtrapolation = 4.0;

std::vector<KeyPoint> withStiffness(std::span<const KeyPoint> keys) {
  std::vector<KeyPoint> measured;
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(measured),
               [](const KeyPoint& key) { return key.stiffness_n_per_mm.has_value(); });
  return measured;
}

std::pair<double, double> plausibleStiffness(const std::vector<KeyPoint>& keys) {
  const auto softer = [](const KeyPoint& a, const KeyPoint& b) {
    return *a.stiffness_n_per_mm < *b.stiffness_n_per_mm;
  };
  const auto [least, most] = std::minmax_element(keys.begin(), keys.end(), softer);
  const double low = std::max(kSoftestNPerMm, *least->stiffness_n_per_mm / kMaxExtrapolation);
  return {low, std::max(low, *most->stiffness_n_per_mm * kMaxExtrapolation)};
}

FitError errorAt(const std::vector<KeyPoint>& keys, const MeasuredStiffnessField& field) {
  FitError error;
  for (const KeyPoint& key : keys) {
    const double miss = std::abs(field.fittedAt(key.position_mm) - *key.stiffness_n_per_mm);
    error.rms += miss * miss;
    error.max = std::max(error.max, miss);
  }
  if (!keys.empty()) error.rms = std::sqrt(error.rms / static_cast<double>(keys.size()));
  return error;
}

}  // namespace

double MeasuredStiffnessField::Gri::at(const Vec2& place_mm) const noexcept {
  GaussianBlend<double> blend(basic_n_per_mm);
  for (const KeyPoint& key : keys) {
    blend.add(effectLevel((place_mm - key.position_mm).norm(), effect_radius_mm), *key.stiffness_n_per_mm);
  }
  return blend.result();
}

MeasuredStiffnessField::Field MeasuredStiffnessField::fitted(const std::vector<KeyPoint>& keys,
                                                             const MeasuredStiffness& settings) {
  if (settings.interpolation == StiffnessInterpolation::gri) {
    return Gri{keys, settings.effect_radius_mm, settings.basic_n_per_mm};
  }
  std::vector<Vec2> places;
  std::vector<double> values;
  for (const KeyPoint& key : keys) {
    places.push_back(key.position_mm);
    values.push_back(*key.stiffness_n_per_mm);
  }
  if (settings.interpolation == StiffnessInterpolation::thin_plate) return ThinPlateSpline(places, values);
  return PolynomialSurface(places, values, settings.polynomial_degree);
}

MeasuredStiffnessField::MeasuredStiffnessField(std::span<const KeyPoint> keys, const MeasuredStiffness& settings)
    : field_(fitted(withStiffness(keys), settings)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<KeyPoint> measured = withStiffness(keys);
  const bool stays_between = settings.interpolation == StiffnessInterpolation::gri;
  limits_ = stays_between ? std::pair{-kInfinity, kInfinity} : plausibleStiffness(measured);
  error_ = errorAt(measured, *this);
}

double MeasuredStiffnessField::fittedAt(const Vec2& place_mm) const noexcept {
  if (const auto* gri = std::get_if<Gri>(&field_)) return gri->at(place_mm);
  if (const auto* plate = std::get_if<ThinPlateSpline>(&field_)) return plate->at(place_mm);
  return std::get_if<PolynomialSurface>(&field_)->at(place_mm);
}

double MeasuredStiffnessField::at(const Vec2& place_mm) const noexcept {
  return std::clamp(fittedAt(place_mm), limits_.first, limits_.second);
}

StiffnessOfPositions measuredStiffness(std::span<const Vec3> positions, std::span<const KeyPoint> keys,
                                       const MeasuredStiffness& settings) {
  const MeasuredStiffnessField field(keys, settings);
  StiffnessOfPositions stiffness;
  stiffness.error = field.fitError();
  stiffness.n_per_mm.reserve(positions.size());
  for (const Vec3& position : positions) {
    const double fitted = field.fittedAt(position.head<2>());
    stiffness.n_per_mm.push_back(std::clamp(fitted, field.limits().first, field.limits().second));
    if (stiffness.n_per_mm.back() != fitted) ++stiffness.limited;
  }
  return stiffness;
}

}  // namespace palpate::maps
