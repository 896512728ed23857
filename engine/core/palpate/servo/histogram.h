// Percentiles of durations in memory of fixed size, so that a loop can measure itself for days without allocating.
#pragma once

#include <array>
#include <cstdint>

namespace palpate::servo {

struct DurationPercentiles {
  double p50_us = 0.0;
  double p99_us = 0.0;
  double p99_9_us = 0.0;
  double max_us = 0.0;
};

/// Counts durations in bins of equal ratio: 64 to an octave, so a percentile is at most 1.6 % too large. From 1 ns to
/// over four minutes; the largest is kept exactly. One thread.
class DurationHistogram {
 public:
  void add(std::int64_t nanoseconds) noexcept;
  /// Nearest-rank percentiles (upper edge of the bin, never above the maximum); all zero without samples.
  DurationPercentiles percentiles() const;
  std::uint64_t count() const { return count_; }

 private:
  static constexpr int kSubBits = 6;
  static constexpr int kOctaves = 33;
  static constexpr std::size_t kBins = std::size_t{kOctaves} << kSubBits;
  static std::size_t binOf(std::uint64_t nanoseconds);
  static std::uint64_t upperEdge(std::size_t bin);
  double percentileUs(double share) const;

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::uint64_t max_ns_ = 0;
};

}  // namespace palpate::servo
