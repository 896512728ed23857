// A program's fingers in a world: their settings, whether they and the world suit each other, and all that such a
// finger needs from tick to tick. Simulator, C, Python and batches step the same one, so they feel the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/scene/world.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::engine {

/// Settings of this number of fingers on a scene: its own in order, then points with the scene's friction.
std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene, std::size_t fingers);

/// Settings of the scene's own fingers, or of one where it has none.
std::vector<contact::FingerSettings> fingerSettings(const scene::Scene& scene);

/// Throws Error for settings that make no sense or are out of the range of the scene file's keys. `number`: of the
/// finger, for the message.
void checkFinger(const contact::FingerSettings& settings, std::size_t number = 0);

/// The same of all, and for a ball where the world knows points only (the detecting box).
void checkFingers(const scene::World& world, std::span<const contact::FingerSettings> fingers);

/// Plain data on a world's surface, which must outlive it. One thread at a time. No device, limiter or hand.
struct Finger {
  servo::FingerSolver solver = {};
  contact::FingerSettings settings = {};
  contact::FingerState state = {};
  std::uint64_t ticks = 0;  ///< its clock, for a body that breathes

  /// One tick; its tip is here now (mm, the body's frame). No allocation, lock or exception.
  contact::FingerOutput feel(const Vec3& tip) noexcept { return servo::touch(solver, settings, state, tip, ticks++); }
  /// Lifts the finger: its next tip may be anywhere. The clock continues.
  void lift() noexcept { servo::lift(solver, state); }
  /// Resets it to its first state; lumps are back at their places, for all of a rig.
  void reset();
};

/// Each by itself: lumps that move do so for each alone, and threads may share the fingers. Settings are not checked.
std::vector<Finger> fingersOn(const scene::World& world, std::span<const contact::FingerSettings> fingers);

/// A rig's: they feel each other through lumps that move, and belong to one thread. Settings are not checked.
std::vector<Finger> makeRig(const scene::World& world, std::span<const contact::FingerSettings> fingers);

/// True if both have the same triangles at the same places, so that a finger may go on touching. Compares them all.
bool sameBody(const scene::World& one, const scene::World& other);

}  // namespace palpate::engine
