// Lumps under the skin as a finger feels them: what each adds to the force of a press, and where those that are not
// fixed lie.
//
//   World ─ Lumps (immutable) ─┬─► lumpPush, in the tick after force law and friction ─► FingerOutput::force
//   a loop ─ LumpPlaces ───────┘         └─► LumpPress of each finger ─ moveLumps, once a tick ─► LumpPlaces
//
// A lump is an energy U(rho, d) of the tip's distance from its axis and of the depth of the press
// (tissue/lump_energy.h). Its force is minus the gradient: dU/dd along the normal of the contact and -dU/drho away from
// the axis, so closed paths cost nothing. The depth is the one that the force law counts; the distance is the tip's and
// not the proxy's, in the plane that touches the skin over the lump.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"
#include "palpate/tissue/lump_energy.h"

namespace palpate::contact {

/// Most lumps of a body: more than anybody is examined with, and few enough that all of them cost a microsecond.
inline constexpr std::size_t kMaxLumps = 64;

/// How a lump moves sideways in its plane. Not judged by finite elements; friction and drag are assumed.
struct LumpMobility {
  double spring_n_per_mm = 0.0;    ///< k_m, holds it to its place; 0: it is fixed
  double friction_n = 0.05;        ///< f_c, dry
  double drag_n_s_per_mm = 0.002;  ///< c, at least; more where the lump is steep (moveLumps)
  double limit_mm = 10.0;          ///< it moves no farther from its place
  bool moves() const noexcept { return spring_n_per_mm > 0.0; }
};

struct Lump {
  Vec3 foot = Vec3::Zero();      ///< on the skin at rest, over its middle
  Vec3 axis = Vec3::UnitZ();     ///< unit, out of the skin there
  Vec3 across = Vec3::UnitX();   ///< unit, of the plane it moves in
  Vec3 up = Vec3::UnitY();       ///< unit, towards the head; across, up and axis are right-handed
  tissue::LumpEnergy energy;     ///< for the stiffness of its place
  tissue::LumpShape shape = {};  ///< for the pattern of pressure
  double skin_mm = 2.0;          ///< thickness of the skin's layer over it
  LumpMobility mobility = {};
};

/// The plane that touches the skin at a foot: `across` and `up` of a lump with this axis.
void setPlane(Lump& lump) noexcept;

/// All of a body. Immutable; shared by every surface of it and by any number of fingers.
struct Lumps {
  std::vector<Lump> all;  ///< at most kMaxLumps
  bool anyMoves() const noexcept;
};

/// How far each lump of a loop has moved from its place, mm across and up. Plain data.
struct LumpPlaces {
  std::array<Vec2, kMaxLumps> moved_mm;
  LumpPlaces() { moved_mm.fill(Vec2::Zero()); }
};

/// The force that lumps add to a press.
struct LumpPush {
  double normal_n = 0.0;            ///< along the normal of the contact; negative over softer lumps
  Vec3 lateral_n = Vec3::Zero();    ///< sum of -dU/drho, each away from its lump's axis
  Index nearest_moving = kNoIndex;  ///< of Lumps::all: the mobile lump nearest to the tip that it feels; or none
};

/// The tip's place in the lump's plane, from where the lump lies now; mm across and up.
Vec2 fromLump(const Lump& lump, const Vec2& moved_mm, const Vec3& tip) noexcept;

/// The push on the whole press; its share is ignored. `places` may be null: all lumps are where the world has them. No
/// allocation; some 50 ns for a lump within reach and 5 for another.
LumpPush lumpPush(const Lumps& lumps, const LumpPlaces* places, const LumpPress& press) noexcept;

/// The normal force that one lump adds to that press, N.
double normalPush(const Lump& lump, const Vec2& moved_mm, const LumpPress& press) noexcept;

/// Energy that the fingers' presses, by their shares, and the springs of mobile lumps store, N mm; for those who judge.
double lumpEnergy(const Lumps& lumps, const LumpPlaces& places, std::span<const LumpPress> presses) noexcept;

/// Lets every mobile lump give way to the fingers, as they pressed in their last tick, for one tick. Each goes downhill
/// in the energy of all of them and of its spring, held up by dry friction and drag, and at most half a millimetre. The
/// drag over a tick is at least ten times the steepest slope of the lump's push, so a step never makes energy, also
/// between two fingers. No allocation.
void moveLumps(const Lumps& lumps, std::span<const LumpPress> presses, double tick_s, LumpPlaces& places) noexcept;

}  // namespace palpate::contact
