// A press leaves a trace where its anchor is, and another each half radius it slides; a trace fades with the square of
// the time left until the skin has refilled.
#include "palpate/view/layers/skin_paint.h"

#include <algorithm>

namespace palpate::view {

namespace {

/// Blood is gone at this depth.
constexpr double kFullyPaleMm = 4.0;
/// A sliding finger leaves a mark behind each time it has gone this share of its radius.
constexpr double kSpacing = 0.5;

PressMark makePressMark(const Press& press) {
  return {press.anchor.cast<float>(), static_cast<float>(press.radius_mm),
          static_cast<float>(std::min(1.0, press.depth_mm / kFullyPaleMm))};
}

}  // namespace

std::span<const PressMark> Blanching::at(double time_s, std::span<const Press> presses) {
  if (time_s < time_s_) traces_.clear();
  time_s_ = time_s;
  for (const Press& p : presses) press(p, time_s);
  std::erase_if(traces_, [&](const Trace& trace) { return time_s - trace.last_pressed_s >= kRefillS; });
  marks_.clear();
  for (const Press& p : presses) {
    if (p.depth_mm > 0.0) marks_.push_back(makePressMark(p));
  }
  for (const Trace& trace : traces_) {
    const double refilled = (time_s - trace.last_pressed_s) / kRefillS;
    marks_.push_back(trace.mark);
    marks_.back().strength *= static_cast<float>((1.0 - refilled) * (1.0 - refilled));
  }
  std::stable_sort(marks_.begin(), marks_.end(), [](const auto& a, const auto& b) { return a.strength > b.strength; });
  if (marks_.size() > kMaxMarks) marks_.resize(kMaxMarks);
  return marks_;
}

void Blanching::press(const Press& press, double time_s) {
  if (!(press.depth_mm > 0.0)) return;
  const PressMark mark = makePressMark(press);
  const auto near = std::find_if(traces_.begin(), traces_.end(), [&](const Trace& trace) {
    return (trace.mark.place - mark.place).norm() < kSpacing * press.radius_mm;
  });
  if (near == traces_.end()) {
    traces_.push_back({mark, time_s});
  } else {
    near->mark.strength = mark.strength;
    near->last_pressed_s = time_s;
  }
}

}  // namespace palpate::view
