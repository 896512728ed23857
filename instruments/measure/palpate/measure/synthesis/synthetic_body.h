// The synthetic back as a surface: a chart by arc length on a height field, pressed, dragged and moved.
//
//   BackShape ─► SyntheticBody ─ placeAt ─► points in space ─ SyntheticCamera ─► px
#pragma once

#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/synthesis/synthetic_case.h"
#include "palpate/measure/synthesis/true_field.h"

namespace palpate::measure {

/// Half of the back's width and length, mm along the skin.
inline constexpr double kHalfWidthMm = 175.0;
inline constexpr double kHalfLengthMm = 200.0;

class SyntheticBody {
 public:
  explicit SyntheticBody(const BackShape& shape);

  /// `skin_mm`: arc length along the midline upwards (y), then along the row to the right (x).
  Vec3 placeAt(const Vec2& skin_mm) const;
  Vec3 normalAt(const Vec2& skin_mm) const;
  /// Dragged and dented.
  Vec3 pressedAt(const Vec2& skin_mm, const TrueField& field) const;

 private:
  double heightAt(double x, double y) const;

  BackShape shape_;
  std::vector<double> row_y_;     // one per row of the chart
  std::vector<double> column_x_;  // one per place of every row, row by row
};

/// After the body's own motion about its middle.
Vec3 movedBody(const Vec3& place, const BodyMotion& motion);

}  // namespace palpate::measure
