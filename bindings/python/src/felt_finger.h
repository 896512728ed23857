// A finger and all that it needs for its next tick: what Finger, Fingers and rollout share, so that they feel the same
// to the bit.
#pragma once

#include <vector>

#include "palpate/servo/finger_solver.h"
#include "world_handle.h"

namespace palpate::python {

/// Plain data and its world's surface; the world must outlive it. One thread at a time.
struct FeltFinger {
  servo::FingerSolver solver;
  contact::FingerSettings settings = {};
  contact::FingerState state = {};
  std::uint64_t ticks = 0;  ///< its clock, for a body that breathes

  contact::FingerOutput step(const Vec3& tip) noexcept { return servo::touch(solver, settings, state, tip, ticks++); }
  /// It is nowhere: its next tip may be anywhere. The clock goes on.
  void lift() noexcept { servo::lift(solver, state); }
  /// As when it was made; lumps that it moved are back at their places.
  void reset() {
    lift();
    ticks = 0;
    if (solver.lumps) *solver.lumps = servo::LumpLoop(1);
  }
};

/// Each by itself: lumps that move do so for each finger alone, and threads may share the fingers.
inline std::vector<FeltFinger> fingersOn(const scene::World& world,
                                         const std::vector<contact::FingerSettings>& settings) {
  std::vector<FeltFinger> fingers;
  fingers.reserve(settings.size());
  for (const contact::FingerSettings& one : settings) {
    servo::FingerSolvers solver = servo::makeSolvers(world.surface, world.hdb, 1, world.breath);
    fingers.push_back({std::move(solver.front()), one});
  }
  return fingers;
}

}  // namespace palpate::python
