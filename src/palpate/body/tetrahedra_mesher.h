// Turns a signed distance into a triangle surface that is closed and manifold whatever the shape.
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

}  // namespace palpate::body
