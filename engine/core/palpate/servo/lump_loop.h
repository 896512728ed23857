// Where the lumps of a loop lie that are not fixed: one state for all fingers, so that two of them can hold a lump
// between them.
//
//   finger 0, finger 1, ... of a tick ─ begin, touch, end ─┐
//   finger 0 of the next tick ─ begin: the lumps move ◄────┘
//
// A tick begins with the finger that is felt for a second time. The lumps then give way to what all fingers pressed in
// the tick before, and stay until the next one: who feels the same tips in the same order feels the same forces, to the
// bit, and a replay needs no more than the tips.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/contact/lump_force.h"

namespace palpate::servo {

/// Shared by the solvers of one rig (finger_solver.h) and by no other; one thread at a time.
class LumpLoop {
 public:
  explicit LumpLoop(std::size_t fingers) : fingers_(fingers) {}
  std::size_t fingers() const noexcept { return fingers_.size(); }

  /// Before a finger is felt that pressed like this in its last tick: where the lumps are now. No allocation.
  const contact::LumpPlaces& begin(const contact::Lumps& lumps, std::size_t finger, const contact::LumpPress& last,
                                   double tick_s) noexcept;
  /// After it was felt.
  void end(std::size_t finger, const contact::LumpPress& press) noexcept { fingers_[finger].press = press; }

  /// The finger presses nothing any more.
  void lift(std::size_t finger) noexcept { fingers_[finger].press = {}; }

  /// Lumps that are the same in both worlds stay where they have moved to; others begin at their place. Done once for
  /// each finger of a rig and the same each time. No allocation.
  void carryOver(const contact::Lumps& lumps, const LumpLoop& before, const contact::Lumps& lumps_before) noexcept;

  const contact::LumpPlaces& places() const noexcept { return places_; }
  /// The finger that is felt next finds the lump there: a recording says so (FingerOutput::lump), of which the time
  /// before is missing.
  void place(std::size_t lump, const Vec2& moved_mm) noexcept;
  /// The places of moving lumps are unknown: they are nowhere, and not felt, until place() is called.
  void forget(const contact::Lumps& lumps) noexcept;

 private:
  struct Finger {
    contact::LumpPress press;  ///< in its last tick
    bool felt = false;         ///< since the lumps moved
  };
  std::vector<Finger> fingers_;
  std::vector<contact::LumpPress> presses_ = std::vector<contact::LumpPress>(fingers_.size());  ///< side by side
  contact::LumpPlaces places_;
  std::size_t placed_ = contact::kMaxLumps;  ///< the lump of the last place(); or kMaxLumps
  Vec2 placed_at_mm_ = Vec2::Zero();
};

}  // namespace palpate::servo
