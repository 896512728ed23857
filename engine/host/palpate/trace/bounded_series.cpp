#include "palpate/trace/bounded_series.h"

#include <algorithm>
#include <cmath>

namespace palpate::trace {

void FixedHistogram::add(double value) {
  if (!std::isfinite(value)) return;
  value = std::max(value, 0.0);
  least_ = count_ == 0 ? value : std::min(least_, value);
  greatest_ = std::max(greatest_, value);
  sum_ += value;
  ++count_;
  const double bin = value / bin_width_;
  if (bin < static_cast<double>(kBins)) {
    ++bins_[static_cast<std::size_t>(bin)];
  } else {
    ++beyond_;
  }
}

double FixedHistogram::quantile(double share) const {
  if (count_ == 0) return 0.0;
  const double wanted = share * static_cast<double>(count_);
  double before = 0.0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    const auto here = static_cast<double>(bins_[bin]);
    if (here > 0.0 && before + here >= wanted) {
      const double within = (wanted - before) / here;
      return std::clamp((static_cast<double>(bin) + within) * bin_width_, least_, greatest_);
    }
    before += here;
  }
  return greatest_;
}

void Extremes::add(double value) {
  if (!std::isfinite(value)) return;
  least = count == 0 ? value : std::min(least, value);
  greatest = count == 0 ? value : std::max(greatest, value);
  sum += value;
  ++count;
}

void Extremes::add(const Extremes& other) {
  if (other.count == 0) return;
  least = count == 0 ? other.least : std::min(least, other.least);
  greatest = count == 0 ? other.greatest : std::max(greatest, other.greatest);
  sum += other.sum;
  count += other.count;
}

void SeriesBucket::add(const SeriesBucket& other) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i].add(other.values[i]);
  touching += other.touching;
  ticks += other.ticks;
}

void TickSeries::add(std::uint64_t tick, const MeasuredValues& values, bool touching) {
  if (buckets_.empty()) first_tick_ = tick;
  while ((tick - first_tick_) / ticks_a_bucket_ >= kMaxBuckets) halve();
  const auto number = static_cast<std::size_t>((tick - first_tick_) / ticks_a_bucket_);
  if (number >= buckets_.size()) buckets_.resize(number + 1);
  SeriesBucket& bucket = buckets_[number];
  for (std::size_t i = 0; i < values.size(); ++i) bucket.values[i].add(values[i]);
  bucket.touching += touching ? 1 : 0;
  ++bucket.ticks;
}

void TickSeries::halve() {
  const std::size_t half = (buckets_.size() + 1) / 2;
  for (std::size_t i = 0; i < half; ++i) {
    SeriesBucket joined = buckets_[2 * i];
    if (2 * i + 1 < buckets_.size()) joined.add(buckets_[2 * i + 1]);
    buckets_[i] = joined;
  }
  buckets_.resize(half);
  ticks_a_bucket_ *= 2;
}

}  // namespace palpate::trace
