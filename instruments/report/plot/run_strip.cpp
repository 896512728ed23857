// A step has one tick at first; whenever the strip is full, neighbours are joined and steps become twice as long.
#include "report/plot/run_strip.h"

#include <algorithm>

namespace palpate::app {

namespace {

/// Twice as many as a picture of common width has columns.
constexpr std::size_t kMaxSteps = 2048;

FeltTick makeFeltTick(const Vec3& force, const Vec3& device, double depth_mm, const Vec3& anchor, const Vec3& tip) {
  return {.values = {force.norm(), device.norm(), depth_mm, (anchor - tip).norm(), 0.0}, .tip = tip};
}

StripStep toStripStep(const FeltTick& tick) {
  return {.from_s = tick.time_s,
          .to_s = tick.time_s,
          .least = tick.values,
          .greatest = tick.values,
          .sticks = tick.touch == contact::Touch::stick,
          .slips = tick.touch == contact::Touch::slip,
          .contact_status = tick.contact_status,
          .safety_status = tick.safety_status};
}

void join(StripStep& step, const StripStep& next) {
  step.to_s = next.to_s;
  for (std::size_t i = 0; i < kFelts; ++i) {
    step.least[i] = std::min(step.least[i], next.least[i]);
    step.greatest[i] = std::max(step.greatest[i], next.greatest[i]);
  }
  step.sticks = step.sticks || next.sticks;
  step.slips = step.slips || next.slips;
  step.contact_status |= next.contact_status;
  step.safety_status |= next.safety_status;
}

}  // namespace

FeltTick feltIn(const trace::ForcesRow& row) {
  FeltTick tick = makeFeltTick(row.force, row.device_force, row.depth_mm, row.anchor, row.tip);
  tick.time_s = row.time_s;
  tick.touch = row.touch;
  tick.contact_status = row.contact_status;
  tick.safety_status = row.safety_status;
  return tick;
}

void RunStrip::add(FeltTick tick) {
  if (knows_last_ && tick.time_s > last_s_) {
    tick.values[static_cast<std::size_t>(Felt::speed)] = (tick.tip - last_tip_).norm() / (tick.time_s - last_s_);
  }
  knows_last_ = true;
  last_s_ = tick.time_s;
  last_tip_ = tick.tip;
  if (in_last_ < ticks_a_step_ && !steps_.empty()) {
    join(steps_.back(), toStripStep(tick));
    ++in_last_;
    return;
  }
  if (steps_.size() == kMaxSteps) halve();
  steps_.push_back(toStripStep(tick));
  in_last_ = 1;
}

void RunStrip::halve() {
  for (std::size_t i = 0; i < kMaxSteps / 2; ++i) {
    steps_[i] = steps_[2 * i];
    join(steps_[i], steps_[2 * i + 1]);
  }
  steps_.resize(kMaxSteps / 2);
  ticks_a_step_ *= 2;
}

}  // namespace palpate::app
