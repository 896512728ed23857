#include "cli/devices/devices_report.h"

#include "cli/kit/interruption.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/back_ends.h"
#include "palpate/servo/pacing.h"

namespace palpate::app {

namespace {

constexpr double kLookS = 50e-6;
constexpr std::uint64_t kLooksPerReport = 2000;

/// A device that answers at once has a position at every call, which the servo makes once a tick.
double lookS(const device::Capabilities& able) {
  const bool at_once = able.rhythm == device::Rhythm::on_call;
  return at_once ? device::OpenOptions{}.tick_s : kLookS;
}

}  // namespace

DeviceMeasurement measureDevice(const device::Device& device, double seconds, const Progress& progress) {
  DeviceMeasurement measured;
  servo::DurationHistogram intervals;
  servo::DurationHistogram delays;
  std::uint64_t looks = 0;
  std::uint64_t with_position = 0;
  std::uint64_t positions = 0;
  std::int64_t newest_ns = 0;
  servo::PacingSettings pacing;
  const double look_s = lookS(device.capabilities);
  pacing.period_s = look_s;
  pacing.spin_s = 0.0;  // the driver's thread may need this core
  servo::Pacer pacer(pacing);
  const auto started = Clock::now();
  while (secondsSince(started) < seconds && endingSignal() == 0) {
    const Vec3 tip = device.read_tip(pacer.waitForNext().tick);
    const device::DeviceState state = device.state ? device.state() : device::DeviceState{};
    device.write_force(Vec3::Zero());
    ++looks;
    with_position += tip.allFinite() || state.faults == device::kStalePose ? 1 : 0;
    if (looks % kLooksPerReport == 0) report(progress, "measuring " + device.name, secondsSince(started) / seconds);
    if (state.age_ticks != 0) continue;
    const std::int64_t now_ns = monotonicNs();
    if (newest_ns != 0) intervals.add(now_ns - newest_ns);
    if (state.loop_ticks != 0)
      delays.add(static_cast<std::int64_t>(static_cast<double>(state.loop_ticks) * look_s * 1e9));
    newest_ns = now_ns;
    ++positions;
  }
  measured.seconds = secondsSince(started);
  measured.positions_per_s = static_cast<double>(positions) / measured.seconds;
  measured.interval = intervals.percentiles();
  measured.delay = delays.percentiles();
  measured.with_position_share = looks == 0 ? 0.0 : static_cast<double>(with_position) / static_cast<double>(looks);
  if (device.explain) measured.trouble = device.explain();
  return measured;
}

}  // namespace palpate::app
