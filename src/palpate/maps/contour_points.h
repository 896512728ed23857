// Contour points: the places on the back where somebody measured an irregular boundary.
//
// A table, one row a point: name,x_mm,y_mm,r0_mm,r1_mm,... with 3 to 64 radii at equal angles from +x,
// counter-clockwise (r1 of 8 radii lies at 45 degree), the same number in every row. The first row may name the
// columns. x and y are the body frame's, seen along z. From here contour_map.h interpolates.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/maps/key_points.h"
#include "palpate/maps/polar_contour.h"

namespace palpate::maps {

struct ContourPoint {
  std::string name;
  Vec2 position_mm = Vec2::Zero();
  PolarContour contour;
};

/// An empty table is fine: no points. Throws Error with the line for a wrong number of fields, a header with other
/// names, anything that is not a finite number, a radius outside 0.001 to 10,000 mm.
std::vector<ContourPoint> readContourPoints(const std::filesystem::path& file);
std::vector<ContourPoint> parseContourPoints(std::string_view text, std::string_view file);

/// The table that parseContourPoints reads back; numbers keep every digit. Throws Error for a name that a table cannot
/// hold and for points whose numbers of radii differ.
std::string formatContourPoints(std::span<const ContourPoint> points);

/// The ellipses of key points as contours; key points without an ellipse are left out.
std::vector<ContourPoint> contourPointsOf(std::span<const KeyPoint> keys, std::size_t radii = kMaxContourRadii);

}  // namespace palpate::maps
