// A body under up to two fingers that a pointer leads: the page's part of the engine.
//
//   page: place, depth, pressed ─► aim ─► MouseFinger ─ tip ─► Simulator ─► force ─► recording, page
//                                          └──────────── 1 kHz ──────────┘      └─► deformed skin ─► FramePacker
//
// One thread; no clock: the caller decides when a tick is. Lengths in mm, forces in N.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame_packer.h"
#include "palpate/contact/finger_state.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/engine/simulator.h"

namespace palpate::web {

// A log of the fingers, tick by tick, to be saved as the table that `palpate` reads (trace/forces_csv.h).

/// Ticks of fingers that are stored: five minutes of one. The oldest go first.
inline constexpr std::size_t kMaxRecorded = 300'000;

class Recording {
 public:
  void add(std::uint64_t tick, std::size_t finger, const contact::FingerOutput& felt);
  std::size_t size() const { return rows_.size(); }
  /// The whole table, header and all.
  std::string asForcesCsv() const;

 private:
  /// The part of a FingerOutput that the table has: a third of its size.
  struct Row {
    std::uint64_t tick;
    Vec3 tip, proxy, anchor, force;
    double depth_mm;
    Index triangle;
    std::uint32_t status;
    std::uint8_t finger;
    contact::Touch touch;
  };
  std::deque<Row> rows_;
};

/// The lumps of the preset `lumps` (examples/scenes/lumps.toml): the page's engine reads no scene files. A test
/// compares.
std::vector<scene::LumpSettings> presetLumps();

inline constexpr std::size_t kFingers = 2;
/// A fingertip, for both fingers.
inline constexpr double kRadiusMm = 8.0;

class LiveBody {
 public:
  /// The fingers are those of the page; the scene's own are left out. Throws Error as engine::Simulator does.
  explicit LiveBody(std::shared_ptr<const scene::World> world);

  const scene::World& world() const { return simulator_.world(); }
  /// The same body with these dysfunctions, and no others; fingers stay in contact. Throws Error as scene::rebuilt
  /// does.
  void setDysfunctions(std::vector<maps::Dysfunction> dysfunctions);
  /// The same for lumps under the skin.
  void setLumps(std::vector<scene::LumpSettings> lumps);

  /// Sets a finger's target. Its radius is set here. A target that is not finite lifts the finger.
  void aim(std::size_t finger, device::FingerTarget target);
  /// Runs ticks of a millisecond each.
  void run(std::size_t ticks) noexcept;
  const contact::FingerOutput& felt(std::size_t finger) const { return at_work_[finger].felt; }
  std::uint64_t ticks() const { return tick_; }
  /// The pressure on a fingertip, kPa, as kpa.size() taxels of a square pad of 16 mm. Returns false, and writes
  /// nothing, where the body has no lumps.
  bool pad(std::size_t finger, std::span<double> kpa) const noexcept;

  /// The skin as the fingers leave it: what changed since the last frame, or all of it.
  void packFrame(FramePacker& frame, bool all);

  const Recording& recording() const { return recording_; }
  /// Forgets what was recorded; time begins again.
  void restartRecording();

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
