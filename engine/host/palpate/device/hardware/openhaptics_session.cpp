// The scheduler reads `slots_` without a lock: it is stopped while they change. A device that is released while others
// are held stays initialised, at zero force, until the last goes: stopping would take the skin from the others'
// fingers. Errors are popped after each frame; the library names the device that each belongs to.
#include "palpate/device/hardware/openhaptics_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>
#include <utility>

#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/device/detail/each_back_end.h"

namespace palpate::device::openhaptics {

namespace {

/// Names that the library knows without configuration: the empty one is its default device. Another device is looked
/// for under each of them.
constexpr std::array kUsualNames = {"", "Default Device", "Default PHANToM", "Phantom2"};

/// Frames between two checks of the calibration, which query the device.
constexpr std::uint64_t kCalibrationFrames = 200;

/// More errors than this are not waiting in a library that works.
constexpr int kMaxErrors = 16;

/// How long a release waits for a frame with zero force, s; a stopped driver cannot send it.
constexpr double kRestS = 0.05;

std::uint32_t noteFlag(std::uint32_t code) {
  switch (code) {
    case kWarmMotorsError:
      return kWarmMotors;
    case kExceededMaxForce:
      return kForceExceeded;
    case kExceededMaxVelocity:
      return kVelocityExceeded;
    default:
      return kForceLimited;
  }
}

/// Whatever way the device is turned: the box of the turned box's corners.
Box3 boxInBody(const double (&low_and_high)[6], const DeviceFrame& frame) {
  Box3 box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place(low_and_high[(corner & 1) != 0 ? 3 : 0], low_and_high[(corner & 2) != 0 ? 4 : 1],
                     low_and_high[(corner & 4) != 0 ? 5 : 2]);
    box.extend(frame.placeInBody(place));
  }
  return box;
}

/// Parts of a model's name; the first row that fits counts.
struct ModelName {
  std::string_view part;
  std::string_view other_part;
  scene::DeviceModel kind;
};
constexpr std::array kModelNames = {
    ModelName{"premium", "3.0", scene::DeviceModel::premium_3_0},
    ModelName{"premium", "1.5", scene::DeviceModel::premium_1_5},
    ModelName{"premium", "", scene::DeviceModel::unknown},
    ModelName{"omni", "", scene::DeviceModel::omni},
    ModelName{"desktop", "", scene::DeviceModel::touch_x},  // predecessor of the Touch X
    ModelName{"touch x", "", scene::DeviceModel::touch_x},
    ModelName{"touch", "", scene::DeviceModel::touch},
};

}  // namespace

scene::DeviceModel findDeviceModel(std::string_view model) {
  const std::string lower = inSmallLetters(model);
  for (const ModelName& name : kModelNames) {
    if (lower.find(name.part) != std::string::npos && lower.find(name.other_part) != std::string::npos) {
      return name.kind;
    }
  }
  return scene::DeviceModel::unknown;
}

Session::~Session() {
  stop();
  releaseDevices();
}

std::uint32_t Session::onTick(void* session) {
  auto* self = static_cast<Session*>(session);
  for (const std::shared_ptr<Slot>& slot : self->slots_) self->serve(*slot);
  return kCallbackContinue;
}

void Session::serve(Slot& slot) noexcept {
  DriverReading reading;
  if (slot.handle == kInvalidHandle) {
    reading.faults = kDriverError;
    slot.link.dueForce();
    slot.link.publish(reading);
    return;
  }
  api_.begin_frame(slot.handle);
  Vec3 place = kNoPlace;
  Vec3 velocity = Vec3::Zero();
  int buttons = 0;
  api_.get_doubles(kCurrentPosition, place.data());
  api_.get_doubles(kCurrentVelocity, velocity.data());
  api_.get_integers(kCurrentButtons, &buttons);
  const std::uint64_t frame = slot.frames.load(std::memory_order_relaxed);
  if (frame % kCalibrationFrames == 0) checkCalibration(slot);
  const Vec3 force = slot.frame.forceInDevice(slot.link.dueForce());
  api_.set_doubles(kCurrentForce, force.data());
  api_.end_frame(slot.handle);
  drainErrors(slot);
  reading.tip = slot.frame.placeInBody(place);
  reading.velocity = slot.frame.motionInBody(velocity);
  reading.buttons = static_cast<std::uint32_t>(buttons);
  reading.faults = std::exchange(slot.faults, 0u) | (slot.calibration == kCalibrated ? 0u : kNotCalibrated);
  reading.notes = std::exchange(slot.notes, 0u);
  slot.link.publish(reading);
  slot.frames.store(frame + 1, std::memory_order_relaxed);
  if (slot.link.muted() && force.isZero()) slot.frames_at_rest.fetch_add(1, std::memory_order_relaxed);
}

