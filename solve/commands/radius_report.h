// `palpate tissue realism --radius`: the force on fingers of other radii than a fingertip's, next to finite elements.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpate/base/progress.h"

namespace palpate::app {

/// One press of a sphere.
struct RadiusPress {
  std::string name;
  double radius_mm = 0.0;
  double depth_mm = 0.0;
  double true_force_n = 0.0;  ///< of finite elements
  double force_n = 0.0;       ///< that the finger feels
  double fingertip_n = 0.0;   ///< that a fingertip of 8 mm would feel: the force before the radius counted
  double error() const { return force_n / true_force_n - 1.0; }
};

struct RadiusReport {
  std::vector<RadiusPress> presses;
  std::vector<std::string> left_out;  ///< where the solver finds no equilibrium
  /// Fraction; of this radius, or of all (0).
  double worst(double radius_mm = 0.0) const;
};

/// Solves spheres of 2, 4, 8, 12 and 16 mm at three depths each over six places of a body, and presses the product's
/// own fingers there (some two minutes).
RadiusReport judgeRadius(const Progress& progress = {});

std::string radiusText(const RadiusReport& report);
nlohmann::ordered_json radiusJson(const RadiusReport& report);

}  // namespace palpate::app
