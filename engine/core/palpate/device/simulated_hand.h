// A force-feedback device with a hand on it, as mechanics: it closes the loop in software, so that kicks, buzzing and
// their remedies can be measured and tested without hardware.
//
//   servo tick: read_tip ─► quantised place of the device ─► contact, limiter ─► write_force
//                                                                                   │ delay, amplifier, saturation
//   hand's goal ─ arm spring ─► hand ─ grip spring ─► device ◄───────────────────────┘
//
// Device and hand are two bodies, in three dimensions, integrated by semi-implicit Euler; its half-step lead hides that
// part of the hold's delay, so a tick has at least 40 steps. Deterministic: the same calls give the same bits.
// Limits: no structural resonance, no gravity, no cable friction, no reflexes (docs/explanation/safety.md).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "palpate/base/random.h"
#include "palpate/base/vec.h"
#include "palpate/base/words.h"
#include "palpate/device/device.h"
#include "palpate/device/device_profile.h"

namespace palpate::device {

enum class HandKind : std::uint8_t {
  stylus_x,   ///< a pen held between fingers, pushed left and right
  stylus_y,   ///< up and down
  stylus_z,   ///< fore and aft: stiff, with little damping in the grip; the hardest to keep at rest
  thimble,    ///< one finger in a thimble
  arm,        ///< a whole arm holding the device rigidly
  dead_load,  ///< no hand: a constant push, the worst of all
  released,   ///< no hand: the device alone
};

/// One hand, the same in all directions. No mass: a dead load.
struct HandModel {
  double mass_kg = 0.0;
  double stiffness_n_per_mm = 0.0;  ///< arm: from the goal to the hand
  double damping_n_s_per_mm = 0.0;
  double grip_n_per_mm = 0.0;  ///< from the hand to the device; 0: rigid
  double grip_damping_n_s_per_mm = 0.0;
};

HandModel handModel(HandKind kind);

struct SimulatedHandSettings {
  DeviceProfile device;
  HandModel hand;
  double tick_s = 0.001;
  int steps_per_tick = 40;
  double delay_ticks = 1.0;      ///< from sampling the pose to the force at the motor
  double amplifier_lag_s = 0.0;  ///< first order
  double jitter_ticks = 0.0;     ///< samples come up to this much early or late
  double force_step_n = 0.0;     ///< step of the motor's command; 0: none
  bool quantised = true;         ///< the encoder's step is seen
  /// False: each axis has its own Coulomb friction, as each motor has. True: one for all, so that sliding along the
  /// surface removes the friction across it; harder to keep at rest.
  bool shared_friction = false;
  std::uint64_t seed = 1;
  Vec3 start = Vec3::Zero();  ///< mm
};

/// The hand's goal in a tick.
struct HandGoal {
  Vec3 place = Vec3::Zero();     ///< where the arm is drawn to, mm; no hand: without meaning
  Vec3 velocity = Vec3::Zero();  ///< its velocity, mm/s
  Vec3 push = Vec3::Zero();      ///< on the device, N: a dead load, or a kick
};

/// Energy flows since the start, N mm (mJ). A motion that it starts with counts as the hand's gift.
struct PortEnergy {
  double motor = 0.0;     ///< work of the motor on the device
  double friction = 0.0;  ///< swallowed by the device's own friction and damping
  double kinetic = 0.0;   ///< the device's mass, now
  /// Net energy that the device gave to its holder: above zero, the loop is a source.
  double given() const { return motor - friction - kinetic; }
};

class SimulatedHand {
 public:
  explicit SimulatedHand(const SimulatedHandSettings& settings);

  /// Starts device and hand at this velocity, mm/s.
  void setVelocity(const Vec3& velocity);

  HandGoal goal;  ///< read by the next tick

  /// The device's own reading: quantised.
  Vec3 readTip() noexcept;
  /// Takes the force of this tick and lets the time pass until the next one. No allocation.
  void writeForce(const Vec3& force) noexcept;

  const Vec3& place() const noexcept { return device_.place; }
  const Vec3& velocity() const noexcept { return device_.velocity; }
  const Vec3& motorForce() const noexcept { return motor_; }
  PortEnergy energy() const noexcept;

 private:
  struct Body {
    Vec3 place = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
  };
  struct Command {
    std::int64_t from_step = 0;
    Vec3 force = Vec3::Zero();
  };
  static constexpr std::size_t kCommands = 16;

  void step() noexcept;
  Vec3 commandNow() noexcept;
  Vec3 onDevice() noexcept;
  Vec3 slowed(const Vec3& velocity) noexcept;

  SimulatedHandSettings settings_;
  double step_s_ = 0.0;
  double device_mass_ = 0.0;  // N s^2/mm; of both bodies where the grip is rigid
  double hand_mass_ = 0.0;
  Body device_;
  Body hand_;
  Vec3 motor_ = Vec3::Zero();
  std::array<Command, kCommands> commands_{};  // ring, ordered by from_step
  std::size_t newest_ = 0;
  std::size_t at_work_ = 0;
  std::int64_t step_ = 0;
  std::int64_t shift_ = 0;  // jitter of the current tick, in steps
  Random random_;
  double motor_work_ = 0.0;
  double friction_work_ = 0.0;
};

/// The hand must outlive the device.
Device simulatedHandDevice(std::string name, SimulatedHand& hand);

}  // namespace palpate::device

template <>
struct palpate::WordsOf<palpate::device::HandKind> {
  using V = palpate::device::HandKind;
  static constexpr std::array kAll = {Word{"stylus_x", V::stylus_x}, Word{"stylus_y", V::stylus_y},
                                      Word{"stylus_z", V::stylus_z}, Word{"thimble", V::thimble},
                                      Word{"arm", V::arm},           Word{"dead_load", V::dead_load},
                                      Word{"released", V::released}};
};
