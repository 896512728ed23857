// The map of directions over the back blended as numbers and as tensors, compared place by place (E29).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/maps/measured_data.h"

namespace palpate::study {

// Means of undirected axes in three ways, and how far each is off when the truth is known (E29, E30).
//
//   degrees       the angles as plain numbers, as the dissertation averages them
//   double_angle  the axes as (cos 2d, sin 2d): 0 and 180 degree are the same, every axis has one voice
//   tensor        the ellipses as log-Euclidean tensors: a near-circle has hardly a voice
// Based on: Ji (2008), Appendix C; Arsigny, Fillard, Pennec, Ayache, "Log-Euclidean metrics for fast and simple
// calculus on diffusion tensors", 2006.

enum class AxisMean : std::uint8_t { degrees, double_angle, tensor };
inline constexpr std::array kAxisMeans{AxisMean::degrees, AxisMean::double_angle, AxisMean::tensor};

/// In [0, 180) degree. Rows must not be empty.
double meanAxisDeg(std::span<const maps::MeasuredEllipse> rows, AxisMean mean);

/// Between two undirected axes, in [0, 90] degree.
double axisDifferenceDeg(double a_deg, double b_deg);

/// Ellipses of one true axis as several people would give them.
struct AxisScatter {
  /// Of the true axis; another one each trial where negative, because numbers err less around 90 degree, the middle of
  /// the range in which angles are written.
  double true_deg = 90.0;
  int people = 5;
  double spread_deg = 0.0;  ///< standard deviation of the angle, the same for every ellipse
  /// Standard deviation of the log-tensor's parts: what the measured radii are off by. Turns near-circles more.
  double radius_noise = 0.0;
  int trials = 2000;
};

/// One measurement: as many rows as people, of a true ellipse of the mean measured size and ratio.
std::vector<maps::MeasuredEllipse> scatteredRows(const AxisScatter& scatter, std::uint64_t seed);

/// Root mean square error of each mean in degree, in the order of kAxisMeans.
std::array<double, 3> meanErrorsDeg(const AxisScatter& scatter);

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
