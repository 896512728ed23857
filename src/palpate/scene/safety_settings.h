// What a haptic device may be asked to do to a hand. Set by the scene, obeyed by the servo (servo/limiter.h).
#pragma once

namespace palpate::scene {

struct SafetySettings {
  /// Largest force sent to the device, N. 3.3 N is what a desktop pen device (Touch, Omni) holds for a moment.
  double nominal_force_n = 3.3;
  /// Time over which forces grow from nothing after a start, a jump or a stall, s: long enough to let go.
  double ramp_s = 0.5;
  /// The force may change per tick by stiffness * (slew_per_motion * |motion of the tip| + slew_mm): the law that
  /// bounds the proxy's path, so that ordinary contact is never limited and only jumps of the contact are. Motion in
  /// mm.
  double slew_per_motion = 2.0;
  double slew_mm = 0.1;  ///< per millisecond
  /// A tip faster than this has not been moved by a hand: the encoder or the connection failed. mm/s.
  double max_tip_speed_mm_per_s = 20000.0;
  /// Take away push when the skin has given back more energy than it was given (passivity).
  bool passivity = true;
  /// Energy that may be given back before that starts, N mm: what a device's own friction swallows.
  double passivity_allowance_n_mm = 1.0;
};

}  // namespace palpate::scene
