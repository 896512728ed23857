// The servo thread of the viewer: mouse fingers on the present world at 1 kHz, beside whatever the display does.
//
//   display ─ FingerTarget (triple buffer) ─►┐            ┌─► samples (ring), newest contacts, vitals ─► display
//   display ─ RigPlan (one atomic pointer) ─►│ runPaced   │
//                                            └────────────┘─► the plan it replaced ─► display frees it
//
// The servo thread takes no lock, allocates and frees nothing: a new world is offered by pointer, taken between two
// ticks, and the old one is handed back to be freed by the display's thread. So drawing, resizing, loading and
// rebuilding may take as long as they like.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "palpate/device/mouse_finger.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::viewer {

inline constexpr std::size_t kFingers = 2;

/// What the servo thread is to use from now on.
struct RigPlan {
  std::shared_ptr<const scene::World> world;
  std::array<contact::FingerSettings, kFingers> fingers;
  servo::LimiterSettings limiter;
  servo::FingerSolvers solvers;
  bool other_body = false;  ///< the triangles are not those of the plan before: fingers forget what they touched
};

/// The plan for a world with the settings of a scene: the first two fingers' radii, a fingertip where there are fewer.
RigPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body);

/// The finger was put elsewhere: it forgets what it touched.
void forgetTouch(servo::FingerChain& finger) noexcept;

/// Radius of a mouse finger of a scene, mm.
double radiusOf(const scene::Scene& scene, std::size_t finger);

/// Belongs to the display's thread.
class LiveServo {
 public:
  explicit LiveServo(RigPlan plan);
  ~LiveServo();
  LiveServo(const LiveServo&) = delete;
  LiveServo& operator=(const LiveServo&) = delete;

  void point(std::size_t finger, const device::FingerTarget& target) { links_to_[finger].target.publish(target); }

  /// The newest plan wins; it is taken within a tick or two of an exchange.
  void change(RigPlan plan);
  /// Once a frame: offers what waits, frees what the servo gave back. True when another plan is at work now.
  bool exchange();
  /// The plan at work, as far as this thread knows.
  const RigPlan& plan() const { return *at_work_; }

  const servo::ContactFrame& contacts() { return links_.contacts.newest(); }
  bool pop(trace::Sample& sample) { return links_.samples.pop(sample); }
  servo::LoopVitals vitals() { return links_.vitals.newest(); }
  std::size_t droppedSamples() const { return links_.samples.dropped(); }

  /// Ends the thread; the report of the whole run. At most once.
  servo::LoopReport stop();

 private:
  void beforeTick(servo::Rig& rig) noexcept;

  servo::LoopLinks links_;
  std::array<device::MouseLink, kFingers> links_to_;
  servo::Rig rig_;
  // Ownership: the display owns all plans; the servo only looks at the one at work.
  std::unique_ptr<RigPlan> at_work_;
  std::unique_ptr<RigPlan> offered_plan_;
  std::optional<RigPlan> waiting_;
  std::atomic<RigPlan*> offered_{nullptr};
  servo::LoopReport report_;
  std::thread thread_;
};

}  // namespace palpate::viewer
