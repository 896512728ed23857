// The map of directions over the back blended as numbers and as tensors, compared place by place (E29).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "dissertation/directions/axis_means.h"
#include "palpate/maps/literal_ellipse_map.h"

namespace palpate::study {

/// A map of the same key points with one way to blend directions.
maps::LiteralEllipseMap directionMap(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend);

double directionDegAt(const maps::LiteralEllipseMap& map, const Vec2& place);

/// The largest distance in mm between the boundaries of two concentric ellipses, over all directions.
double boundaryDifferenceMm(const maps::Ellipse& a, const maps::Ellipse& b);

/// Effect of a blend on the back.
struct FieldComparison {
  double mean_deg = 0.0;  ///< difference of direction from the tensor's, over the back
  double most_deg = 0.0;
  double share_above_10_deg = 0.0;  ///< share of the back's area
  double most_boundary_mm = 0.0;    ///< largest motion of the region's boundary
  double mirror_deg = 0.0;          ///< largest breach of the symmetry: d(-x, y) should be 180 - d(x, y)
};

/// `places` as placesOnBack gives them.
FieldComparison compareFields(std::span<const maps::KeyPoint> keys, maps::DirectionBlend blend,
                              std::span<const Vec2> places);

// Findings from fields and known axes about averaging directions: the results, and sentences made of nothing but them.

struct PointMeans {
  maps::ForceDirection force = maps::ForceDirection::up;
  int point = 1;
  std::array<double, 3> deg{};  ///< in the order of kAxisMeans
  double resultant = 0.0;
};

/// Between the printed mean and the tensor's, degree.
double printedAgainstTensor(const PointMeans& means);

/// Errors of the three means over something varied.
struct AxisCurve {
  std::vector<double> x;
  std::array<std::vector<double>, 3> error_deg;
};

inline constexpr double kStudiedSpread = 20.0;

struct DirectionResults {
  std::vector<PointMeans> means;
  std::array<double, 3> flip{};
  FieldComparison printed_up;  ///< raw degrees, the printed means
  FieldComparison doubled_up;  ///< double angle
  FieldComparison printed_down;
  double tensor_mirror_deg = 0.0;  ///< distance of the tensors' field from its mirror image
  AxisCurve spread_away;           ///< true axis at 90 degree
  AxisCurve spread_seam;           ///< true axis at 0 degree
  AxisCurve direction;             ///< over the true axis
  AxisCurve noise;                 ///< over the noise of the radii, any true axis
};

/// Paragraphs, most important first.
std::vector<std::string> directionFindings(const DirectionResults& results);

}  // namespace palpate::study
