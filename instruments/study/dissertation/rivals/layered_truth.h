// Layered tissue under a rigid ball: finite element results of finite strain, made outside this project.
//
// The truth for the rivals of Table 4.1. layered_truth.json describes how it was made and checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::study {

inline constexpr double kBallRadiusMm = 8.0;

struct TissueLayer {
  double thickness_mm = 0.0;
  double modulus_kpa = 0.0;
};

struct LayeredPress {
  std::string tissue;               ///< "back_mid": 2 mm skin, 8 mm fat, 30 mm muscle; "bony"; "stiff_skin"
  std::vector<TissueLayer> layers;  ///< from the skin down
  double depth_mm = 0.0;            ///< nominal: 5 or 10
  double central_mm = 0.0;          ///< real depth of the skin under the ball
  double force_n = 0.0;
  double step_mm = 0.0;        ///< between the radii of the two profiles
  std::vector<double> inward;  ///< shares of central_mm, from the middle on
  std::vector<double> outward;
};

/// The text of layered_truth.json, compiled in: the command works from any folder.
std::string_view layeredTruthFile();

/// In the order of the file: by tissue, then by depth.
const std::vector<LayeredPress>& layeredPresses();

/// Throws Error for an unknown case.
const LayeredPress& layeredPress(std::string_view tissue, double depth_mm);

/// Where skin at this place of the plane goes, mm; beyond the last radius as at the last one.
Vec3 trueDisplacement(const LayeredPress& press, const Vec2& place);

}  // namespace palpate::study
