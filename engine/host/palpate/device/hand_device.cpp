// A tick of the servo is a tick of the hand. Deadlines that a paced loop slept through pass here too: the motor holds
// its force for two of them, as drivers do, and releases it.
#include "palpate/device/hand_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/scene/words.h"

namespace palpate::device {

namespace {

/// Half the box in which a device of this size moves, mm.
constexpr double kReachMm = 80.0;

/// A loop that was away for longer left the hand alone: it rests by then.
constexpr std::uint64_t kMaxCatchUpTicks = 500;

std::vector<std::string> handOrDeviceNames() {
  std::vector<std::string> words = wordList<HandKind>();
  for (const auto& [word, device] : WordsOf<scene::DeviceModel>::kAll) {
    if (device != scene::DeviceModel::unknown) words.emplace_back(word);
  }
  return words;
}

class HandDevice {
 public:
  HandDevice(const SimulatedHandSettings& settings, HandKind kind, std::shared_ptr<const std::vector<Vec3>> path)
      : hand_(settings), path_(std::move(path)), tick_s_(settings.tick_s) {
    if (kind == HandKind::dead_load) hand_.goal.push = Vec3(0, 0, -kDeadLoadN);
  }

  Vec3 readTip(std::uint64_t tick) noexcept {
    // Its time begins with the first force: the opener reads it long before a loop holds it. A servo may count from 0
    // again.
    if (!written_ || tick < due_) due_ = tick;
    const std::uint64_t missed = std::min(tick - due_, kMaxCatchUpTicks);
    for (std::uint64_t i = 0; i < missed; ++i) pass(tick - missed + i, i < kMaxPoseTicks ? force_ : Vec3(Vec3::Zero()));
    due_ = tick;
    return hand_.readTip();
  }

  /// The motor has a force at once: the next position was read after it.
  DeviceState state() const noexcept { return {.loop_ticks = written_ ? 1u : 0u}; }

  void writeForce(const Vec3& force) noexcept {
    written_ = true;
    force_ = force.allFinite() ? force : Vec3(Vec3::Zero());
    pass(due_, force_);
    ++due_;
  }

 private:
  const Vec3& wanted(std::uint64_t tick) const noexcept {
    return (*path_)[std::min<std::uint64_t>(tick, path_->size() - 1)];
  }

  /// The tick's own millisecond.
  void pass(std::uint64_t tick, const Vec3& force) noexcept {
    if (path_) {
      hand_.goal.place = wanted(tick);
      hand_.goal.velocity = (wanted(tick + 1) - wanted(tick)) / tick_s_;
    }
    hand_.writeForce(force);
  }

  SimulatedHand hand_;
  std::shared_ptr<const std::vector<Vec3>> path_;  ///< null: it rests
  double tick_s_;
  Vec3 force_ = Vec3::Zero();
  std::uint64_t due_ = 0;  ///< the tick whose force comes next
  bool written_ = false;
};

Capabilities capabilitiesOf(const HandChoice& choice, const SimulatedHandSettings& settings) {
  Capabilities able;
  able.takes_force = true;
  able.max_force_n = settings.device.force_n;
  able.continuous_force_n = settings.device.force_n;
  able.nominal_stiffness_n_per_mm = settings.device.stiffness_n_per_mm;
  able.workspace_mm = Box3(settings.start - Vec3::Constant(kReachMm), settings.start + Vec3::Constant(kReachMm));
  able.rate_hz = 1.0 / settings.tick_s;
  able.delay_ticks = kHandDelayTicks;
  able.kind = choice.device;
  able.model = fmt::format("simulated {}, {}", wordFor(choice.device), wordFor(choice.hand));
  return able;
}

}  // namespace

HandChoice handChoice(std::string_view words) {
  HandChoice choice;
  if (words.empty()) return choice;
  for (const std::string_view word : split(words, ',')) {
    const auto hand = valueNamed<HandKind>(word);
    const auto device = valueNamed<scene::DeviceModel>(word);
    if (hand) {
      choice.hand = *hand;
    } else if (device && *device != scene::DeviceModel::unknown) {
      choice.device = *device;
    } else {
      throw Error(unknownName("hand or device", word, "hand:HAND,DEVICE", handOrDeviceNames()));
    }
  }
  return choice;
}

Probe probeHand(const OpenOptions& options) {
  Probe probe;
  try {
    const HandChoice choice = handChoice(options.which);
    probe.available = true;
    probe.devices.push_back(fmt::format("{} on {}", wordFor(choice.hand), wordFor(choice.device)));
  } catch (const Error& error) {
    probe.reason = error.what();
    probe.remedy = "name a hand and a device, as in hand:stylus_z,touch_x";
  }
  return probe;
}

Device openHand(const OpenOptions& options) {
  const HandChoice choice = handChoice(options.which);
  const bool has_path = options.tips != nullptr && !options.tips->empty();
  SimulatedHandSettings settings;
  settings.device = profileOf(choice.device);
  settings.hand = handModel(choice.hand);
  settings.tick_s = options.tick_s;
  settings.delay_ticks = kHandDelayTicks;
  settings.start = has_path ? options.tips->front() : options.origin_mm;
  const auto hand = std::make_shared<HandDevice>(settings, choice.hand, has_path ? options.tips : nullptr);
  Device device;
  device.name = "hand";
  device.capabilities = capabilitiesOf(choice, settings);
  device.read_tip = [hand](std::uint64_t tick) { return hand->readTip(tick); };
  device.write_force = [hand](const Vec3& force) { hand->writeForce(force); };
  device.state = [hand] { return hand->state(); };
  return device;
}

}  // namespace palpate::device
