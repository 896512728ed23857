#include "hand_loop.h"

#include <fmt/format.h>

#include "palpate/device/device_profile.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/servo/device_limits.h"

namespace palpate::python {

namespace {

/// A device at the script's place.
device::Device heldByScript(std::size_t finger, const std::shared_ptr<Vec3>& tip) {
  device::Device device;
  device.name = fmt::format("python:{}", finger);
  device.read_tip = [tip](std::uint64_t /*tick*/) { return *tip; };
  return device;
}

}  // namespace

servo::LimiterSettings limitsFor(const scene::World& world, const std::vector<device::Device>& devices) {
  std::vector<device::Capabilities> able;
  for (const device::Device& device : devices) {
    if (device.capabilities.takes_force) able.push_back(device.capabilities);
  }
  const device::DeviceProfile profile = device::profileOf(world.scene.safety.device, able);
  servo::requireStable(profile, world.scene.safety, 1.0 / world.scene.ticks_per_s);
  return servo::limiterSettings(world, profile);
}

std::string nameOfFinger(const scene::World& world, std::size_t finger) {
  return finger < world.scene.fingers.size() ? world.scene.fingers[finger].name : fmt::format("finger {}", finger + 1);
}

HandLoop::HandLoop(WorldPointer world, std::vector<DevicePointer> devices, HandLoopSettings settings)
    : world_(std::move(world)), lent_(std::move(devices)) {
  const scene::World& felt = *world_->world;
  std::vector<device::Device> held = lent_.devices();
  for (std::size_t i = held.size(); held.size() < settings.fingers.size(); ++i) {
    tips_.push_back(std::make_shared<Vec3>(device::kNoPlace));
    held.push_back(heldByScript(i, tips_.back()));
  }
  servo::RigParts parts;
  parts.tick_s = 1.0 / felt.scene.ticks_per_s;
  parts.limiter = limitsFor(felt, held);
  parts.solvers = servo::makeSolvers(felt.surface, felt.hdb, settings.fingers.size(), felt.breath);
  parts.fingers = settings.fingers;
  parts.devices = held;
  rig_ = servo::rigOf(std::move(parts));
  samples_.resize(rig_.fingers.size());
  if (!settings.session) return;
  std::vector<trace::RecordingFinger> fingers;
  for (std::size_t i = 0; i < held.size(); ++i) {
    fingers.push_back(engine::recordingFinger(nameOfFinger(felt, i), held[i]));
  }
  trace::RecordingHeader header = engine::recordingHeader(felt.scene.ticks_per_s);
  header.notes = settings.notes.empty() ? felt.scene.title : settings.notes;
  writer_.emplace(*settings.session, header, fingers);
  writer_->add(engine::recordingWorld(felt, engine::feltWith(rig_)));
}

HandLoop::~HandLoop() { rest(); }

void HandLoop::place(std::span<const Vec3> tips) {
  for (std::size_t i = 0; i < tips_.size(); ++i) *tips_[i] = tips[i];
}

const std::vector<trace::Sample>& HandLoop::tick() {
  servo::runTick(rig_, tick_++, servo::LoopEvent::none, samples_);
  record();
  return samples_;
}

void HandLoop::record() {
  if (!writer_) return;
  for (const trace::Sample& sample : samples_) writer_->add(sample);
}

void HandLoop::lift(std::size_t finger) { servo::forgetTouch(rig_.fingers[finger]); }

void HandLoop::mark(const std::string& text) {
  if (!writer_) throw py::value_error("mark: this loop does not record a session");
  writer_->add(trace::RecordingEvent{tick_ == 0 ? 0 : tick_ - 1, std::nullopt, "mark", text});
}

void HandLoop::rest() {
  for (servo::FingerChain& finger : rig_.fingers) {
    if (finger.device.write_force && !closed_) finger.device.write_force(Vec3::Zero());
  }
}

void HandLoop::close(std::string_view ended_by) {
  if (closed_) return;
  rest();
  closed_ = true;
  if (writer_) writer_->finish(ended_by);
  writer_.reset();
  rig_.fingers.clear();
  lent_.releaseDevices();
}

}  // namespace palpate::python
