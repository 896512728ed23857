// Means of undirected axes in three ways, and how far each is off when the truth is known (E29, E30).
//
//   degrees       the angles as plain numbers, as the dissertation averages them
//   double_angle  the axes as (cos 2d, sin 2d): 0 and 180 degree are the same, every axis has one voice
//   tensor        the ellipses as log-Euclidean tensors: a near-circle has hardly a voice
// Based on: Ji (2008), Appendix C; Arsigny, Fillard, Pennec, Ayache, "Log-Euclidean metrics for fast and simple
// calculus on diffusion tensors", 2006.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "palpate/maps/measured_data.h"

namespace palpate::study {

enum class AxisMean : std::uint8_t { degrees, double_angle, tensor };
inline constexpr std::array kAxisMeans{AxisMean::degrees, AxisMean::double_angle, AxisMean::tensor};

/// In [0, 180) degree. Rows must not be empty.
double meanAxisDeg(std::span<const maps::MeasuredEllipse> rows, AxisMean mean);

/// Between two undirected axes, in [0, 90] degree.
double axisDifferenceDeg(double a_deg, double b_deg);

/// Ellipses of one true axis as several people would give them.
struct AxisScatter {
  /// Direction of the true axis; another one each trial where negative, because numbers err less around 90 degree, the
  /// middle of the range in which angles are written.
  double true_deg = 90.0;
  int people = 5;
  double spread_deg = 0.0;  ///< standard deviation of the angle, the same for every ellipse
  /// Standard deviation of the log-tensor's parts: the error of the measured radii. Turns near-circles more.
  double radius_noise = 0.0;
  int trials = 2000;
};

/// One measurement: as many rows as people, of a true ellipse of the mean measured size and ratio.
std::vector<maps::MeasuredEllipse> scatteredRows(const AxisScatter& scatter, std::uint64_t seed);

/// Root mean square error of each mean in degree, in the order of kAxisMeans.
std::array<double, 3> meanErrorsDeg(const AxisScatter& scatter);

}  // namespace palpate::study
