// Two maps of the same key points that differ in one setting, read place by place. How far a boundary moves is measured
// in 90 directions, for the angle alone says little where the ellipse is nearly round.
// Based on: Ji, dissertation 2008, 5.2 and 5.3, with E29.
#include "dissertation/directions/direction_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dissertation/directions/axis_means.h"

namespace palpate::study {

namespace {

constexpr double kNoticeableDeg = 10.0;

double radiusAt(const maps::Ellipse& ellipse, double angle_rad) {
  return 1.0 / maps::locationRatio(ellipse, Vec2(std::cos(angle_rad), std::sin(angle_rad)));
}

}  // namespace

maps::LiteralEllipseMap directionMap(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend) {
  maps::LiteralForms forms;
  forms.direction = blend;
  return {keys, {}, forms};
}

double directionDegAt(const maps::LiteralEllipseMap& map, const Vec2& place) {
  return map.at(place.x(), place.y()).direction_rad * kDegPerRad;
}

double boundaryDifferenceMm(const maps::Ellipse& a, const maps::Ellipse& b) {
  constexpr int kDirections = 90;
  double most = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    most = std::max(most, std::abs(radiusAt(a, angle) - radiusAt(b, angle)));
  }
  return most;
}

FieldComparison compareFields(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend,
                              std::span<const Vec2> places) {
  const maps::LiteralEllipseMap map = directionMap(keys, blend);
  const maps::LiteralEllipseMap tensor = directionMap(keys, maps::DirectionBlend::tensor);
  const auto n = static_cast<double>(places.size());
  FieldComparison comparison;
  for (const Vec2& place : places) {
    const maps::Ellipse here = map.at(place.x(), place.y());
    const maps::Ellipse right = tensor.at(place.x(), place.y());
    const double here_deg = here.direction_rad * kDegPerRad;
    const double difference = axisDifferenceDeg(here_deg, right.direction_rad * kDegPerRad);
    comparison.mean_deg += difference / n;
    comparison.most_deg = std::max(comparison.most_deg, difference);
    if (difference > kNoticeableDeg) comparison.share_above_10_deg += 1.0 / n;
    comparison.most_boundary_mm = std::max(comparison.most_boundary_mm, boundaryDifferenceMm(here, right));
    const double mirrored = 180.0 - directionDegAt(map, {-place.x(), place.y()});
    comparison.mirror_deg = std::max(comparison.mirror_deg, axisDifferenceDeg(here_deg, mirrored));
  }
  return comparison;
}

}  // namespace palpate::study
