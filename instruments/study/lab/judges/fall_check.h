// Did the finger fall through the skin, and did it feel the skin at once? Checked from tips and forces alone.
//
// A proxy of radius 0 is on the skin and so cannot show a fall; what can really fall is a *free* tip. So every tick
// without contact is checked for the side of its tip, and a tip that is inside although it came from outside, or was
// held a tick before, has fallen. A tip of unknown past (from beyond a border, released near one, or inside from the
// start) is ignored until it has been outside.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lab/judges/surface_side.h"

namespace palpate::lab {

/// The data of one tick that a check may use.
struct Observation {
  Vec3 tip = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< centre of the drawn sphere (proxy + radius * normal); only read for radius > 0
  bool touching = false;       ///< the finger reports contact
  bool has_force = false;
};

struct FallReport {
  std::size_t ticks = 0;                      ///< ticks with a free tip inside
  std::size_t events = 0;                     ///< times that began
  std::optional<std::size_t> first_tick;      ///< index of the first of them
  std::size_t first_contacts = 0;             ///< entries of the tip from outside to inside
  std::size_t first_contact_delay_ticks = 0;  ///< worst wait from the tick of the entry to the first force
};

/// Ticks in their order, of one finger with that radius.
FallReport checkFalls(SurfaceSide& surface, std::span<const Observation> ticks, double radius = 0.0);

struct SphereReport {
  std::size_t infeasible_ticks = 0;  ///< touching, yet the centre is nearer than 0.999 r to a front side
  std::size_t missed_ticks = 0;      ///< free, yet the tip is nearer than 0.999 r to a front side
  double least_distance = 1.0;       ///< smallest distance of the centre to the mesh, in r
};

/// For a finger of radius > 0: is the drawn sphere outside the body, and is every contact found? Points next to a
/// border are left out.
SphereReport checkSphere(SurfaceSide& surface, std::span<const Observation> ticks, double radius);

}  // namespace palpate::lab
