// True motion of the skin of a synthetic case: inside the family of formulas that is fitted, and outside it.
//
//   Press ─► TrueField ─ displacementAt, dentAt ─► SyntheticBody (synthetic_body.h); ellipses for the truth
#pragma once

#include "palpate/base/vec.h"
#include "palpate/measure/field/skin_field.h"
#include "palpate/measure/synthesis/synthetic_case.h"

namespace palpate::measure {

class TrueField {
 public:
  explicit TrueField(const Press& press);

  /// Along the skin, mm.
  Vec2 displacementAt(const Vec2& place_mm) const;
  /// Into the body at this place of the skin, mm.
  double dentAt(const Vec2& place_mm) const;

  /// Through the places that move by this much; half axes 0 where nothing does. For a field outside the family, the
  /// ellipse through its contour. Every sd is 0.
  KeyEllipse ellipseAt(double level_mm) const;

  /// The formula; of a half space only contact and peak.
  const SkinField& formula() const { return formula_; }
  /// The largest shortening of the skin along the drag, a share; 1 would fold it.
  double largestShortening() const;

 private:
  Vec2 halfSpaceAt(const Vec2& offset_mm) const;

  Press press_;
  SkinField formula_;
  double patch_mm_ = 0.0;   // sd of the load on a half space
  double strength_ = 0.0;   // its strength: displacement times distance, far away, mm^2
  double window_mm_ = 0.0;  // end of a windowed one; 0: none
};

}  // namespace palpate::measure
