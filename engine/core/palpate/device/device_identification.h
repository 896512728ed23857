// Measures mass, damping, friction and delay of a device on itself: released, it swings on a soft virtual spring whose
// rest place jumps to and fro.
//
//   tip ─► Swings::tick ─► force (a spring of at most 0.2 N/mm, a few tenths of a newton)     every tick, any device
//             └─ SwingRecord: the place and the force of every tick ─► identify ─► mass, damping, friction, delay
//
// Damping and delay look alike in a running swing and differ in how it begins: the response to a jump of the force
// comes only after the delay. docs/reference/devices.md has the accuracy on simulated devices.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/device/device.h"

namespace palpate::device {

struct SwingPlan {
  double tick_s = 0.001;
  double first_force_n = 0.1;  ///< force of the spring's jumps; grows until the device swings freely ...
  double most_force_n = 0.5;   ///< ... to this
  double reach_mm = 25.0;      ///< size of a jump
  int swings = 12;             ///< free ones
};

/// At most a fifth of the device's largest force and 2 N; 0.5 N if that is unknown.
SwingPlan swingPlan(const Capabilities& able, double tick_s);

/// Commanded forces and observed places along one axis.
struct SwingRecord {
  double tick_s = 0.001;
  std::vector<double> place_mm;         ///< one per tick
  std::vector<double> force_n;          ///< sent in that tick
  std::vector<std::size_t> jumps = {};  ///< ticks in which the spring began to pull, each from rest
};

/// Swings a device along x around the place where it is first seen. After its end, and after anything that should not
/// be, the force is zero.
class Swings {
 public:
  explicit Swings(const SwingPlan& plan);

  /// The force of this tick, N; ticks count from 0, and one or two may be left out. No allocation.
  Vec3 tick(std::uint64_t tick, const Vec3& tip) noexcept;

  bool finished() const noexcept { return finished_; }
  /// Share of the planned swings that are done, 0 to 1.
  double progress() const noexcept { return static_cast<double>(swung_) / plan_.swings; }
  /// The reason why it ended early; null: it did not.
  const char* trouble() const noexcept { return trouble_; }
  const SwingRecord& record() const noexcept { return record_; }

 private:
  const char* refusal(std::uint64_t tick, const Vec3& tip) const noexcept;
  void fillGap(std::uint64_t tick, double place) noexcept;
  void watchRest(double place) noexcept;
  void beginSwing(double place) noexcept;
  void endSwing() noexcept;
  double springForce(double place) const noexcept;
  Vec3 stop(const char* why) noexcept;

  SwingPlan plan_;
  SwingRecord record_;
  Vec3 start_ = Vec3::Zero();
  bool swinging_ = false;
  bool finished_ = false;
  const char* trouble_ = nullptr;
  int swung_ = 0;
  double force_n_ = 0.0;  // when the rest place jumps
  double rest_place_ = 0.0;
  double from_ = 0.0;       // where this swing began ...
  double travelled_ = 0.0;  // ... and how far it got
  double still_place_ = 0.0;
  std::size_t still_ticks_ = 0;
  std::size_t phase_ticks_ = 0;  // since this swing, or this rest, began
};

struct DeviceIdentification {
  double mass_kg = 0.0;
  double damping_n_s_per_mm = 0.0;
  double friction_n = 0.0;   ///< Coulomb's
  double bias_n = 0.0;       ///< a constant push along the axis: a device that is not in balance
  double delay_ticks = 0.0;  ///< from sampling a place to the effect of its force, amplifier included
  double residual_mm = 0.0;  ///< rms of what the fit leaves
  std::size_t swings = 0;    ///< half swings that were used
};

/// Throws Error where nothing swung, and where no mass fits.
DeviceIdentification identify(const SwingRecord& record);

}  // namespace palpate::device
