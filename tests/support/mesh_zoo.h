// Small meshes by trait: what a stranger's file may hold, each as small as the trait allows.
//
// Closed ones are wound counter-clockwise seen from outside; open ones face +z. Lengths in millimetre.
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::zoo {

// --- sound meshes ---

/// Axis-aligned cube from `low_corner`, 12 triangles, closed.
mesh::TriangleMesh cube(double edge_mm = 10.0, const Vec3& low_corner = Vec3::Zero());
/// Icosahedron refined `levels` times, vertices on the sphere: 20 * 4^levels triangles, closed.
mesh::TriangleMesh sphere(double radius_mm = 20.0, int levels = 3, const Vec3& centre = Vec3::Zero());
/// Closed, genus 1, around z: 2 * around * across triangles.
mesh::TriangleMesh torus(double ring_radius_mm = 20.0, double tube_radius_mm = 6.0, int around = 32, int across = 16);
/// Flat square sheet z = 0 of cells x cells squares, corner at the origin, facing +z: 2 * cells^2 triangles, open.
mesh::TriangleMesh grid(int cells = 8, double edge_mm = 100.0);
/// The grid with hills: z = amplitude * sin * sin, two waves each way.
mesh::TriangleMesh wavyGrid(int cells = 32, double edge_mm = 100.0, double amplitude_mm = 5.0);
/// A dome of 20 x 20 square cells from `low_corner`, facing +z: z = top - 0.001 r^2 of the distance r to the origin.
mesh::TriangleMesh dome(const Vec2& low_corner, double cell_mm, double top_mm);
/// Closed square box, low and wide: a plate between z = 0 and z = thickness.
mesh::TriangleMesh plate(double edge_mm = 50.0, double thickness_mm = 2.0);
/// One triangle in z = 0, facing +z.
mesh::TriangleMesh oneTriangle();
/// Closed tube bent to a ring, cut open: two boundary loops.
mesh::TriangleMesh openTube(double radius_mm = 10.0, double length_mm = 40.0, int around = 24, int along = 8);

// --- meshes with a trait that repair must deal with ---

/// Two cubes that share one edge: 4 triangles meet there.
mesh::TriangleMesh cubesSharingAnEdge();
/// Two cubes that share one corner vertex.
mesh::TriangleMesh cubesSharingAVertex();
/// Three half-planes that meet in one edge, like pages of an open book.
mesh::TriangleMesh book();
/// A one-sided strip of `around` squares.
mesh::TriangleMesh moebius(int around = 24, double radius_mm = 20.0, double width_mm = 10.0);
/// A Klein bottle (figure-8 immersion): closed, one-sided, meets itself.
mesh::TriangleMesh kleinBottle(int around = 32, int across = 16);
/// The cube with a zero-height triangle in the middle of its top: a corner that lies on the opposite edge.
mesh::TriangleMesh cubeWithCap();
/// The cube with one edge of zero length, so that two triangles have no area.
mesh::TriangleMesh cubeWithNeedles();
/// The 5-triangle plate whose middle sliver (height 1e-13 mm) is folded over: its normal points back.
mesh::TriangleMesh plateWithFoldedSliver();
/// The cube with a sheet of no thickness (the same triangles from both sides) standing on its top.
mesh::TriangleMesh cubeWithFin();
/// A flat grid given from both sides: every triangle has an opposite twin.
mesh::TriangleMesh doubleSidedGrid(int cells = 4);
/// The cube with three of its triangles given twice, with the same winding.
mesh::TriangleMesh cubeWithDuplicates();
/// Two triangles with equal corners at different vertices.
mesh::TriangleMesh coincidentTriangles();
/// The cube whose triangles share no vertices: 36 vertices, as a binary STL holds it.
mesh::TriangleMesh soup(const mesh::TriangleMesh& mesh);
/// Two spheres (radius 20) 25 mm apart along x, not united: they pierce each other.
mesh::TriangleMesh overlappingSpheres(int levels = 3);
/// A sphere in a larger one, the inner facing inwards: a solid with a hollow.
mesh::TriangleMesh hollowSphere(int levels = 2);
/// The sphere with every third triangle wound the wrong way.
mesh::TriangleMesh mixedWinding();
/// The sphere turned inside out.
mesh::TriangleMesh insideOut();
/// The cube with three vertices more that nothing uses.
mesh::TriangleMesh cubeWithUnusedVertices();
/// The cube with a vertex of NaN and one of infinity, each used by one extra triangle.
mesh::TriangleMesh cubeWithNonFiniteVertices();
/// The cube with an extra triangle that names vertices which do not exist.
mesh::TriangleMesh cubeWithWrongIndices();
/// No vertex, no triangle.
mesh::TriangleMesh empty();

/// Every triangle wound the other way.
mesh::TriangleMesh flipped(mesh::TriangleMesh mesh);
/// Both in one mesh, nothing welded.
mesh::TriangleMesh joined(mesh::TriangleMesh first, const mesh::TriangleMesh& second);

struct Specimen {
  std::string name;
  mesh::TriangleMesh mesh;
};

/// All of the above but `empty` and those without a single sound triangle; for tests of "whatever comes in".
std::vector<Specimen> specimens();

/// The sheet of `grid` with at least `triangles` triangles and gentle hills, made quickly: for tests of size.
mesh::TriangleMesh hugeGrid(std::size_t triangles);

}  // namespace palpate::zoo
