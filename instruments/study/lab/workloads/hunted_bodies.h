// The bodies of `palpate study hunt`: what comes out of a generator and what users' files look like, one after the
// other.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// Kinds of bodies, in the order of the hunt: sound shapes (hunted_shapes.cpp), slivers, coarse and noisy ones,
/// self-intersecting unions, torn and doubled ones, open sheets.
std::vector<std::string> huntedBodyKinds();

/// A body of that kind, as a user's file would hold it: repair comes later. In mm, 50 to 300 mm long. The same for the
/// same seed. Throws Error for another kind.
mesh::TriangleMesh huntedBody(std::string_view kind, std::uint64_t seed);

// Damage to a sound mesh on its way to a user: squeezed, split into slivers, shaken, torn, doubled, glued together.

/// Every length along one direction times `factor`: triangles become slivers, the body a leaf.
void squeeze(mesh::TriangleMesh& mesh, const Vec3& direction, double factor);

/// Splits random edges near one end, `share` of as many edges as there are triangles: slivers, and a closed mesh stays
/// closed, every point of the surface where it was.
void splitIntoSlivers(mesh::TriangleMesh& mesh, double share, Random& random);

/// Moves every vertex by a normal deviate of `size_mm`.
void shake(mesh::TriangleMesh& mesh, double size_mm, Random& random);

/// Takes out `count` random triangles.
void pierce(mesh::TriangleMesh& mesh, std::size_t count, Random& random);

/// Cuts along random chains of edges and moves one side off by `gap_mm`: slits of almost no width.
void slit(mesh::TriangleMesh& mesh, std::size_t cuts, double gap_mm, Random& random);

/// Gives `count` random triangles again, some of them as often as thrice and some the other way round.
void repeatTriangles(mesh::TriangleMesh& mesh, std::size_t count, Random& random);

/// Turned at random about the origin, and moved.
void place(mesh::TriangleMesh& mesh, const Vec3& at, Random& random);

}  // namespace palpate::lab
