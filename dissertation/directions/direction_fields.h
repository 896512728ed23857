// The map of directions over the back blended as numbers and as tensors, compared place by place (E29).
#pragma once

#include <span>

#include "palpate/maps/literal_ellipse_map.h"

namespace palpate::study {

/// A map of the same key points with one way to blend directions.
maps::LiteralEllipseMap directionMap(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend);

double directionDegAt(const maps::LiteralEllipseMap& map, const Vec2& place);

/// The largest distance in mm between the boundaries of two concentric ellipses, over all directions.
double boundaryDifferenceMm(const maps::Ellipse& a, const maps::Ellipse& b);

/// What a blend does to the back.
struct FieldComparison {
  double mean_deg = 0.0;  ///< difference of direction from the tensor's, over the back
  double most_deg = 0.0;
  double share_above_10_deg = 0.0;  ///< of the back's area
  double most_boundary_mm = 0.0;    ///< how far the boundary of the region moves at the worst place
  double mirror_deg = 0.0;          ///< largest breach of the symmetry: d(-x, y) should be 180 - d(x, y)
};

/// `places` as placesOnBack gives them.
FieldComparison compareFields(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend,
                              std::span<const Vec2> places);

}  // namespace palpate::study
