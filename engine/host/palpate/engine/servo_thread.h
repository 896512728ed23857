// The servo thread: fingers on the present world at 1 kHz, alongside the rest of the program.
//
//   devices (read_tip) ─────────────────────►┐            ┌─► samples (ring), newest contacts, vitals ─► any one thread
//   owner ─ ServoPlan (base/handover.h) ────►│ runPaced   │
//                                            └────────────┘─► the plan it replaced ─► the owner frees it
//
// The thread takes no lock, allocates and frees nothing: a new world is offered by pointer, taken between two ticks,
// and the old one is handed back to be freed by the owner. So drawing, loading and rebuilding may take as long as they
// like. Devices come and go in the same way.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "palpate/base/handover.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::engine {

/// World and fingers of the servo thread from now on.
struct ServoPlan {
  std::shared_ptr<const scene::World> world;
  std::vector<contact::FingerSettings> fingers;
  servo::LimiterSettings limiter;
  servo::FingerSolvers solvers;
  bool other_body = true;  ///< the triangles are not those of the plan before: fingers forget their contacts
  /// New devices by finger; nothing: the one at work stays. With `limiter`, in one tick: no device is ever felt by the
  /// limits of another.
  std::vector<std::optional<device::Device>> devices = {};
};

/// A world as the servo feels it: all that a recording needs to replay it.
struct FeltWorld {
  std::uint32_t number = 0;  ///< trace::Sample::world
  std::shared_ptr<const scene::World> world;
  std::vector<FingerSetup> fingers;
};

/// The plan for these fingers on a world, with the world's own limits. Throws Error for settings that make no sense.
ServoPlan servoPlan(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers);

using servo::forgetTouch;

/// Belongs to one thread, its owner.
class ServoThread {
 public:
  /// Called on the servo thread before each tick, for devices that put their fingers elsewhere (forgetTouch); keeps a
  /// device's rules. May be empty.
  using Guide = std::function<void(std::span<servo::FingerChain>)>;

  /// Starts at once, a tick every `tick_s` of the first finger. One device a finger of the plan, in its order. Throws
  /// Error for another number. At most `record_capacity` samples wait for a recorder.
  ServoThread(ServoPlan plan, std::vector<device::Device> devices, Guide guide = {},
              std::size_t record_capacity = servo::kRecordCapacity);
  /// Ends the thread.
  ~ServoThread();
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;

  /// The newest plan wins; it is taken within a tick or two, of this call or of an exchange. The rate stays that of the
  /// start, whatever tick the plan's settings were made for. Throws Error for another number of fingers.
  void change(ServoPlan plan);
  /// Call it now and then, e.g. once a frame: offers the waiting plan, frees what the servo returned. True when another
  /// plan came to work since the last call.
  bool exchange();
  /// All changes are at work, and the replaced objects are freed.
  bool settled() const noexcept { return !waiting_ && !offered_world_; }
  double ticksPerS() const noexcept { return 1.0 / tick_s_; }
  /// The world at work, as far as this thread knows.
  const std::shared_ptr<const scene::World>& world() const { return at_work_world_; }

  const servo::TickSamples& contacts() { return links_.contacts.newest(); }
  bool pop(trace::Sample& sample) { return links_.samples.pop(sample); }
  servo::LoopVitals vitals() { return links_.vitals.newest(); }
  /// Press it from any thread: no finger gets a force from the next tick on, until it is released.
  servo::EmergencyStop& emergencyStop() { return links_.emergency_stop; }
  std::size_t droppedSamples() const { return links_.samples.dropped(); }

  // For a recorder (recorder.h), one at a time.

  /// From the next tick on every sample goes into a ring of its own as well. The listener is called for the world at
  /// work, for the one on its way, and for each that is offered later, before any sample names it; on the owner's
  /// thread, and not once it was taken back with an empty one.
  using WorldListener = std::function<void(const FeltWorld&)>;
  void record(WorldListener listener);
  /// Any one thread.
  bool popRecorded(servo::NumberedSample& sample) { return links_.record.pop(sample); }
  std::size_t droppedRecorded() const { return links_.record.dropped(); }

  /// Ends the thread; the report of the whole run. At most once.
  servo::LoopReport stop();

 private:
  void beforeTick(servo::Rig& rig) noexcept;
  void advance();
  FeltWorld offeredWorld() const;

  const std::size_t fingers_;
  const double tick_s_;
  servo::LoopLinks links_;
  Guide guide_;
  servo::Rig rig_;                      // the servo's, once it runs
  std::unique_ptr<ServoPlan> at_work_;  // likewise
  Handover<ServoPlan> handover_;
  std::shared_ptr<const scene::World> at_work_world_;
  std::shared_ptr<const scene::World> offered_world_;  // in the offered plan, not known to be taken
  std::optional<ServoPlan> waiting_;                   // until the one offered is taken
  FeltWorld felt_;                                     // at work, as far as this thread knows
  std::optional<FeltWorld> felt_next_;                 // in the offered plan
  WorldListener listener_;
  bool changed_ = false;
  servo::LoopReport report_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace palpate::engine
