// Cracks that no finger can enter: skin that faces skin across less air than kCrackMm, of parts beside each other or of
// one fold. Repair joins what is nearer still (mesh/hairline_gaps.h) where it fits vertex by vertex.
//
// To a point such a crack would be a needle: its proxy would slide down the hidden wall, and be held there by as much
// as it is deep. So a point does not walk into a crack. From the rim it goes on to the other bank where that is nearer
// to the tip, and a tip that comes down into a crack is held by the rim. A finger with a radius rests on both rims
// anyway.
//
// Bodies without cracks pay nothing. Beside one a step costs some searches within kCrackMm: 1 us each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Air up to here is a crack: the 0.2 mm that a fingertip's skin bridges, and a quarter for walls that are not
/// parallel.
inline constexpr double kCrackMm = 0.25;
/// The same as a share of the diagonal, for bodies smaller than 100 mm and in other units.
inline constexpr double kCrackShare = 2.5e-3;

/// The width up to which air is a crack in this body, mm.
double crackWidth(const SurfaceGeometry& geometry) noexcept;

/// Per record: 1 where the triangle faces skin across a crack, at least in part, or ends beside another border. Empty
/// where none does. Left out are pits of less than 2 mm and what hangs together with sheets that pierce each other.
/// Needs the tree, vertex_on_border and `entangled`. About 0.1 us a triangle, on all processors.
std::vector<std::uint8_t> findCracked(const Surface& surface);

/// For a note.
struct NarrowCracks {
  std::size_t count = 0;
  Vec3 at = Vec3::Zero();  ///< in the middle of the one with the largest walls, mm
};
NarrowCracks countCracks(const SurfaceGeometry& geometry);

/// Whether a place on a triangle faces skin across a crack. Quick where the triangle does nowhere.
bool isInCrack(const SurfaceGeometry& geometry, Index triangle, const Vec3& place) noexcept;

/// The place beyond the crack at whose rim, or beyond the border at which, a proxy stands, if that is nearer to the
/// tip.
std::optional<SurfacePoint> otherBank(const Surface& surface, const SurfacePoint& rim, const Vec3& tip) noexcept;

/// The normal of the skin at the rim of a crack without what is in the crack there; unit.
Vec3 bankNormal(const Surface& surface, const SurfacePoint& rim) noexcept;

/// The rim that holds a tip which came into a crack in this tick, if it did. `entry`: where it passed the skin, if so.
std::optional<SurfacePoint> findCrossedRim(const Surface& surface, const Vec3& from, const Vec3& tip,
                                           const tree::Crossing& entry) noexcept;

}  // namespace palpate::contact
