// The deformation once more, vertex by vertex in double, straight from its definition: what the kernels and the block
// search are judged by.
#pragma once

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "palpate/deform/deformer.h"
#include "palpate/tissue/profile.h"

namespace palpate::test {

using namespace deform;

inline Vec3 restPoint(const Skin& skin, Index v) { return skin.restPosition(v).cast<double>(); }

/// q of a vertex in an ellipse whose plane is across `normal` and whose axes are turned into it. Higher or lower than
/// 130 mm, or than a shorter half major axis, it grows as in an ellipsoid.
inline double ellipseRatio(const maps::SurfaceEllipse& ellipse, const Vec3& normal, const Vec3& offset) {
  const Vec3 n = normal.normalized();
  const Vec3 in_plane = ellipse.half_major - ellipse.half_major.dot(n) * n;
  const maps::SurfaceEllipse turned{in_plane.normalized() * ellipse.half_major.norm(), ellipse.aspect};
  const double flat = maps::locationRatio(turned, offset - offset.dot(n) * n);
  const double half_major = ellipse.half_major.norm();
  const double beyond = std::max(0.0, std::abs(offset.dot(n)) - std::min(half_major, 130.0));
  return std::hypot(flat, beyond / (half_major * ellipse.aspect));
}

struct ScalarContact {
  Contact contact;
  double depth;  // capped
  Vec3 drag;     // capped
  double normalRatio(const Vec3& p) const {
    return depth > 0.0 ? ellipseRatio(contact.normal_region, contact.normal, p - contact.anchor) : INFINITY;
  }
  double tangentialRatio(const Vec3& p) const {
    return drag.norm() > 0.0 ? ellipseRatio(contact.tangential_region, contact.normal, p - contact.anchor) : INFINITY;
  }
};

inline ScalarContact scalarContact(const Contact& contact, const TissueSettings& tissue = {}) {
  return {contact, cappedDepth(contact.depth_mm, tissue.normal_cap_mm),
          cappedLength(tissue.f_adj * contact.drag_mm, tissue.tangential_cap_mm)};
}

/// The region by plain search: corners of the anchor's triangle count as reached, then edge by edge.
inline std::vector<bool> regionByRings(const Skin& skin, const ScalarContact& contact) {
  const auto belongs = [&](Index v) {
    const bool faces = skin.restNormal(v).cast<double>().dot(contact.contact.normal.normalized()) > 0.0;
    const Vec3 p = restPoint(skin, v);
    return faces && (contact.normalRatio(p) < 1.0 || contact.tangentialRatio(p) < 1.0);
  };
  std::vector<bool> inside(skin.vertices, false);
  std::vector<bool> seen(skin.vertices, false);
  std::queue<Index> open;
  for (const Index corner : skin.triangles[contact.contact.anchor_triangle]) {
    inside[corner] = belongs(corner);
    seen[corner] = true;
    open.push(corner);
  }
  while (!open.empty()) {
    const Index v = open.front();
    open.pop();
    for (const Index w : skin.neighbours[v]) {
      if (seen[w] || !belongs(w)) continue;
      seen[w] = inside[w] = true;
      open.push(w);
    }
  }
  return inside;
}

/// What one contact alone does to each vertex.
inline std::vector<Vec3> displacementsOf(const Skin& skin, const ScalarContact& contact) {
  const auto inside = regionByRings(skin, contact);
  std::vector<Vec3> moved(skin.vertices, Vec3::Zero());
  for (Index v = 0; v < skin.vertices; ++v) {
    if (!inside[v]) continue;
    const Vec3 p = restPoint(skin, v);
    moved[v] = -tissue::profile(contact.normalRatio(p)) * contact.depth * contact.contact.normal.normalized() +
               tissue::profile(contact.tangentialRatio(p)) * contact.drag;
  }
  return moved;
}

}  // namespace palpate::test
