// Marks of a stencil computed by the tests' own arithmetic: a flat sheet seen by a tilted camera, dragged by a half
// Gaussian that is written out here. Shares no code with what it judges.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

struct DrawnSheet {
  int columns = 10;
  int rows = 12;
  double spacing_mm = 30.0;
  double px_per_mm = 4.0;
  double tilt_deg = 0.0;  ///< of the camera about the picture's x
  double roll_deg = 0.0;
  double distance_mm = 1300.0;
};

/// y of the sheet is up, of the picture down; the middle of the sheet is the middle of a picture of 1600 x 2000.
inline Vec2 seen(const DrawnSheet& sheet, const Vec2& place_mm) {
  const double roll = sheet.roll_deg * kRadPerDeg;
  const double tilt = sheet.tilt_deg * kRadPerDeg;
  const Vec2 turned(std::cos(roll) * place_mm.x() - std::sin(roll) * place_mm.y(),
                    std::sin(roll) * place_mm.x() + std::cos(roll) * place_mm.y());
  const double depth = sheet.distance_mm + std::sin(tilt) * turned.y();
  const double focal = sheet.px_per_mm * sheet.distance_mm;
  return {800.0 + focal * turned.x() / depth, 1000.0 - focal * std::cos(tilt) * turned.y() / depth};
}

inline Vec2 placeOf(const DrawnSheet& sheet, int column, int row) {
  return sheet.spacing_mm * Vec2(column - 0.5 * (sheet.columns - 1), row - 0.5 * (sheet.rows - 1));
}

inline Vec2 atRest(const Vec2& /*place_mm*/) { return Vec2::Zero(); }

/// Row by row from the bottom left, moved by `motion` (mm) in the second list.
inline DotPair drawnDots(const DrawnSheet& sheet, const std::function<Vec2(const Vec2&)>& motion,
                         double noise_mm = 0.0) {
  Random random(7);
  const auto noise = [&] { return Vec2(noise_mm * random.normal(), noise_mm * random.normal()); };
  DotPair pair;
  const double area = 50.0 * sheet.px_per_mm * sheet.px_per_mm;
  for (int row = 0; row < sheet.rows; ++row) {
    for (int column = 0; column < sheet.columns; ++column) {
      const Vec2 place = placeOf(sheet, column, row);
      pair.before.push_back({seen(sheet, place + noise()), area});
      pair.after.push_back({seen(sheet, place + motion(place) + noise()), area});
    }
  }
  return pair;
}

/// A half Gaussian of `peak_mm` upwards about the middle whose 2 mm ellipse has these half axes, `direction_deg` the
/// major one's.
inline std::function<Vec2(const Vec2&)> drag(double peak_mm, double half_major_mm, double half_minor_mm,
                                             double direction_deg, const Vec2& contact_mm = Vec2::Zero()) {
  return [=](const Vec2& place) {
    const double angle = direction_deg * kRadPerDeg;
    const Vec2 off = place - contact_mm;
    const double along = (std::cos(angle) * off.x() + std::sin(angle) * off.y()) / half_major_mm;
    const double across = (-std::sin(angle) * off.x() + std::cos(angle) * off.y()) / half_minor_mm;
    return Vec2(0.0, peak_mm * std::exp(-std::log(peak_mm / 2.0) * (along * along + across * across)));
  };
}

inline bool says(const std::vector<Finding>& findings, const std::string& code) {
  for (const Finding& finding : findings) {
    if (finding.code == code) return true;
  }
  return false;
}

}  // namespace palpate::measure
