// A point that follows the tip but never passes the front of a triangle: the god object over a loose list of triangles.
//
// It knows no neighbours: every move is tested against every listed triangle, as a toolkit must that is handed
// triangles without their neighbours. hdb_finger.h uses it where a walk over the skin (contact/surface_walk.h) ends.
#pragma once

#include <span>

#include "palpate/contact/surface.h"

namespace palpate::hdb {

/// How a god object ended its tick.
enum class Arrival : std::uint8_t {
  reached,   ///< it is at the target: nothing is between them
  resting,   ///< on the skin, nearer to the target than any place it could go to
  under_way  ///< its path was used up
};

/// Distance that is kept from every plane, mm: a million times what rounding could take away, and a thousandth of what
/// could be felt. What keeps the object outside is not this but the exact test of every move.
inline double standoff(const contact::Surface& surface) { return 1e-9 * surface.geometry->tree.diagonal; }

/// Moves `place` towards `target`, at most `path_mm` far, along straight pieces none of which passes a listed triangle
/// (records of the tree) from front to back. Slides along one, two or three planes at a time. noexcept, no allocation.
Arrival moveTowards(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& target,
                    double path_mm, Vec3& place) noexcept;

/// Whether `place` is in front of each listed triangle that it touches.
bool isInFront(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& place) noexcept;

/// Where the segment first passes a listed triangle from front to back (exactly), or triangle kNoIndex.
tree::Crossing firstFrontCrossing(const contact::Surface& surface, std::span<const Index> triangles, const Vec3& from,
                                  const Vec3& to) noexcept;

}  // namespace palpate::hdb
