// Motion of a trunk with its breath: a smooth field of displacement that any place can query, skin, finger and picture
// alike. Everything moves along z, towards the back or away from it.
//
// Data flow: scene [breathing] ─► World.breath ─► servo (a finger feels the moved skin), view (the skin is drawn moved)
#pragma once

#include <optional>
#include <span>

#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk.h"

namespace palpate::body {

struct Breathing {
  bool on = false;
  double depth_mm = 1.5;     ///< how far the skin over the lower ribs moves between out and in
  double per_minute = 14.0;  ///< breaths
};

/// Plain data; any thread. Lengths in mm, the body's frame; places may be anywhere, also not finite.
class BreathField {
 public:
  /// `front_z`: least z of the skin. A body on a support leaves its front there and lifts its back; another one widens
  /// to both sides. Empty for a body without the landmarks of a spine, or that holds its breath.
  static std::optional<BreathField> of(const Breathing& breathing, std::span<const SkinLandmark> landmarks,
                                       const std::optional<Support>& support, double front_z);

  /// Motion of the lower ribs at this time, mm: 0 breathed out, Breathing::depth_mm breathed in. Begins breathed out.
  double lift(double seconds) const noexcept;
  /// The share of the lift at a place at rest, along +z: 1 on the back over the lower ribs.
  double share(const Vec3& rest) const noexcept;

  /// The present place of a point of the body at rest.
  Vec3 moved(const Vec3& rest, double lift_mm) const noexcept;
  /// The place at rest of a present point; to 1e-5 mm at a lift of 2 mm.
  Vec3 rest(const Vec3& moved, double lift_mm) const noexcept;

 private:
  Breathing breathing_;
  double pelvis_y_ = 0, ribs_low_y_ = 0, ribs_high_y_ = 0, neck_y_ = 0;  // where the lift begins, is full, and ends
  double still_z_ = 0, back_z_ = 0;                                      // where nothing moves, and the back
};

}  // namespace palpate::body
