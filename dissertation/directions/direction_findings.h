// What fields and known axes say of averaging directions: the results, and sentences made of nothing but them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dissertation/directions/axis_means.h"
#include "dissertation/directions/direction_fields.h"

namespace palpate::study {

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
  double tensor_mirror_deg = 0.0;  ///< how far the tensors' field misses its mirror image
  AxisCurve spread_away;           ///< true axis at 90 degree
  AxisCurve spread_seam;           ///< true axis at 0 degree
  AxisCurve direction;             ///< over the true axis
  AxisCurve noise;                 ///< over the noise of the radii, any true axis
};

/// A paragraph each, most important first.
std::vector<std::string> directionFindings(const DirectionResults& results);

}  // namespace palpate::study
