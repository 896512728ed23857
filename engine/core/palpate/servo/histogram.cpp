// Bins: values below 2^6 have one each; above, the six bits after the leading one choose among 64 in an octave. That is
// a shift and no logarithm, cheap enough for the tick; percentiles count through all bins.
//
// HdrHistogram (Tene) has bins of this kind.
#include "palpate/servo/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpate::servo {

std::size_t DurationHistogram::binOf(std::uint64_t nanoseconds) {
  if (nanoseconds < (1u << kSubBits)) return nanoseconds;
  const int shift = std::bit_width(nanoseconds) - 1 - kSubBits;
  const std::size_t bin = (static_cast<std::size_t>(shift) << kSubBits) + (nanoseconds >> shift);
  return std::min(bin, kBins - 1);
}

std::uint64_t DurationHistogram::upperEdge(std::size_t bin) {
  const std::size_t sub = std::size_t{1} << kSubBits;
  if (bin < 2 * sub) return bin;
  const auto shift = static_cast<int>(bin >> kSubBits) - 1;
  return ((sub + (bin & (sub - 1)) + 1) << shift) - 1;
}

void DurationHistogram::add(std::int64_t nanoseconds) noexcept {
  const std::uint64_t value = nanoseconds > 0 ? static_cast<std::uint64_t>(nanoseconds) : 0;
  ++bins_[binOf(value)];
  ++count_;
  max_ns_ = std::max(max_ns_, value);
}

double DurationHistogram::percentileUs(double share) const {
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    seen += bins_[bin];
    if (seen >= rank && seen > 0) return static_cast<double>(std::min(upperEdge(bin), max_ns_)) * 1e-3;
  }
  return static_cast<double>(max_ns_) * 1e-3;
}

DurationPercentiles DurationHistogram::percentiles() const {
  if (count_ == 0) return {};
  return {percentileUs(0.50), percentileUs(0.99), percentileUs(0.999), static_cast<double>(max_ns_) * 1e-3};
}

}  // namespace palpate::servo
