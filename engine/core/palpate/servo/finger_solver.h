// The surface that a finger of a rig touches, and the search on it: over the whole surface, or through a haptic
// detecting box.
//
//   contact::Surface ────────────────────────► contact::step ─┐
//   hdb::Partition ─► HdbSurface ─► box ─────► hdb::stepHdb ──┴─► ContactSource::step ─► touch (the tick's one line)
//   body::BreathField ─► the tip taken back to the skin at rest, what was felt taken to the skin as it is
//   LumpLoop ─► where the lumps lie that move
//
// A finger sees nothing else of a world. A rebuilt world is made outside the loop, solvers included with the room for
// their lists, and exchanged between two ticks; the objects that the tick releases are freed on another thread.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/body/trunk/breathing.h"
#include "palpate/contact/nearby_skin.h"
#include "palpate/hdb/hdb_finger.h"
#include "palpate/servo/lump_loop.h"

namespace palpate::servo {

/// The force of the last tick, which the first ticks on an exchanged surface start from: a skin five times as stiff
/// under a finger that is 15 mm deep would be 30 N more from one tick to the next.
struct Handover {
  bool follows = true;           ///< false only while a recording from before this is felt again
  bool on = false;               ///< the surface was exchanged, and the force has not yet reached the new one's
  Vec3 force = Vec3::Zero();     ///< force in the last tick, N
  Vec3 tip = Vec3::Zero();       ///< tip in the last tick, mm
  double secant_n_per_mm = 0.0;  ///< force over depth in the last tick that touched
};

/// How a finger looks for the skin, chosen when the world is built: the tick calls `step` and asks for no kind.
struct ContactSource {
  using Step = contact::FingerOutput(ContactSource&, const contact::FingerSettings&, contact::FingerState&,
                                     const Vec3& tip, const contact::LumpPlaces*) noexcept;
  static Step onSkin;  ///< walks on the whole surface
  static Step inBox;   ///< sees what the box holds

  Step* step = onSkin;
  const contact::Surface* surface = nullptr;            ///< must outlive it
  std::unique_ptr<contact::FingerSkin> skin = nullptr;  ///< triangles near a sphere; null: the tree is queried
  std::optional<hdb::HdbCandidates> box = {};           ///< for inBox
};

struct FingerSolver {
  ContactSource source;
  std::optional<body::BreathField> breath;  ///< motion of the surface; none: it does not move
  Handover handover = {};
  std::shared_ptr<LumpLoop> lumps = nullptr;  ///< shared by the rig's fingers; null: no lump of the surface moves
  std::size_t finger = 0;                     ///< its number in the rig
};

/// One for each finger of a rig, in its order.
using FingerSolvers = std::vector<FingerSolver>;

/// `box` may be null; otherwise it was made for this surface. Fingers made together feel each other through lumps that
/// move, and belong to one thread then. Allocates.
FingerSolvers makeSolvers(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                          std::size_t fingers, const std::optional<body::BreathField>& breath = {});

/// Tick number `tick` of one finger; it counts where the surface moves with time. The state knows the surface at rest;
/// the output is for the present surface. No allocation, lock or exception.
contact::FingerOutput touch(FingerSolver& solver, const contact::FingerSettings& settings, contact::FingerState& state,
                            const Vec3& tip, std::uint64_t tick = 0) noexcept;

/// The finger is put elsewhere, and forgets what it touched.
void lift(FingerSolver& solver, contact::FingerState& state) noexcept;

/// The output on a surface that has moved by this lift, as it would have been at rest: for the deformation.
contact::FingerOutput atRest(const body::BreathField& breath, contact::FingerOutput felt, double lift_mm) noexcept;

/// Swaps what a finger touches, between two ticks. Its memory stays when it looks for the skin as before (the body is
/// up to the caller: for another one give it a new state), and starts again otherwise. The force goes from the one to
/// the other as fast as the bound on steps allows, k (3 |dD| + c) (docs/explanation/contact.md). Nothing is allocated
/// or freed.
void exchange(FingerSolver& at_work, FingerSolver& next, contact::FingerState& state) noexcept;

}  // namespace palpate::servo
