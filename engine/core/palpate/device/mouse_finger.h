// The mouse as a finger: a place on the skin and a request (this deep, or this strong) become the path of a tip that a
// hand could have made. Pure: one step a servo tick, no clock, no window.
//
//   60 Hz: cursor ─ picking ─► FingerTarget ─ triple buffer ─► 1 kHz: MouseFinger::step ─► tip ─► contact::step
//                                                                        ▲ force of the last tick (press by force)
//
// A mouse reports sixty positions a second; fed to the contact directly it would feel like sixty small jumps. So the
// place and the depth follow critically damped (no overshoot), and the direction of the press turns slowly: it was
// chosen when the finger went down, and the relief of the skin must not shake it.
#pragma once

#include <functional>

#include "palpate/base/triple_buffer.h"
#include "palpate/base/vec.h"
#include "palpate/device/device.h"

namespace palpate::device {

enum class PressBy : std::uint8_t {
  depth,  ///< a stiff place pushes back harder
  force,  ///< a stiff place yields less: the depth follows from the force
};

/// The display's target for one finger; plain data that crosses threads by copy.
struct FingerTarget {
  bool present = false;  ///< false: it has not been over the skin yet
  bool pressed = false;
  PressBy by = PressBy::depth;
  double depth_mm = 6.0;  ///< depth of the pad under the skin at rest
  double force_n = 3.0;
  double max_depth_mm = 25.0;   ///< press by force goes no deeper, however soft the place
  double radius_mm = 0.0;       ///< finger radius: the tip is the ball's centre, the pad its end
  Vec3 place = Vec3::Zero();    ///< on the skin at rest
  Vec3 normal = Vec3::UnitZ();  ///< unit, out of the skin
};

struct MouseFingerSettings {
  double tick_s = 0.001;
  /// Rates of the critically damped followers, 1/s; 95 % of a step is done after 4.7 / rate.
  double place_rate = 120.0;      ///< 40 ms: hides the steps of the mouse, stays under the hand
  double depth_rate = 40.0;       ///< 120 ms: a finger going down
  double turn_pressed_s = 0.150;  ///< time constant of the direction while pressed
  double turn_free_s = 0.030;     ///< and in the air
  double hover_mm = 6.0;          ///< height of the pad over the skin when it does not press
  double jump_mm = 40.0;          ///< a place farther away is reached in one step, in the air, instead of flown to
  double force_s = 0.060;         ///< time constant of press by force
  double max_depth_speed_mm_per_s = 120.0;  ///< the depth, in press by force
};

/// Waiting place of a finger that has not been over the skin: a hundred metres behind the back. Not NaN: the servo
/// would use the last good place instead, and in the beginning that is the middle of the body.
inline const Vec3 kNowhere(0.0, 0.0, 1e5);

struct FingerStep {
  Vec3 tip = kNowhere;  ///< kNowhere while the finger is not present
  bool jumped = false;  ///< it is elsewhere now: its contact is forgotten
};

class MouseFinger {
 public:
  explicit MouseFinger(const MouseFingerSettings& settings = {}) : settings_(settings) {}

  /// One tick. `felt_force` is the force on the tip in the last tick, N. No allocation.
  FingerStep step(const FingerTarget& target, const Vec3& felt_force) noexcept;

  /// Depth of the pad now, mm; negative in the air.
  double depth() const noexcept { return depth_; }

 private:
  bool mustJump(const FingerTarget& target) const noexcept;
  void jump(const FingerTarget& target) noexcept;
  void turn(const FingerTarget& target) noexcept;
  void pressByForce(const FingerTarget& target, const Vec3& felt_force) noexcept;

  MouseFingerSettings settings_;
  bool present_ = false;
  Vec3 place_ = Vec3::Zero();
  Vec3 place_speed_ = Vec3::Zero();
  Vec3 normal_ = Vec3::UnitZ();
  double depth_ = 0.0;
  double depth_speed_ = 0.0;
};

/// One finger between the display and the servo.
struct MouseLink {
  TripleBuffer<FingerTarget> target{FingerTarget{}};  ///< display writes, servo reads
  MouseFinger finger;                                 ///< servo, like what follows
  Vec3 felt_force = Vec3::Zero();
  Vec3 tip = Vec3::Zero();
};

/// One tick, on the servo thread before the contact's. True when the finger jumped: its contact must forget what it
/// touched, or it would be dragged through the body. No lock, no allocation.
bool advance(MouseLink& link) noexcept;

/// Reads the tip that `advance` made. The link must outlive the device.
device::Device mouseDevice(std::string name, MouseLink& link);

}  // namespace palpate::device
