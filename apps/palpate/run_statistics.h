// What a run was like, collected sample by sample: how hard and how deep each finger pressed, how it stuck and slipped.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/hash.h"
#include "palpate/trace/sample.h"

namespace palpate::app {

/// Of one finger. Means are over the ticks in contact.
struct FingerStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t touching = 0;
  std::uint64_t sticking = 0;
  std::uint64_t slipping = 0;
  std::uint64_t limited = 0;  ///< touching ticks in which the device got less, or later, than the contact's force
  double peak_force_n = 0.0;
  double sum_force_n = 0.0;
  double peak_device_force_n = 0.0;
  double peak_depth_mm = 0.0;
  double sum_depth_mm = 0.0;
  std::size_t triangles = 0;  ///< different ones under the proxy

  double meanForceN() const { return touching == 0 ? 0.0 : sum_force_n / static_cast<double>(touching); }
  double meanDepthMm() const { return touching == 0 ? 0.0 : sum_depth_mm / static_cast<double>(touching); }
};

class RunStatistics {
 public:
  RunStatistics(std::size_t fingers, std::size_t triangles);
  void add(const trace::Sample& sample);

  const std::vector<FingerStatistics>& fingers() const { return fingers_; }
  /// Names the run: equal for two runs with the same contact forces in every tick.
  std::uint64_t hash() const { return hash_.value(); }
  bool anyTouch() const;

 private:
  std::vector<FingerStatistics> fingers_;
  std::vector<std::vector<bool>> visited_;  ///< a finger each, a triangle each
  Hash hash_;
};

}  // namespace palpate::app
