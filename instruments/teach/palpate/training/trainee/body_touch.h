// A simulated trainee's finger on a body: the whole haptic loop closed over a simulated hand, in simulated time, as
// fast as it can; the same bits each time.
//
//   TraineeFinger ─ goal ─► SimulatedHand ─ tip ─► servo::runTick [ contact, limiter ] ─ force ─► SimulatedHand
//                     ▲                                   └─ sample ─► trainee, Session, recording
//                     └──────────────────── felt ────────────────┘
//
// One rig and one session for a whole session: ticks go on through all its trials, worlds are added as they change.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "palpate/device/hand_device.h"
#include "palpate/scene/world.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/recording_writer.h"
#include "palpate/training/trainee/touching.h"
#include "palpate/training/trainee/trial_worlds.h"

namespace palpate::training {

struct BodyTouchSettings {
  device::HandChoice hand = {.hand = device::HandKind::thimble, .device = scene::DeviceModel::touch_x};
  std::filesystem::path recording;  ///< where it is recorded; empty: it is not
  std::int64_t start_ms = 0;        ///< since 1970: for the session's header
  std::string notes;                ///< likewise
};

/// "simulated thimble on touch_x": for records.
std::string describeDevice(const device::HandChoice& hand);

class BodyTouch final : public Touching {
 public:
  /// Throws Error for a body without skin under a site, and where the session cannot be written.
  BodyTouch(TrialWorlds worlds, const SiteSet& sites, const BodyTouchSettings& settings);
  ~BodyTouch() override;

  void change(const std::optional<HiddenNow>& hidden) override { exchangeWorld(worlds_.with(hidden)); }
  /// The same with any world of that body.
  void exchangeWorld(std::shared_ptr<const scene::World> next);
  FeltPress press(const Site& site, const MeantPress& meant, const EachTick& each_tick) override;
  void rest(double seconds, const EachTick& each_tick) override;
  std::uint64_t tick() const override { return next_; }
  double tickS() const override { return rig_.tick_s; }
  void mark(const std::string& text) override;
  void finish(std::int64_t end_ms) override;

  const scene::World& world() const { return *world_; }
  const servo::FingerChain& chain() const { return rig_.fingers.front(); }

 private:
  void begin(const BodyTouchSettings& settings);
  void runTick(const EachTick& each_tick);
  std::optional<double> heightAt(const Vec2& place) const;
  PressRequest requestAt(const Vec2& place, const MeantPress& meant) const;
  servo::LimiterSettings limiterSettingsFor(const scene::World& world) const;

  TrialWorlds worlds_;
  std::shared_ptr<const scene::World> world_;
  device::DeviceProfile profile_;
  std::unique_ptr<device::SimulatedHand> hand_;  // its address is the device's
  std::optional<TraineeFinger> finger_;
  servo::Rig rig_;
  std::array<trace::Sample, 1> samples_{};
  std::uint64_t next_ = 0;
  std::optional<trace::RecordingWriter> recording_;
};

}  // namespace palpate::training
