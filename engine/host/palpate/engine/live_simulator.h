// The engine in the hands of another program, with a servo thread of its own: poses in, newest forces out, at 1 kHz
// whatever the program's own loop does.
//
//   move ─ triple buffer ─► servo thread [ touch ─► limiter ] ─ triple buffer ─► felt ─► skin ─► deformed surface
//   change ─ ServoThread ─► next tick
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/triple_buffer.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/living_skin.h"
#include "palpate/engine/servo_thread.h"

namespace palpate::engine {

/// Belongs to one thread. No call waits for the servo thread, but `stop` and the end.
class LiveSimulator {
 public:
  /// Starts at once, with every finger away from the body. Fingers as for Simulator.
  explicit LiveSimulator(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers = {});
  LiveSimulator(const LiveSimulator&) = delete;
  LiveSimulator& operator=(const LiveSimulator&) = delete;

  std::size_t fingers() const noexcept { return fingers_.size(); }

  /// Where the finger's tip is now, mm; the servo feels it from its next tick on. Finger < fingers().
  void move(std::size_t finger, const Vec3& tip) noexcept;
  /// The finger leaves: its next place may be anywhere, and nothing between here and there is touched.
  void lift(std::size_t finger) noexcept;

  /// Every finger's sample of the newest tick: its contact, and as `device_force` the force that is safe to send to a
  /// hand (docs/explanation/servo.md). Stays until the next call.
  std::span<const trace::Sample> felt() { return servo_.contacts(); }
  /// The skin as these leave it; as Simulator::skin.
  const deform::DeformedSurface& skin();
  double lift() const noexcept { return skin_ ? skin_->lift() : 0.0; }

  /// Another world from one of the next ticks on. Where it has the same body (scene::rebuilt), fingers go on touching.
  /// Throws Error when it and the fingers do not suit.
  void change(std::shared_ptr<const scene::World> world);
  /// The world at work. The one before is freed in this call, or in that of `skin`.
  const scene::World& world();

  /// Every sample, vitals and the end of the thread.
  ServoThread& servo() noexcept { return servo_; }

 private:
  /// Data for the servo thread.
  struct Pose {
    Vec3 tip;
    std::uint64_t placing;  ///< another number: the finger did not come here along the way
  };
  struct Link {
    TripleBuffer<Pose> pose;
    bool present = false;  // the owner's, like what follows
    std::uint64_t placing = 0;
    Vec3 tip;  // the servo's, like what follows
    std::uint64_t placing_felt = 0;
    Link();
  };
  static std::vector<device::Device> collectDevices(std::span<Link> links);
  static ServoThread::Guide makeGuide(std::span<Link> links);

  std::vector<contact::FingerSettings> fingers_;
  std::unique_ptr<Link[]> links_;
  std::shared_ptr<const scene::World> newest_world_;
  std::shared_ptr<const scene::World> skin_world_;  ///< world of the skin below
  std::optional<LivingSkin> skin_;
  ServoThread servo_;  // last: it reads the links
};

}  // namespace palpate::engine
