// Numbers of a run of any length in memory of fixed size: how often which size, and least, mean and greatest over time.
//
// Pictures of long recordings are drawn from them; recording_statistics.h fills them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpate::trace {

/// Counts values >= 0 in bins of one width; those beyond the last bin are counted together.
class FixedHistogram {
 public:
  static constexpr std::size_t kBins = 8192;

  explicit FixedHistogram(double bin_width) : bin_width_(bin_width), bins_(kBins, 0) {}

  /// Ignores values that are not finite; negative ones count as 0.
  void add(double value);

  std::uint64_t count() const { return count_; }
  double mean() const { return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_); }
  double least() const { return least_; }
  double greatest() const { return greatest_; }
  /// The value that this share of all values does not exceed, off by less than a bin; the greatest where it lies beyond
  /// the bins; 0 of no values.
  double quantile(double share) const;

  double binWidth() const { return bin_width_; }
  std::span<const std::uint64_t> bins() const { return bins_; }
  std::uint64_t beyond() const { return beyond_; }

 private:
  double bin_width_;
  std::vector<std::uint64_t> bins_;
  std::uint64_t beyond_ = 0;
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double least_ = 0.0;
  double greatest_ = 0.0;
};

/// Quantities measured of a finger in every tick.
enum class Measured : std::uint8_t {
  force,        ///< size of the contact's force, N
  depth,        ///< of the tip under the skin, mm
  proxy_speed,  ///< over the skin, mm/s
  tip_speed,    ///< of what the device held, mm/s
};
inline constexpr std::size_t kMeasured = 4;

/// In the order of Measured; NaN: not known in this tick.
using MeasuredValues = std::array<double, kMeasured>;

struct Extremes {
  std::uint64_t count = 0;
  double least = 0.0;
  double greatest = 0.0;
  double sum = 0.0;

  void add(double value);
  void add(const Extremes& other);
  double mean() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

/// Ticks that follow each other; a tick that was not recorded leaves its bucket emptier, so time stays time.
struct SeriesBucket {
  std::array<Extremes, kMeasured> values;
  std::uint64_t touching = 0;  ///< ticks in contact
  std::uint64_t ticks = 0;     ///< that were recorded

  void add(const SeriesBucket& other);
};

/// At most kMaxBuckets of them: when time runs out of the last one, neighbours are joined.
class TickSeries {
 public:
  static constexpr std::size_t kMaxBuckets = 2048;

  /// `tick` is not before the first one.
  void add(std::uint64_t tick, const MeasuredValues& values, bool touching);

  std::uint64_t firstTick() const { return first_tick_; }
  std::uint64_t ticksPerBucket() const { return ticks_a_bucket_; }
  const std::vector<SeriesBucket>& buckets() const { return buckets_; }

 private:
  void halve();

  std::uint64_t first_tick_ = 0;
  std::uint64_t ticks_a_bucket_ = 1;
  std::vector<SeriesBucket> buckets_;
};

}  // namespace palpate::trace
