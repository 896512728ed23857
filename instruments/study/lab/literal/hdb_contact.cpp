// No list is kept from tick to tick. Leaves come from the museum's own search, with its correction (E5).
// Based on: Ji, dissertation 2008, 3.3; Sunday (2003), see hdb_contact.h.
#include "lab/literal/hdb_contact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/literal/triangle_tests.h"

namespace palpate::bench::literal {

namespace {

constexpr Index kLeafThreshold = 1024;

const Vec3& cornerPosition(const Mesh& mesh, const Triangle& triangle, int corner) {
  return mesh.vertices[static_cast<std::size_t>(triangle.corners[corner])].position;
}

template <class Visit>
void visitLeaves(HdbContact& contact, const Box3& box, Visit&& visit) {
  findLeaves(contact.tree, box, contact.leaves);
  for (const Index leaf : contact.leaves.leaves) {
    for (const Index t : trianglesOf(contact.tree, contact.tree.nodes[leaf])) visit(t, contact.mesh.triangles[t]);
  }
}

/// Intersects with the plane first, then checks the place's parametric coordinates (Sunday).
bool crosses(const Mesh& mesh, const Triangle& triangle, const Vec3& from, const Vec3& to) {
  const Vec3& corner = cornerPosition(mesh, triangle, 0);
  const Vec3 u = cornerPosition(mesh, triangle, 1) - corner;
  const Vec3 v = cornerPosition(mesh, triangle, 2) - corner;
  const Vec3 normal = u.cross(v);
  const double along = normal.dot(to - from);
  const double fraction = normal.dot(corner - from) / along;
  if (!(fraction >= 0.0 && fraction <= 1.0)) return false;  // also without area, or parallel
  const Vec3 w = from + fraction * (to - from) - corner;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double determinant = uv * uv - uu * vv;
  const double s = (uv * wv - vv * wu) / determinant;
  const double t = (uv * wu - uu * wv) / determinant;
  return s >= 0.0 && t >= 0.0 && s + t <= 1.0;
}

}  // namespace

HdbContact buildHdbContact(const mesh::TriangleMesh& mesh) {
  HdbContact contact;
  contact.mesh = buildMesh(mesh);
  contact.tree = hdb::buildPartition(mesh, {.tree = hdb::TreeKind::Bsp, .threshold = kLeafThreshold});
  contact.edge_mm = hdb::hdbEdges(contact.tree.bounds).x();
  contact.leaves.prepareFor(contact.tree);
  return contact;
}

double nearestInLeaves(HdbContact& contact, const Vec3& centre, const Vec3& point, double reach) {
  double nearest = reach * reach;
  visitLeaves(contact, hdb::hapticBox(centre, contact.edge_mm), [&](Index, const Triangle& triangle) {
    nearest = std::min(nearest, squaredDistance<double>(point, cornerPosition(contact.mesh, triangle, 0),
                                                        cornerPosition(contact.mesh, triangle, 1),
                                                        cornerPosition(contact.mesh, triangle, 2)));
  });
  return nearest < reach * reach ? std::sqrt(nearest) : std::numeric_limits<double>::infinity();
}

bool crossesInLeaves(HdbContact& contact, const Vec3& centre, const Vec3& from, const Vec3& to) {
  bool found = false;
  visitLeaves(contact, hdb::hapticBox(centre, contact.edge_mm),
              [&](Index, const Triangle& triangle) { found |= crosses(contact.mesh, triangle, from, to); });
  return found;
}

void trianglesInLeaves(HdbContact& contact, const Box3& box, std::vector<Index>& found) {
  found.clear();
  visitLeaves(contact, box, [&](Index index, const Triangle& triangle) {
    Box3 own(cornerPosition(contact.mesh, triangle, 0));
    own.extend(cornerPosition(contact.mesh, triangle, 1)).extend(cornerPosition(contact.mesh, triangle, 2));
    if (own.intersects(box)) found.push_back(index);
  });
}

}  // namespace palpate::bench::literal
