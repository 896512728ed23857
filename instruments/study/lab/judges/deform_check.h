// Did only the skin around the finger move, and did it stay skin? Checked from the mesh at rest and where its vertices
// are now.
//
// Shares nothing with the deformation: it knows the contact's place, normal and how far its regions reach, and looks at
// every vertex and triangle. A vertex that moved must be connected with the contact along edges through vertices that
// moved too; it must not lie farther above or below the contact's plane than `farthest_off_plane_mm`; and no triangle
// may have turned over or vanished.
#pragma once

#include <cstddef>
#include <span>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// Where a finger is, and how far it may move skin.
struct TouchedPlace {
  Vec3 anchor = Vec3::Zero();
  Index triangle = kNoIndex;  ///< triangle under the anchor
  Vec3 normal = Vec3::UnitZ();
  double farthest_off_plane_mm = 0.0;
};

struct DeformReport {
  std::size_t moved = 0;         ///< vertices
  std::size_t unconnected = 0;   ///< moved, but not joined to any touched place through vertices that moved
  std::size_t off_plane = 0;     ///< moved, farther off the planes of all places than those allow
  std::size_t turned = 0;        ///< triangles: deformed normal against rest normal, or no area left
  std::size_t too_thin = 0;      ///< triangles that rounding to float may turn over: not checked
  double longest_tear_mm = 0.0;  ///< largest motion of an edge's ends apart, less its length
  bool isSound() const { return unconnected == 0 && off_plane == 0 && turned == 0; }
};

/// `positions` are those of the mesh's vertices now. A vertex has moved if it is not, to the last bit of a float, where
/// it was. O(vertices + triangles).
DeformReport checkDeformation(const mesh::TriangleMesh& rest, std::span<const Vec3f> positions,
                              std::span<const TouchedPlace> places);

}  // namespace palpate::lab
