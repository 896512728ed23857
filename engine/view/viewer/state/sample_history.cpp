#include "view/viewer/state/sample_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/servo/limiter.h"

namespace palpate::viewer {

namespace {

/// The speed shown is smoothed over this time: single ticks of a 60 Hz mouse would only show its rate.
constexpr double kSpeedSmoothingS = 0.03;
/// No hand is faster, mm/s: the finger was put elsewhere.
constexpr double kJumpMmPerS = 5000.0;
/// Slower than this the anchor only settles, mm/s.
constexpr double kSlipMmPerS = 0.5;
/// The limiter's effects on a force; the ramp after a start is left out.
constexpr std::uint32_t kLimiting =
    servo::kForceNotFinite | servo::kDamped | servo::kClamped | servo::kForceJumped | servo::kSoftened;

}  // namespace

SampleHistory::SampleHistory(double ticks_per_s, double seconds)
    : samples_(static_cast<std::size_t>(std::max(1.0, ticks_per_s * seconds))), tick_s_(1.0 / ticks_per_s) {}

void SampleHistory::clear() {
  first_ = count_ = 0;
  speed_ = 0.0f;
}

void SampleHistory::add(const trace::Sample& sample, double device_limit_n) {
  const double elapsed = std::max<double>(1.0, static_cast<double>(sample.tick - last_tick_)) * tick_s_;
  const double moved = count_ == 0 ? 0.0 : (sample.contact.tip - last_tip_).norm();
  const double speed = moved < kJumpMmPerS * elapsed ? moved / elapsed : 0.0;  // not for NaN either
  // A finger at rest at the limit of friction is called slipping too; marks show that the skin gets away.
  const bool gets_away = count_ > 0 && (sample.contact.hold - last_hold_).norm() > kSlipMmPerS * elapsed;
  const double share = 1.0 - std::exp(-elapsed / kSpeedSmoothingS);
  speed_ += static_cast<float>(share * (speed - speed_));
  last_tip_ = sample.contact.tip;
  last_hold_ = sample.contact.hold;
  last_tick_ = sample.tick;

  const Vec3& force = sample.contact.force;
  const double normal = force.dot(sample.contact.normal);
  PlotSample plot;
  plot.time_s = static_cast<double>(sample.tick) * tick_s_;
  plot.force_n = static_cast<float>(force.norm());
  plot.normal_n = static_cast<float>(normal);
  plot.tangential_n = static_cast<float>((force - normal * sample.contact.normal).norm());
  plot.depth_mm = static_cast<float>(sample.contact.depth_mm);
  plot.speed_mm_per_s = speed_;
  plot.touching = sample.contact.touch != contact::Touch::free;
  plot.slipping = sample.contact.touch == contact::Touch::slip && gets_away;
  plot.limited = plot.touching && (force.norm() > device_limit_n || (sample.safety & kLimiting) != 0);

  if (count_ == samples_.size()) {
    samples_[first_] = plot;
    first_ = (first_ + 1) % samples_.size();
  } else {
    samples_[(first_ + count_++) % samples_.size()] = plot;
  }
}

float valueOf(const PlotSample& sample, PlotValue value) {
  switch (value) {
    case PlotValue::force:
      return sample.force_n;
    case PlotValue::normal_force:
      return sample.normal_n;
    case PlotValue::tangential_force:
      return sample.tangential_n;
    case PlotValue::depth:
      return sample.depth_mm;
    case PlotValue::speed:
      return sample.speed_mm_per_s;
  }
  return 0.0f;
}

std::size_t SampleHistory::firstAfter(double time_s) const {
  std::size_t low = 0;
  std::size_t high = count_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (at(middle).time_s <= time_s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

template <class Visit>
void SampleHistory::forEachIn(double end_s, double window_s, std::size_t columns, const Visit& visit) const {
  if (columns == 0) return;
  const double start_s = end_s - window_s;
  for (std::size_t i = firstAfter(start_s); i < count_ && at(i).time_s <= end_s; ++i) {
    const double share = (at(i).time_s - start_s) / window_s;
    visit(std::min(columns - 1, static_cast<std::size_t>(share * static_cast<double>(columns))), at(i));
  }
}

std::vector<Extent> SampleHistory::columns(PlotValue value, double end_s, double window_s, std::size_t columns) const {
  std::vector<Extent> extents(columns);
  forEachIn(end_s, window_s, columns, [&](std::size_t column, const PlotSample& sample) {
    Extent& extent = extents[column];
    const float v = valueOf(sample, value);
    extent = extent.any ? Extent{std::min(extent.low, v), std::max(extent.high, v), true} : Extent{v, v, true};
  });
  return extents;
}

std::vector<ColumnMarks> SampleHistory::marks(double end_s, double window_s, std::size_t columns) const {
  std::vector<ColumnMarks> marks(columns);
  forEachIn(end_s, window_s, columns, [&](std::size_t column, const PlotSample& sample) {
    marks[column].touching |= sample.touching;
    marks[column].slipping |= sample.slipping;
    marks[column].limited |= sample.limited;
  });
  return marks;
}

const PlotSample* SampleHistory::near(double time_s) const {
  if (count_ == 0) return nullptr;
  const std::size_t after = firstAfter(time_s);
  if (after == 0) return &at(0);
  if (after == count_) return &at(count_ - 1);
  return time_s - at(after - 1).time_s < at(after).time_s - time_s ? &at(after - 1) : &at(after);
}

double axisEnd(double value, double least) {
  double end = least;
  while (end < value && end < 1e12) {
    const double decade = std::pow(10.0, std::floor(std::log10(end) + 1e-9));
    const double digit = std::round(end / decade);
    end = digit < 2.0 ? 2.0 * decade : digit < 5.0 ? 5.0 * decade : 10.0 * decade;
  }
  return end;
}

std::string historyAsCsv(std::span<const SampleHistory> fingers, double end_s, double window_s) {
  std::string text = "t_s";
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    text += fmt::format(",normal_{0}_n,tangential_{0}_n,depth_{0}_mm,speed_{0}_mm_per_s,force_{0}_n", f + 1);
  }
  text += '\n';
  if (fingers.empty()) return text;
  const SampleHistory& clock = fingers.front();
  for (std::size_t i = 0; i < clock.size(); ++i) {
    const double t = clock.at(i).time_s;
    if (t <= end_s - window_s || t > end_s) continue;
    text += fmt::format("{:.3f}", t);
    for (const SampleHistory& finger : fingers) {
      const PlotSample* s = finger.near(t);
      if (s == nullptr) {
        text += ",,,,,";
      } else {
        text += fmt::format(",{:.4f},{:.4f},{:.4f},{:.2f},{:.4f}", s->normal_n, s->tangential_n, s->depth_mm,
                            s->speed_mm_per_s, s->force_n);
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace palpate::viewer
