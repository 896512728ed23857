// The place that single presses of `palpate study credibility` are made at: next to the spine of an average body.
#pragma once

#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"
#include "palpate/tissue/layered_library.h"

namespace palpate::study {

inline constexpr double kCheckedThicknessMm = 35.0;  ///< skin to bone
inline constexpr double kCheckedFatMm = 8.0;
inline constexpr double kCheckedDepthMm = 5.0;
inline constexpr double kCheckedRadiusMm = 8.0;  ///< radius of the fingertip

/// Skin, fat and muscle there, with the moduli of the shipped stacks.
inline tissue::LayerStack checkedStack() {
  return tissue::libraryStack(kCheckedThicknessMm, tissue::libraryFatShare(kCheckedThicknessMm, kCheckedFatMm));
}

/// A flat sheet of layered tissue as at a place of a body, as stiff as its layers times a factor.
struct FlatPlace {
  double thickness_mm = kCheckedThicknessMm;
  double fat_mm = kCheckedFatMm;
  double stiffness_factor = 1.0;
};
contact::Surface flatSheet(const FlatPlace& place);

/// The product's own finger, pressed in ticks of `tick_s` to the depth and then dragged by `drag_mm` along x; a force a
/// millisecond. A whole number of ticks must make a millisecond.
struct FlatPress {
  double radius_mm = kCheckedRadiusMm;
  double depth_mm = kCheckedDepthMm;
  double drag_mm = 0.0;
  double tick_s = 0.001;
};
std::vector<Vec3> pressFlat(const contact::Surface& surface, const FlatPress& press);

}  // namespace palpate::study
