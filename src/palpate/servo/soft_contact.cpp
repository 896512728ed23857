// d0 = min(2 mm, K step^2 / (2 F1)): with it the first step of depth gives about F1. Own.
#include "palpate/servo/soft_contact.h"

#include <algorithm>

namespace palpate::servo {

namespace {

/// A first step of the force below this is left alone, N.
constexpr double kFirstForce = 0.25;
constexpr double kLongestToe = 2.0;  // mm

tissue::PressedPlace placeOf(const contact::FingerOutput& contact) { return {contact.tissue_mm, contact.finger_mm}; }

double toeOf(const contact::FingerOutput& contact, const tissue::ForceLaw& law, const Approach& approach) {
  const double unit = tissue::normalForce(law, 1.0, contact.depth_mm, placeOf(contact));
  const double local = contact.force.dot(contact.normal) / unit;  // the map's stiffness here
  const double stiffness = local * approach.steepest * approach.stiffness_factor;
  const double step = std::max(0.0, approach.step_mm);
  if (stiffness * step <= kFirstForce) return 0.0;
  return std::min(kLongestToe, stiffness * step * step / (2.0 * kFirstForce));
}

}  // namespace

double toeDepth(double toe_mm, double depth_mm) noexcept {
  if (!(toe_mm > 0.0)) return depth_mm;
  return depth_mm < toe_mm ? depth_mm * depth_mm / (2.0 * toe_mm) : depth_mm - 0.5 * toe_mm;
}

double softShare(SoftContact& state, const contact::FingerOutput& contact, const tissue::ForceLaw& law,
                 const Approach& approach) noexcept {
  if (contact.touch == contact::Touch::free) {
    state = {};
    return 1.0;
  }
  if (!(contact.depth_mm > 0.0)) return 1.0;  // touches, presses nothing: nothing is known yet
  if (contact.rest_mm > 0.0 && !(contact.force.dot(contact.normal) > 0.0)) return 1.0;  // likewise: over its own dent
  if (!state.known) state = {true, toeOf(contact, law, approach)};
  if (!(state.toe_mm > 0.0)) return 1.0;
  const double felt = toeDepth(state.toe_mm, contact.depth_mm);
  if (law.kind == tissue::ForceLaw::Kind::linear) return felt / contact.depth_mm;
  const double whole = tissue::normalForce(law, 1.0, contact.depth_mm, placeOf(contact));
  return whole > 0.0 ? tissue::normalForce(law, 1.0, felt, placeOf(contact)) / whole : 1.0;
}

}  // namespace palpate::servo
