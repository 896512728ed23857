// What a finger of a rig touches, and how it looks for it: on the whole surface, or through a haptic detecting box.
//
//   contact::Surface ────────────────────────► contact::step ─┐
//   hdb::Partition ─► HdbSurface ─► box ─────► hdb::stepHdb ──┴─► touch (the tick's one line)
//
// It is all of a world that a finger sees. A rebuilt world is made beside the loop, solvers included with the room for
// their lists, and exchanged between two ticks; what the tick puts down is freed beside the loop again.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/hdb/hdb_finger.h"

namespace palpate::servo {

struct FingerSolver {
  const contact::Surface* surface = nullptr;  ///< must outlive the solver
  std::optional<hdb::HdbCandidates> box;      ///< none: the finger walks on the whole surface
};

/// One for each finger of a rig, in its order.
using FingerSolvers = std::vector<FingerSolver>;

/// `box` may be null; otherwise it was made for this surface. Allocates.
FingerSolvers makeSolvers(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                          std::size_t fingers);

/// One tick of one finger. No allocation, lock or exception.
contact::FingerOutput touch(FingerSolver& solver, const contact::FingerSettings& settings, contact::FingerState& state,
                            const Vec3& tip) noexcept;

/// Swaps what a finger touches, between two ticks. Its memory stays when it looks for the skin as before (the body is
/// the caller's affair: for another one give it a new state), and starts anew otherwise. Nothing is allocated or freed.
void exchange(FingerSolver& at_work, FingerSolver& next, contact::FingerState& state) noexcept;

}  // namespace palpate::servo
