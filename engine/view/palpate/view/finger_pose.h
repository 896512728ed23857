// Poses of drawn fingers: on the deformed skin, never in it.
//
// The haptic finger follows its tip below the skin; the drawn one rests on the deformed skin. The ball is laid on the
// deformed friction anchor along the contact's normal and lifted until no triangle around reaches into it. No GL.
#pragma once

#include <optional>

#include "palpate/contact/finger_state.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/scene/world.h"

namespace palpate::view {

class DrawnSkin;

/// Linear colours of the two hands; further fingers have the neutral one.
inline const Vec3f kLeftFinger{0.10f, 0.26f, 0.78f};
inline const Vec3f kRightFinger{0.76f, 0.09f, 0.07f};
inline const Vec3f kOtherFinger{0.55f, 0.50f, 0.20f};

/// The maximum of a press.
struct Peak {
  double depth_mm = 0.0;
  double force_n = 0.0;
};

/// A finger as it is drawn.
struct FingerMark {
  contact::FingerOutput contact;
  double radius_mm = 8.0;  ///< radius of the drawn ball
  Vec3f colour = kLeftFinger;
  double haptic_radius_mm = 0.0;    ///< radius of the touching ball: the tip is its centre
  bool left = true;                 ///< which hand, when hands are drawn
  double outline = 0.0;             ///< width of a light rim, points: for a finger that was left in place
  std::optional<Peak> lifted = {};  ///< its numbers for a moment after it was lifted
  contact::PressurePad pad = {};    ///< for the overlay `pressure`
};

/// The drawn ball.
struct FingerPose {
  Vec3 centre = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, from the skin to the finger
  Vec3f colour = kLeftFinger;
  double radius_mm = 8.0;
  bool touches = false;
  bool left = true;      ///< which hand
  double outline = 0.0;  ///< FingerMark::outline, in points until the renderer makes it pixels
};

FingerPose computeFingerPose(const scene::World& world, const DrawnSkin& skin, const FingerMark& finger);

/// The pad of a scene's finger; four taxels along a side where it has none.
contact::PressurePad fingerPad(const scene::Scene& scene, std::size_t finger);

}  // namespace palpate::view
