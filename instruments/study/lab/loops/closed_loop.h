// The servo's own tick on a flat plate, closed over a simulated hand: what tests and studies of stability run.
//
//   SimulatedHand ─ tip ─► servo::runTick [ contact, limiter ] ─ force ─► SimulatedHand
//
// The plate lies in z = 0 and is felt from above. Its stiffness may grow along x: a map.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "palpate/device/simulated_hand.h"
#include "palpate/servo/device_limits.h"
#include "palpate/servo/tick.h"

namespace palpate::lab {

/// Active part of the limiter.
enum class Protection : std::uint8_t {
  none,        ///< the bare force, clamped to what the device takes
  assumed,     ///< damping and friction of the device assumed, the delay uncertain by a tick
  identified,  ///< both measured, the delay uncertain by half a tick
};

/// Limits that leave the stiffness as it is: the request is rendered.
servo::LimiterSettings loopLimiterSettings(const device::DeviceProfile& device, double tick_s, double delay_ticks,
                                           Protection protection);

struct PlateSettings {
  double stiffness_n_per_mm = 1.0;
  /// A map: the stiffness goes to this one between x = 0 and x = blend_mm. 0: one stiffness everywhere.
  double other_n_per_mm = 0.0;
  double blend_mm = 10.0;
  double friction = 0.0;  ///< coefficient
  tissue::ForceLaw law;
  std::shared_ptr<const contact::Lumps> lumps = nullptr;  ///< under it; null: none
};

contact::Surface plateSurface(const PlateSettings& settings);

struct LoopSettings {
  device::SimulatedHandSettings hand;
  servo::LimiterSettings limits;
  PlateSettings plate;
  std::vector<Vec3> more_hands = {};  ///< where further devices and hands start, alike but for their jitter
};

class ClosedLoop {
 public:
  explicit ClosedLoop(const LoopSettings& settings);

  device::SimulatedHand& hand(std::size_t finger = 0) { return *hands_[finger]; }
  /// Moves the first contact to where its device is, which may be inside, and forgets how: as if it had rested there.
  void settleContact();
  const trace::Sample& tick();
  std::span<const trace::Sample> samples() const { return samples_; }  ///< last tick, one per finger
  servo::Rig& rig() { return rig_; }
  const contact::Surface& surface() const { return *surface_; }
  const servo::LimiterState& limiter() const { return rig_.fingers.front().limiter; }
  double tickS() const { return rig_.tick_s; }

 private:
  std::unique_ptr<contact::Surface> surface_;
  std::vector<std::unique_ptr<device::SimulatedHand>> hands_;
  servo::Rig rig_;
  std::vector<trace::Sample> samples_;
  std::uint64_t next_ = 0;
};

}  // namespace palpate::lab
