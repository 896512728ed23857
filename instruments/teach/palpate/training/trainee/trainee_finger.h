// How a simulated trainee presses one place: the way of its hand's goal, tick by tick, and the felt force.
//
//   PressRequest ─ begin ─► travel over the skin ─► down until the force is felt ─► hold, with tremor ─► up
//   felt sample ─ next ─► HandGoal (device/simulated_hand.h)            hold ─► FeltPress: force over depth
//
// The goal is where the arm draws the hand; the device lags and gives way (a person's arm is a soft spring), so force
// and depth come out of the whole loop. Motions are minimum-jerk. Based on: Flash and Hogan, J. Neurosci. 5, 1985.
#pragma once

#include <cstdint>

#include "palpate/device/simulated_hand.h"
#include "palpate/trace/sample.h"

namespace palpate::training {

struct PressRequest {
  Vec3 skin = Vec3::Zero();     ///< where the pad comes down, at rest, mm
  Vec3 normal = Vec3::UnitZ();  ///< out of the skin there
  double pad_mm = 8.0;          ///< from the tip of the device to the pad's surface: the finger's radius
  double force_n = 1.5;         ///< force that it wants to feel
  double hold_s = 0.5;
};

/// Means over the hold, without its first 0.1 s.
struct FeltPress {
  double force_n = 0.0;  ///< the device's, along the press
  double depth_mm = 0.0;
  bool reached = false;  ///< the wanted force came
  double stiffness() const { return depth_mm > 0.0 ? force_n / depth_mm : 0.0; }
};

class TraineeFinger {
 public:
  TraineeFinger(const Vec3& start, double tick_s) : tick_s_(tick_s), place_(start), lift_to_(start), from_(start) {}

  void begin(const PressRequest& request);
  /// True when it is over the skin again with its result; also before the first press.
  bool done() const { return phase_ == Phase::over; }
  const FeltPress& felt() const { return felt_; }
  /// The goal of the tick that follows this sample. No allocation.
  device::HandGoal next(const trace::Sample& sample) noexcept;

 private:
  enum class Phase : std::uint8_t { travel, down, hold, up, over };

  void enter(Phase phase) noexcept;
  void travel() noexcept;
  void goDown(double force_n) noexcept;
  void hold(double force_n, double depth_mm) noexcept;
  void goUp() noexcept;

  double tick_s_;
  PressRequest request_;
  Phase phase_ = Phase::over;
  double time_s_ = 0.0;  // in the phase
  Vec3 place_;           // goal's place
  Vec3 lift_to_;         // over the current place
  Vec3 from_;            // where the phase began
  FeltPress felt_;
  double force_sum_ = 0.0;
  double depth_sum_ = 0.0;
  int held_ticks_ = 0;
};

}  // namespace palpate::training
