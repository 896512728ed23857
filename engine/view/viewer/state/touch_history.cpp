#include "view/viewer/state/touch_history.h"

#include <algorithm>

#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

namespace {

TouchHistory::Moment makeEmptyMoment(const trace::Sample& sample) {
  TouchHistory::Moment moment;
  for (std::size_t f = 0; f < kFingers; ++f) {
    moment[f].tick = sample.tick;
    moment[f].finger = static_cast<std::uint32_t>(f);
    moment[f].contact.tip = device::kNowhere;
  }
  return moment;
}

}  // namespace

TouchHistory::TouchHistory(double ticks_per_s, double seconds)
    : tick_s_(1.0 / ticks_per_s), most_(static_cast<std::size_t>(std::max(1.0, ticks_per_s * seconds))) {}

void TouchHistory::clear() {
  moments_.clear();
  first_ = 0;
}

double TouchHistory::momentTime(std::size_t i) const {
  return moments_.empty() ? 0.0 : static_cast<double>(moment(i)[0].tick) * tick_s_;
}

void TouchHistory::add(const trace::Sample& sample) {
  if (sample.finger >= kFingers) return;
  const std::size_t newest = moments_.empty() ? 0 : (first_ + moments_.size() - 1) % moments_.size();
  if (!moments_.empty() && moments_[newest][0].tick == sample.tick) {
    moments_[newest][sample.finger] = sample;
    return;
  }
  Moment moment = makeEmptyMoment(sample);
  moment[sample.finger] = sample;
  if (moments_.size() < most_) {
    moments_.push_back(moment);
  } else {
    moments_[first_] = moment;
    first_ = (first_ + 1) % moments_.size();
  }
}

const TouchHistory::Moment& TouchHistory::at(double time_s) const {
  // Times are sums of ticks: half a tick forgives their rounding.
  const double latest = time_s + 0.5 * tick_s_;
  std::size_t low = 0;
  std::size_t high = moments_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (momentTime(middle) <= latest) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return moment(low == 0 ? 0 : low - 1);
}

}  // namespace palpate::viewer
