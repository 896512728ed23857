// The soft toe of a fast first touch: less force near the surface, as a function of the depth alone.
//
// A tip that arrives at 0.5 m/s is half a millimetre inside before the loop knows, and would meet the whole spring at
// once. Ramps in time and limits of the change soften that too, but they take force away on the way in and give it back
// on the way out: they make energy (docs/explanation/safety.md). A law of the depth cannot.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/tissue/force_law.h"

namespace palpate::servo {

/// State of one contact, from its first tick to its last.
struct SoftContact {
  bool known = false;   ///< whether this contact has a toe has been decided
  double toe_mm = 0.0;  ///< d0; 0: none
};

/// Inputs that decide whether a contact that begins gets a toe.
struct Approach {
  double step_mm = 0.0;           ///< motion of the tip into the skin in a tick
  double stiffness_factor = 1.0;  ///< share of the contact's force that the hand feels
  double steepest = 1.0;          ///< greatest slope of the force law over that of a light touch
  double cap_n_per_mm = 0.0;      ///< largest slope that the hand may feel; 0: none
};

/// The depth whose force is felt at `depth_mm`.
double toeDepth(double toe_mm, double depth_mm) noexcept;

/// The depth whose force is felt in this tick, mm: the contact's own without a toe. Decides in the first tick of a
/// contact and forgets when it ends.
double softDepth(SoftContact& state, const contact::FingerOutput& contact, const tissue::ForceLaw& law,
                 const Approach& approach) noexcept;

/// This place's force over the law's for 1 N/mm: the map's stiffness. The contact must press.
double localStiffness(const contact::FingerOutput& contact, const tissue::ForceLaw& law) noexcept;

}  // namespace palpate::servo
