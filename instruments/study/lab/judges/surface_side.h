// On which side of a surface a point is, decided without any code of the contact module: an oracle must not share the
// finger's mistakes.
//
// Three kinds of surface, three methods:
//   height field  every triangle faces +z and there is a border: the height of the triangles over (x, y)
//   closed        every edge has two triangles of opposite direction: the generalized winding number, summed exactly
//   open          anything else: the sign of the pseudo-normal at the nearest surface point, unknown at a border
//
// Based on: Van Oosterom and Strackee, "The solid angle of a plane triangle" (1983); Jacobson, Kavan, Sorkine-Hornung,
// "Robust inside-outside segmentation using generalized winding numbers" (2013); Baerentzen and Aanaes, "Signed
// distance computation using the angle weighted pseudonormal" (2005).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

enum class SurfaceKind { height_field, closed, open };

enum class Side { outside, on_surface, inside, unknown };

/// The surface point nearest to a query.
struct NearestPoint {
  Vec3 point = Vec3::Zero();
  double distance = 0.0;
  Index triangle = kNoIndex;
  Vec3 pseudo_normal = Vec3::Zero();  ///< unit, towards the outside
  bool on_border = false;             ///< on an edge or vertex of the border
};

/// How often the surface winds round the point: 1 inside a closed body, 0 outside. O(triangles).
double windingNumber(const mesh::TriangleMesh& mesh, const Vec3& point);

/// The point of a triangle nearest to `point`.
Vec3 nearestOnTriangle(const std::array<Vec3, 3>& corners, const Vec3& point);

/// Copies the mesh. The nearest-point tree is built on first use.
class SurfaceSide {
 public:
  explicit SurfaceSide(mesh::TriangleMesh mesh);

  SurfaceKind kind() const { return kind_; }
  double diagonal() const { return diagonal_; }
  /// Points nearer than this to the surface count as on it: rounding of this oracle, 1e-9 of the box's diagonal.
  double tolerance() const { return 1e-9 * diagonal_; }
  const mesh::TriangleMesh& mesh() const { return mesh_; }

  /// Unknown beyond the border, and nearer to the border than the point is deep plus `reach`: there a finger may have
  /// been released sideways (a sphere leaves a border up to 2 radii earlier than a point). Not for several threads at
  /// once: it remembers the last answer.
  Side sideOf(const Vec3& point, double reach = 0.0);

  /// Height field only: z of the highest triangle over (x, y), nothing beyond the border.
  std::optional<double> heightAt(double x, double y) const;

  NearestPoint nearestTo(const Vec3& point);

  /// Infinite without a border; seen from +z for a height field.
  double distanceToBorder(const Vec3& point) const;

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    Index first = 0, count = 0;  ///< triangles of a leaf in `order_`; count 0 for an inner box
    Index right = 0;             ///< second child; the first is the next box
  };
  void buildGrid();
  void buildTree();
  Index buildBox(Index first, Index last, const std::vector<Vec3>& centres);
  void searchBox(Index box, const Vec3& point, NearestPoint& best, Vec3& barycentric) const;
  void describeFeature(const Vec3& barycentric, NearestPoint& nearest) const;
  Vec3 vertexPseudoNormal(Index vertex) const;
  Side sideOverHeightField(const Vec3& point, double reach) const;
  std::array<Vec3, 3> corners(Index triangle) const;

  mesh::TriangleMesh mesh_;
  SurfaceKind kind_ = SurfaceKind::open;
  double diagonal_ = 0.0;
  std::vector<std::array<Index, 3>> neighbours_;
  mesh::IndexRows triangles_of_vertices_;
  std::vector<std::array<Index, 2>> border_edges_;
  std::vector<bool> on_border_;  ///< per vertex
  std::vector<Box> boxes_;
  std::vector<Index> order_;
  // Height field: triangles whose box in the plane overlaps each cell of a regular grid.
  std::array<std::size_t, 2> cells_{};
  Vec2 cell_size_ = Vec2::Zero(), grid_origin_ = Vec2::Zero();
  mesh::IndexRows grid_;
  // A ball without surface inside: any point in it is on the side of its centre.
  Vec3 clear_centre_ = Vec3::Zero();
  double clear_radius_ = 0.0;
  Side clear_side_ = Side::unknown;
};

}  // namespace palpate::lab
