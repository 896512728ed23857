// The output of one finger over a run of any length, in a few thousand steps: least and greatest of each, so that a
// spike of one tick stays visible.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/words.h"
#include "palpate/trace/forces_table.h"

namespace palpate::app {

/// Quantities that can be drawn over time.
enum class Felt : std::uint8_t {
  force,   ///< size of the contact's force, N
  device,  ///< size of the force after the safety limits, N
  depth,   ///< along the normal, mm
  lag,     ///< |anchor - tip|: how far the skin that friction holds is from the tip, mm
  speed,   ///< speed of the tip, mm/s
};
inline constexpr std::size_t kFelts = 5;

/// One finger in one tick.
struct FeltTick {
  double time_s = 0.0;
  std::array<double, kFelts> values{};  ///< in the order of Felt; speed is filled in by the strip
  Vec3 tip = Vec3::Zero();
  contact::Touch touch = contact::Touch::free;
  std::uint32_t contact_status = 0;
  std::uint32_t safety_status = 0;
};

FeltTick feltIn(const trace::ForcesRow& row);

/// Some ticks that follow each other.
struct StripStep {
  double from_s = 0.0;
  double to_s = 0.0;
  std::array<double, kFelts> least{};
  std::array<double, kFelts> greatest{};
  bool sticks = false;  ///< in one tick of it at least
  bool slips = false;
  std::uint32_t contact_status = 0;  ///< all bits that were set
  std::uint32_t safety_status = 0;
};

class RunStrip {
 public:
  explicit RunStrip(std::string finger) : finger_(std::move(finger)) {}

  /// Add ticks in the order of time. When the strip is full two steps become one, so its memory is bounded.
  void add(FeltTick tick);

  const std::string& finger() const { return finger_; }
  const std::vector<StripStep>& steps() const { return steps_; }
  std::size_t ticksPerStep() const { return ticks_a_step_; }

 private:
  void halve();

  std::string finger_;
  std::vector<StripStep> steps_;
  std::size_t ticks_a_step_ = 1;
  std::size_t in_last_ = 0;  // ticks in the last step
  bool knows_last_ = false;
  double last_s_ = 0.0;
  Vec3 last_tip_ = Vec3::Zero();
};

}  // namespace palpate::app

namespace palpate {

template <>
struct WordsOf<app::Felt> {
  using V = app::Felt;
  static constexpr std::array kAll = {Word{"force", V::force}, Word{"device", V::device}, Word{"depth", V::depth},
                                      Word{"lag", V::lag}, Word{"speed", V::speed}};
};

}  // namespace palpate