/// An update takes the encoders' zero from where the device is now, in its inkwell or by itself.
void Session::checkCalibration(Slot& slot) noexcept {
  slot.calibration = api_.check_calibration();
  if (slot.calibration != kNeedsUpdate) return;
  int styles = 0;
  api_.get_integers(kCalibrationStyle, &styles);
  for (const std::uint32_t style : {kAutomatic, kInkwell, kEncoderReset}) {
    if ((static_cast<std::uint32_t>(styles) & style) == 0) continue;
    api_.update_calibration(style);
    slot.calibration = api_.check_calibration();
    return;
  }
}

void Session::drainErrors(Slot& slot) noexcept {
  for (int i = 0; i < kMaxErrors; ++i) {
    const ErrorInfo error = api_.get_error();
    if (error.code == kSuccess) return;
    Slot* owner = &slot;
    for (const std::shared_ptr<Slot>& other : slots_) {
      if (other->handle == error.device) owner = other.get();
    }
    if (isHarmless(error.code)) {
      owner->notes |= noteFlag(error.code);
    } else {
      owner->faults |= kDriverError;
    }
    owner->last_error.store(error.code, std::memory_order_relaxed);
  }
}

std::uint32_t Session::firstError() const {
  std::uint32_t first = kSuccess;
  for (int i = 0; i < kMaxErrors; ++i) {
    const std::uint32_t code = api_.get_error().code;
    if (code == kSuccess) break;
    if (first == kSuccess) first = code;
  }
  return first;
}

bool Session::isOnScheduler(Handle handle) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const auto& slot) { return slot->handle == handle; });
}

/// A given name is the only one; otherwise the first device that is not held.
Handle Session::firstFree(const OpenOptions& options, std::string& name, std::uint32_t& error) {
  std::vector<std::string> names(kUsualNames.begin(), kUsualNames.end());
  if (!options.which.empty()) names = {options.which};
  for (const std::string& candidate : names) {
    const auto left = std::find_if(slots_.begin(), slots_.end(),
                                   [&](const auto& slot) { return !slot->held && slot->name == candidate; });
    if (left != slots_.end()) {
      const Handle handle = (*left)->handle;
      slots_.erase(left);
      name = candidate;
      return handle;
    }
    firstError();  // clears earlier errors
    const Handle handle = api_.init_device(candidate.empty() ? nullptr : candidate.c_str());
    const std::uint32_t code = firstError();
    if (handle != kInvalidHandle && !isHarmless(code) && code != kSuccess) api_.disable_device(handle);
    if (handle != kInvalidHandle && (code == kSuccess || isHarmless(code)) && !isOnScheduler(handle)) {
      name = candidate;
      return handle;
    }
    if (code != kSuccess && (error == kSuccess || error == kAlreadyInitiated)) error = code;
  }
  return kInvalidHandle;
}

Capabilities Session::readCapabilities(Handle handle, const DeviceFrame& frame) const {
  Capabilities able;
  api_.make_current(handle);
  const auto number = [&](std::uint32_t parameter) {
    double value = 0.0;
    api_.get_doubles(parameter, &value);
    return std::isfinite(value) && value > 0.0 ? value : 0.0;
  };
  const auto text = [&](std::uint32_t parameter) {
    const char* words = api_.get_string(parameter);
    return words == nullptr ? std::string() : oneLine(words);
  };
  able.takes_force = true;
  able.max_force_n = number(kNominalMaxForce);
  able.continuous_force_n = number(kNominalMaxContinuousForce);
  able.nominal_stiffness_n_per_mm = number(kNominalMaxStiffness);
  double box[6] = {};
  api_.get_doubles(kUsableWorkspace, box);
  if (box[3] > box[0]) able.workspace_mm = boxInBody(box, frame);
  int rate_hz = 0;
  api_.get_integers(kUpdateRate, &rate_hz);
  able.rate_hz = rate_hz > 0 ? rate_hz : 1000.0;
  able.delay_ticks = 1;
  able.rhythm = Rhythm::self_paced;
  able.model = text(kModelType);
  able.kind = findDeviceModel(able.model);
  able.version = text(kApiVersion);
  firstError();  // a device answers unknown parameters with an error
  return able;
}

Added Session::initialise(const OpenOptions& options, const DeviceFrame& frame) {
  Added added;
  std::string name;
  std::uint32_t error = kSuccess;
  const Handle handle = firstFree(options, name, error);
  if (handle == kInvalidHandle) {
    const std::string what = options.which.empty() ? "" : fmt::format("device '{}': ", oneLine(options.which));
    added.reason = what + (error == kSuccess ? "the driver reports no device" : describe(error));
    added.remedy = wordsOf(error == kSuccess ? std::uint32_t{0x300} : error).remedy;
    return added;
  }
  const Capabilities able = readCapabilities(handle, frame);
  api_.enable(kForceOutput);  // applies to the current device
  added.slot = std::make_shared<Slot>(DriverLinkSettings{options.tick_s, able.rate_hz, able.max_force_n}, frame);
  added.slot->name = name;
  added.slot->handle = handle;
  added.slot->capabilities = able;
  added.slot->held = true;
  return added;
}

