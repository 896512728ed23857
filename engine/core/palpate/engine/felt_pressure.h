// The pressure under a fingertip for programs that have a finger's output: bindings, exports, servers.
//
//   World ─► FeltPressure (its patterns, made once) ─ FingerOutput, tick ─► taxels, kPa (contact/pressure_field.h)
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "palpate/contact/pressure_field.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

/// False for a pad that no scene may have: taxels or size out of range.
bool isPad(const contact::PressurePad& pad) noexcept;
/// Throws Error naming the fault.
void checkPad(const contact::PressurePad& pad);

/// Pressures in one world. Immutable; any number of threads.
class FeltPressure {
 public:
  /// Some milliseconds in a world that has neither lumps nor a pad. Throws Error where the tissue has no field.
  explicit FeltPressure(std::shared_ptr<const scene::World> world);

  /// contact::pressureField of a finger's output in this tick of its clock, which counts on a body that breathes only:
  /// there it is taken to rest first. The pad is one that checkPad lets pass. No allocation.
  contact::PadSums at(const contact::FingerOutput& felt, std::uint64_t tick, const contact::PressurePad& pad,
                      std::span<double> kpa, std::span<Vec2> shear_kpa = {}) const noexcept;

  const std::shared_ptr<const scene::World>& world() const noexcept { return world_; }

 private:
  std::shared_ptr<const scene::World> world_;
  std::shared_ptr<const contact::PressureGround> ground_;
};

}  // namespace palpate::engine
