// What the servo did to the forces of a held finger: counted, and said in a few words while it is going on. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "palpate/servo/limiter.h"

namespace palpate::viewer {

class Interventions {
 public:
  /// One tick's safety bits.
  void add(std::uint32_t safety, double now_s);
  /// "held back 812, damped 3": those of the last two seconds with their ticks in all, the newest of them first; empty
  /// when there was none.
  std::string recent(double now_s) const;
  /// Ticks in which each bit was set.
  const std::array<std::uint64_t, servo::kSafetyBits>& counts() const { return counts_; }

 private:
  std::array<std::uint64_t, servo::kSafetyBits> counts_{};
  std::array<double, servo::kSafetyBits> last_s_{};
};

}  // namespace palpate::viewer
