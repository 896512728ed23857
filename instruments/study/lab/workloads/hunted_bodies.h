// The bodies of `palpate study hunt`: what comes out of a generator and what users' files look like, one after the
// other.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/body/tetrahedra_mesher.h"
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

// Random embedded bodies with parts that are hard to feel: pockets, crevices, limbs, thin plates, horns, walls,
// tunnels.
//
// Each shape is a signed distance, a union of primitives with others cut out, whose zero surface is meshed: closed and
// manifold whatever the random numbers are, and free of self-intersections but for a few whose flat triangles at a
// sharp edge repair mends. About 50 to 250 mm long.

/// Names of the shapes, in an order that stays.
std::vector<std::string> huntedShapeNames();

/// One of that shape, all its measures from `random`: 1,000 to 40,000 triangles. Throws Error for another name.
mesh::TriangleMesh huntedShape(std::string_view name, Random& random);

// The signed distances of the shapes, before they are meshed.

/// A distance, the half edge of the cube that holds it, and the lattice cell that its thinnest part needs.
struct HuntedForm {
  body::Field field;
  double reach_mm;
  double cell_mm;
};

struct NamedForm {
  const char* name;
  HuntedForm (*make)(Random& random);  ///< all its measures are random
};

inline constexpr std::size_t kHuntedForms = 26;
const std::array<NamedForm, kHuntedForms>& huntedForms();

}  // namespace palpate::lab
