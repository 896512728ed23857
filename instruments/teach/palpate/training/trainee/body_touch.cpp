#include "palpate/training/trainee/body_touch.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/scene/words.h"
#include "palpate/servo/device_limits.h"

namespace palpate::training {

namespace {

/// The hand begins so far over the first site, mm: outside, as the limiter wants it.
constexpr double kStartOverSkinMm = 60.0;
/// Slope of the skin is taken over this to both sides, mm: the width of a fingertip, not of a facet.
constexpr double kSlopeMm = 6.0;

std::string formatIsoUtc(std::int64_t ms) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", fmt::gmtime(static_cast<std::time_t>(ms / 1000)));
}

device::SimulatedHandSettings handSettings(const device::HandChoice& choice, double tick_s, const Vec3& start) {
  return {.device = device::profileOf(choice.device),
          .hand = device::handModel(choice.hand),
          .tick_s = tick_s,
          .delay_ticks = device::kHandDelayTicks,
          .start = start};
}

device::Device handDevice(const device::HandChoice& choice, const device::SimulatedHandSettings& settings,
                          device::SimulatedHand& hand) {
  device::Device device = device::simulatedHandDevice("hand", hand);
  device.capabilities.takes_force = true;
  device.capabilities.max_force_n = settings.device.force_n;
  device.capabilities.nominal_stiffness_n_per_mm = settings.device.stiffness_n_per_mm;
  device.capabilities.rate_hz = 1.0 / settings.tick_s;
  device.capabilities.delay_ticks = device::kHandDelayTicks;
  device.capabilities.kind = choice.device;
  device.capabilities.model = describeDevice(choice);
  return device;
}

}  // namespace

std::string describeDevice(const device::HandChoice& hand) {
  return fmt::format("simulated {} on {}", wordFor(hand.hand), wordFor(hand.device));
}

BodyTouch::BodyTouch(TrialWorlds worlds, const SiteSet& sites, const BodyTouchSettings& settings)
    : worlds_(std::move(worlds)), world_(worlds_.even()), profile_(device::profileOf(settings.hand.device)) {
  if (settings.hand.hand == device::HandKind::dead_load || settings.hand.hand == device::HandKind::released) {
    throw Error(
        fmt::format("trainee: hand '{}' does not move; use thimble, arm or stylus_z", wordFor(settings.hand.hand)));
  }
  const double tick_s = 1.0 / world_->scene.ticks_per_s;
  const PressRequest first = requestAt(sites.sites.front().place_mm, {});
  const Vec3 start = first.skin + (kStartOverSkinMm + first.pad_mm) * first.normal;
  const device::SimulatedHandSettings hand = handSettings(settings.hand, tick_s, start);
  hand_ = std::make_unique<device::SimulatedHand>(hand);
  finger_.emplace(start, tick_s);
  servo::RigParts parts;
  parts.tick_s = tick_s;
  parts.limiter = limiterSettingsFor(*world_);
  parts.fingers = engine::fingerSettings(world_->scene, 1);
  engine::checkFingers(*world_, parts.fingers);
  parts.solvers = servo::makeSolvers(world_->surface, world_->hdb, 1, world_->breath);
  parts.devices.push_back(handDevice(settings.hand, hand, *hand_));
  rig_ = servo::rigOf(std::move(parts));
  if (!settings.recording.empty()) begin(settings);
}

BodyTouch::~BodyTouch() = default;

void BodyTouch::begin(const BodyTouchSettings& settings) {
  trace::RecordingHeader header = engine::recordingHeader(world_->scene.ticks_per_s);
  header.started_utc = formatIsoUtc(settings.start_ms);
  header.notes = settings.notes;
  header.tags = "training simulated";
  recording_.emplace(
      settings.recording, header,
      std::vector<trace::RecordingFinger>{engine::recordingFinger("index", rig_.fingers.front().device)});
  recording_->add(engine::recordingWorld(*world_, engine::feltWith(rig_)));
}

servo::LimiterSettings BodyTouch::limiterSettingsFor(const scene::World& world) const {
  return servo::limiterSettings(world, profile_);
}

void BodyTouch::exchangeWorld(std::shared_ptr<const scene::World> next) {
  servo::FingerChain& finger = rig_.fingers.front();
  servo::FingerSolvers solvers = servo::makeSolvers(next->surface, next->hdb, 1, next->breath);
  servo::exchange(finger.solver, solvers.front(), finger.contact);
  finger.limiter_settings = limiterSettingsFor(*next);
  world_ = std::move(next);
  ++rig_.world;
  if (recording_) recording_->add(engine::recordingWorld(*world_, engine::feltWith(rig_)));
}

std::optional<double> BodyTouch::heightAt(const Vec2& place) const {
  const tree::TriangleTree& tree = world_->surface.geometry->tree;
  const double far = 2.0 * tree.diagonal + tree.center.norm();
  const auto hit = tree::firstFrontCrossing(tree, Vec3(place.x(), place.y(), far), Vec3(place.x(), place.y(), -far));
  if (hit.triangle == kNoIndex) return std::nullopt;
  return hit.point.z();
}

PressRequest BodyTouch::requestAt(const Vec2& place, const MeantPress& meant) const {
  const auto height = heightAt(place);
  if (!height) throw Error(fmt::format("trainee: there is no skin at ({:.1f}, {:.1f}) mm", place.x(), place.y()));
  const auto at = [&](double dx, double dy) { return heightAt(place + Vec2(dx, dy)).value_or(*height); };
  const double slope_x = (at(kSlopeMm, 0) - at(-kSlopeMm, 0)) / (2.0 * kSlopeMm);
  const double slope_y = (at(0, kSlopeMm) - at(0, -kSlopeMm)) / (2.0 * kSlopeMm);
  return {.skin = Vec3(place.x(), place.y(), *height),
          .normal = Vec3(-slope_x, -slope_y, 1.0).normalized(),
          .pad_mm = engine::fingerSettings(world_->scene, 1).front().radius_mm,
          .force_n = meant.force_n,
          .hold_s = meant.hold_s};
}

void BodyTouch::runTick(const EachTick& each_tick) {
  hand_->goal = finger_->next(samples_.front());
  servo::runTick(rig_, next_, servo::LoopEvent::none, samples_);
  ++next_;
  if (recording_) recording_->add(samples_.front());
  each_tick(samples_.front());
}

FeltPress BodyTouch::press(const Site& site, const MeantPress& meant, const EachTick& each_tick) {
  finger_->begin(requestAt(site.place_mm + meant.beside_mm, meant));
  while (!finger_->done()) runTick(each_tick);
  return finger_->felt();
}

void BodyTouch::rest(double seconds, const EachTick& each_tick) {
  const auto ticks = static_cast<std::uint64_t>(std::llround(seconds / rig_.tick_s));
  for (std::uint64_t i = 0; i < ticks; ++i) runTick(each_tick);
}

void BodyTouch::mark(const std::string& text) {
  if (recording_) recording_->add(trace::RecordingEvent{.tick = next_, .finger = {}, .kind = "mark", .text = text});
}

void BodyTouch::finish(std::int64_t end_ms) {
  if (recording_) recording_->finish("done", formatIsoUtc(end_ms));
  recording_.reset();
}

}  // namespace palpate::training
