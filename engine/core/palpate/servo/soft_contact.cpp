// d0 = min(2 mm, K step^2 / (2 F1)): with it the first step of depth gives about F1.
#include "palpate/servo/soft_contact.h"

#include <algorithm>

namespace palpate::servo {

namespace {

/// A first step of the force below this is left alone, N.
constexpr double kFirstForce = 0.25;
constexpr double kLongestToe = 2.0;  // mm

double toeLength(const contact::FingerOutput& contact, const tissue::ForceLaw& law, const Approach& approach) {
  double stiffness = localStiffness(contact, law) * approach.steepest * approach.stiffness_factor;
  if (approach.cap_n_per_mm > 0.0) stiffness = std::min(stiffness, approach.cap_n_per_mm);
  const double step = std::max(0.0, approach.step_mm);
  if (stiffness * step <= kFirstForce) return 0.0;
  return std::min(kLongestToe, stiffness * step * step / (2.0 * kFirstForce));
}

}  // namespace

double toeDepth(double toe_mm, double depth_mm) noexcept {
  if (!(toe_mm > 0.0)) return depth_mm;
  return depth_mm < toe_mm ? depth_mm * depth_mm / (2.0 * toe_mm) : depth_mm - 0.5 * toe_mm;
}

double softDepth(SoftContact& state, const contact::FingerOutput& contact, const tissue::ForceLaw& law,
                 const Approach& approach) noexcept {
  const double depth = contact.depth_mm;
  if (contact.touch == contact::Touch::free) {
    state = {};
    return depth;
  }
  if (!(depth > 0.0)) return depth;  // touches, presses nothing: nothing is known yet
  if (contact.rest_mm > 0.0 && !(contact.force.dot(contact.normal) > 0.0)) return depth;  // likewise: over its own dent
  if (!state.known) state = {true, toeLength(contact, law, approach)};
  return toeDepth(state.toe_mm, depth);
}

double localStiffness(const contact::FingerOutput& contact, const tissue::ForceLaw& law) noexcept {
  const double unit = tissue::normalForce(law, 1.0, contact.depth_mm, {contact.tissue_mm, contact.finger_mm});
  return contact.force.dot(contact.normal) / unit;
}

}  // namespace palpate::servo
