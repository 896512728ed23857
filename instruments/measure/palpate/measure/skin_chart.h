// The chart: a smooth map from the picture to the skin, made of the dots themselves, so that neither the camera's tilt
// nor the back's curvature counts.
//
//   DotGrid ─ SkinChart ─► places and displacements along the skin, mm
#pragma once

#include <memory>
#include <span>

#include "palpate/base/vec.h"
#include "palpate/measure/dot_grid.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// A step that is right and up in the picture, as right and headwards on the skin.
Vec2 headUp(const Vec2& in_picture, HeadTowards head);

class SkinChart {
 public:
  /// Needs at least 6 dots that are not in one line (throws Error). `turns`: quarter turns from picture to head up.
  SkinChart(const DotGrid& grid, double spacing_mm, HeadTowards head);
  ~SkinChart();
  SkinChart(SkinChart&&) noexcept;

  /// Column and row times the spacing at the dots; mm, x to the patient's right as seen, y towards the head.
  Vec2 skinAt(const Vec2& picture_px) const;
  /// d skin / d picture, mm per px.
  Mat2 jacobianAt(const Vec2& picture_px) const;
  /// The place in the first picture; nearest where the chart does not reach.
  Vec2 pictureAt(const Vec2& skin_mm) const;
  /// Whether a place lies among the dots: in the union of the meshes of the grid that have three corners or more.
  bool covers(const Vec2& skin_mm) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::measure
