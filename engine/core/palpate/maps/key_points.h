// Key points: the places on the back that were measured.
//
// One row per key point: name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg[,stiffness_n_per_mm]. The
// first row may name the columns; then further measured quantities may follow by name
// (measuredColumns()). x and y are the body frame's (x to the patient's right seen from behind, y cranial), seen along
// z. From here the maps are interpolated (ellipse_map.h, stiffness_map.h).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/maps/ellipse.h"
#include "palpate/maps/measured_data.h"

namespace palpate::maps {

struct KeyPoint {
  std::string name;
  Vec2 position_mm = Vec2::Zero();
  Ellipse ellipse;
  std::optional<double> stiffness_n_per_mm;
};

/// Names of what a measurement may add to a row. Read as numbers or nothing, and not used by maps.
std::span<const std::string_view> measuredColumns();

/// Reads a table; a ratio below 1 is an ellipse whose longer axis is across the given direction (E30). An empty table
/// is fine: no key points. A row whose three fields of the ellipse are all empty has none: only the stiffness was
/// measured there. Throws Error with the line for a wrong number of fields, anything that is not a finite
/// number, a size outside 0.001 to 10,000 mm, a ratio outside 0.001 to 1,000, a negative stiffness.
std::vector<KeyPoint> readKeyPoints(const std::filesystem::path& file);
std::vector<KeyPoint> parseKeyPoints(std::string_view text, std::string_view file);

/// Selects the measured data for the built-in key points.
struct MeasuredDataChoice {
  ForceDirection force = ForceDirection::up;
  Averaging averaging = Averaging::plain;
};

/// The dissertation's measured means (Appendix C, Fig 5.3) with P6 and P7 mirrored from P4 and P5. Their places on the
/// built-in body are assumed (E33): the text gives vertebrae and 100 mm offsets only.
std::vector<KeyPoint> dissertationKeyPoints(const MeasuredDataChoice& choice = {});

}  // namespace palpate::maps
