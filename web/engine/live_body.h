// A body under up to two fingers that a pointer leads: what a page holds of the engine.
//
//   page: place, depth, pressed ─► aim ─► MouseFinger ─ tip ─► Simulator ─► force ─► recording, page
//                                          └──────────── 1 kHz ──────────┘      └─► deformed skin ─► FramePacker
//
// One thread; no clock: who calls decides when a tick is. Lengths in mm, forces in N.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "engine/frame_packer.h"
#include "engine/recording.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/engine/simulator.h"

namespace palpate::web {

inline constexpr std::size_t kFingers = 2;
/// Of both fingers: a fingertip.
inline constexpr double kRadiusMm = 8.0;

class LiveBody {
 public:
  /// The fingers are those of the page; the scene's own are left out. Throws Error as engine::Simulator does.
  explicit LiveBody(std::shared_ptr<const scene::World> world);

  const scene::World& world() const { return simulator_.world(); }
  /// The same body with these dysfunctions, and no others; fingers go on touching. Throws Error as scene::rebuilt does.
  void setDysfunctions(std::vector<maps::Dysfunction> dysfunctions);

  /// Where a finger is wanted. Its radius is set here. A target that is not finite lifts the finger.
  void aim(std::size_t finger, device::FingerTarget target);
  /// A thousandth of a second each.
  void run(std::size_t ticks) noexcept;
  const contact::FingerOutput& felt(std::size_t finger) const { return at_work_[finger].felt; }
  std::uint64_t ticks() const { return tick_; }

  /// The skin as the fingers leave it: what changed since the last frame, or all of it.
  void packFrame(FramePacker& frame, bool all);

  const Recording& recording() const { return recording_; }
  /// Forgets what was recorded; time begins anew.
  void recordAnew();

 private:
  struct Finger {
    device::FingerTarget target;
    device::MouseFinger path;
    contact::FingerOutput felt;
  };

  engine::Simulator simulator_;
  std::array<Finger, kFingers> at_work_;
  std::uint64_t tick_ = 0;
  Recording recording_;
};

}  // namespace palpate::web