Added Session::add(const OpenOptions& options) {
  const DeviceFrame frame = frameOf(options);
  const std::lock_guard lock(mutex_);
  stop();
  Added added = initialise(options, frame);
  if (added.slot) slots_.push_back(added.slot);
  const std::uint32_t error = slots_.empty() ? kSuccess : start();
  if (added.slot && error != kSuccess) {
    stop();
    slots_.pop_back();
    api_.disable_device(added.slot->handle);
    added = {nullptr, "the scheduler does not start: " + describe(error), wordsOf(error).remedy};
  }
  return added;
}

void Session::waitForRest(const Slot& slot) const {
  const auto since = Clock::now();
  const std::uint64_t before = slot.frames_at_rest.load(std::memory_order_relaxed);
  while (running_ && secondsSince(since) < kRestS && slot.frames_at_rest.load(std::memory_order_relaxed) == before) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

void Session::release(const std::shared_ptr<Slot>& slot) {
  slot->link.mute();
  const std::lock_guard lock(mutex_);
  if (!slot->held) return;
  waitForRest(*slot);
  slot->held = false;
  if (std::any_of(slots_.begin(), slots_.end(), [](const auto& other) { return other->held; })) return;
  stop();
  releaseDevices();
}

bool Session::hasOtherWorkingSlot(const Slot& slot) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const auto& other) {
    return other.get() != &slot && other->held && other->link.driverFaults() == 0;
  });
}

bool Session::revive(Slot& slot) {
  const std::lock_guard lock(mutex_);
  if (!slot.held || (slot.link.driverFaults() & kDriverError) == 0) return slot.held;
  if (hasOtherWorkingSlot(slot)) return false;
  stop();
  if (slot.handle != kInvalidHandle) api_.disable_device(slot.handle);
  firstError();
  slot.handle = api_.init_device(slot.name.empty() ? nullptr : slot.name.c_str());
  const std::uint32_t error = firstError();
  if (slot.handle != kInvalidHandle && error != kSuccess && !isHarmless(error)) {
    api_.disable_device(slot.handle);
    slot.handle = kInvalidHandle;
  }
  if (slot.handle != kInvalidHandle) {
    api_.make_current(slot.handle);
    api_.enable(kForceOutput);
  }
  slot.last_error.store(error, std::memory_order_relaxed);
  slot.frames.store(0, std::memory_order_relaxed);  // it is calibrated again
  start();
  return slot.handle != kInvalidHandle;
}

std::uint32_t Session::start() {
  firstError();
  schedule_ = api_.schedule(onTick, this, kMaxPriority);
  api_.start_scheduler();
  running_ = true;
  return firstError();
}

void Session::stop() {
  if (!running_) return;
  api_.stop_scheduler();
  api_.unschedule(schedule_);
  running_ = false;
}

/// Each with a last frame of zero force: a motor keeps its last force.
void Session::releaseDevices() {
  for (const std::shared_ptr<Slot>& slot : slots_) {
    if (slot->handle == kInvalidHandle) continue;
    const Vec3 none = Vec3::Zero();
    api_.begin_frame(slot->handle);
    api_.set_doubles(kCurrentForce, none.data());
    api_.end_frame(slot->handle);
    api_.disable_device(slot->handle);
  }
  slots_.clear();
}

std::string Session::describe(std::uint32_t code) const {
  const char* words = api_.error_string == nullptr ? nullptr : api_.error_string(code);
  const std::string ours = wordsOf(code).name;
  return words == nullptr || *words == '\0' ? ours : fmt::format("{}, {}", ours, oneLine(words));
}

std::string Session::explain(const Slot& slot) const {
  const std::uint32_t faults = slot.link.driverFaults();
  const std::uint32_t error = slot.last_error.load(std::memory_order_relaxed);
  if ((faults & kDriverError) != 0) return fmt::format("{}; {}", describe(error), wordsOf(error).remedy);
  if ((faults & kNotCalibrated) != 0) {
    return "it is not calibrated; put the pen into its inkwell, or move the arm to its neutral position";
  }
  if ((faults & kNoPose) != 0) return "the driver reports no position; check the device's cable";
  return {};
}

std::vector<std::string> Session::heldDevices() {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const std::shared_ptr<Slot>& slot : slots_) {
    if (slot->held) names.push_back(slot->capabilities.model);
  }
  return names;
}

Loaded load(const OpenOptions& options) {
  Loaded loaded;
  loaded.library = openLibrary(libraryNames(options.library));
  if (loaded.library) loaded.missing = resolveApi(loaded.library, loaded.api);
  return loaded;
}

std::shared_ptr<Session> sharedSession(const Loaded& loaded) {
  static std::mutex mutex;
  static std::map<void*, std::weak_ptr<Session>> sessions;
  const std::lock_guard lock(mutex);
  std::weak_ptr<Session>& known = sessions[loaded.library.handle];
  std::shared_ptr<Session> session = known.lock();
  if (!session) known = session = std::make_shared<Session>(loaded.api);
  return session;
}

}  // namespace palpate::device::openhaptics
