// From a signed distance to a finished mesh: a triangle surface that is closed and manifold for any shape, its
// triangles evened out, and its mirror image.
//
// Bones and hand are made with it: signed_distance.h -> here -> mesh/decimate.h -> bones.h, hand.h.
#pragma once

#include <functional>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// Signed distance at a point, millimetre, negative inside.
using Field = std::function<double(const Vec3&)>;

struct MesherSettings {
  Vec3 low = Vec3::Zero();   ///< a corner of the box that is searched; lattice points start exactly here
  Vec3 high = Vec3::Zero();  ///< the opposite corner, rounded up to whole cells
  double cell_mm = 1.4;      ///< edge of a lattice cube; features thinner than this are lost
  /// Largest change of the field per millimetre. Blocks farther from the surface than this allows are never visited;
  /// too small a value can only lose a separate piece, never open a hole, because the surface is followed.
  double steepest = 1.6;
};

/// The zero surface of the field inside the box, oriented outwards (towards positive values), vertices on lattice
/// edges, order deterministic. Closed where the surface stays inside the box; where it meets a face of the box it ends
/// there with vertices exactly on the face.
mesh::TriangleMesh meshZeroSurface(const Field& field, const MesherSettings& settings);

/// Moves every vertex towards the middle of its neighbours along the surface and back onto the zero of the field,
/// `rounds` times: the lattice's slivers and the steps they draw along round edges disappear. Vertices with x == 0
/// exactly stay in that plane, as the border of a half that will be mirrored must.
void relaxOnSurface(mesh::TriangleMesh& mesh, const Field& field, int rounds);
/// Both: the zero of the field, relaxed on it.
mesh::TriangleMesh relaxedZeroSurface(const Field& field, const MesherSettings& settings, int rounds);

/// The same of a shape that has a distance(point).
template <class Shape>
mesh::TriangleMesh relaxedSurface(const Shape& shape, const MesherSettings& settings, int rounds) {
  return relaxedZeroSurface([&](const Vec3& p) { return shape.distance(p); }, settings, rounds);
}

/// The mesh with its points where the frame puts them.
mesh::TriangleMesh inFrame(const Eigen::Isometry3d& frame, mesh::TriangleMesh mesh);

/// The mirror image at x = 0.
inline Vec3 mirrored(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }
/// The same mesh with x negated and the winding turned, so that it still faces outwards.
mesh::TriangleMesh mirrored(mesh::TriangleMesh mesh);

/// The half x >= 0 and its mirror image, joined along the vertices with x == 0 exactly. Closed when the half is closed
/// except for a border in that plane.
mesh::TriangleMesh withMirrorImage(mesh::TriangleMesh half);

}  // namespace palpate::body
