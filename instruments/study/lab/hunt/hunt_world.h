// A body that is hunted on: a mesh as `palpate simulate` would build it, and the oracle's own view of the same.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "lab/judges/hunt_judge.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"

namespace palpate::lab {

/// Stiffness of every hunted body, everywhere, by Hooke's law: N per unit of length, whatever the unit.
inline constexpr double kHuntedStiffness = 0.5;

struct HuntWorld {
  contact::Surface surface;
  OracleBody body;
};

/// Repaired, put in spatial order, and built as scene::build does it. Throws Error when nothing can be felt.
HuntWorld buildHuntWorld(mesh::TriangleMesh mesh);

/// Puts `count` lumps under random places of the skin, every second one mobile; for bodies in mm. The same for the same
/// name of a body.
void putLumps(HuntWorld& world, std::string_view body, std::size_t count);

/// The finger of every hunt: default settings but its radius, in a world whose millimetre is `mm` units long.
contact::FingerSettings huntedFinger(double radius_mm, double mm);

/// Runs a new finger along the tips and checks it. Where there are lumps a second finger follows it, so that both press
/// on one lump.
HuntReport huntAlong(HuntWorld& world, const contact::FingerSettings& finger, std::span<const Vec3> tips);

}  // namespace palpate::lab
