// Follows the pseudocode of section 4.5 list by list; comments in quotes are its words. Equations are marked where they
// are used. Based on: Ji, dissertation 2008, chapter 4, see deformation.h.
#include "lab/literal/deformation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::bench::literal {

namespace {

/// (4.2) with y(0) = 1 reaches its "minimum" of 0.0021 there.
constexpr double kEndOfCurve = 1.4;
constexpr double kNormalCapMm = 10.0;      // (4.15)
constexpr double kTangentialCapMm = 20.0;  // (4.17)

/// (4.7) to (4.9): the node seen along the normal of the touch, relative to O.
Vec3 projected(const Vec3& node, const Touch& touch) {
  return node + touch.normal.dot(touch.anchor - node) * touch.normal - touch.anchor;
}

/// (4.13); 0/0 at O itself.
double locationRatio(const Vec3& od, const Touch& touch) {
  const double od2 = od.squaredNorm();
  if (od2 == 0.0) return 0.0;
  const double along = od.dot(touch.half_major_mm);
  const double t2 = touch.aspect * touch.aspect;
  return od2 / std::sqrt(along * along * (1.0 - t2) + od2 * touch.half_major_mm.squaredNorm() * t2);
}

Vec3 capped(const Vec3& drag) {
  const double length = drag.norm();
  return length > kTangentialCapMm ? Vec3(drag * (kTangentialCapMm / length)) : drag;
}

}  // namespace

Deformation::Deformation(const mesh::TriangleMesh& skin) : mesh_(buildMesh(skin)), rest_(skin.positions) {
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    const double x = kEndOfCurve * static_cast<double>(i) / static_cast<double>(curve_.size() - 1);
    curve_[i] = std::exp(-std::numbers::pi * x * x);  // (4.2), sigma^2 = 1 / (2 pi)
  }
}

void Deformation::apply(std::span<const Touch> touches) {
  restoreMoved();
  for (const Touch& touch : touches) searchNodesInEllipse(touch);
  recalculateNormals();
}

int Deformation::movedNodes() const {
  std::vector<int> nodes(moved_.begin(), moved_.end());  // a node of two regions is in it twice
  std::sort(nodes.begin(), nodes.end());
  return static_cast<int>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
}

void Deformation::restoreMoved() {
  for (const int node : moved_) vertex(node).position = rest(node);
  restored_.swap(moved_);
  moved_.clear();
}

/// SearchNodesInEllipse of section 4.5. "A new vertices list containing all the vertices is created, any vertex has
/// been assigned to the ring should be marked."
void Deformation::searchNodesInEllipse(const Touch& touch) {
  marked_.assign(mesh_.vertices.size(), 0);
  std::list<Ring> rings(1);
  for (const int corner : mesh_.triangles[static_cast<std::size_t>(touch.anchor_triangle)].corners) {
    marked_[static_cast<std::size_t>(corner)] = 1;
    rings.back().push_back(corner);
  }
  while (true) {
    bool any_inside = false;
    for (const int node : rings.back()) any_inside = deformNode(node, touch) || any_inside;
    if (!any_inside) return;
    rings.push_back(nextRing(rings.back()));
  }
}

Deformation::Ring Deformation::nextRing(const Ring& ring) {
  Ring next;
  for (const int node : ring) {
    for (const int neighbour : mesh_.vertices[static_cast<std::size_t>(node)].joint_vertices) {
      char& mark = marked_[static_cast<std::size_t>(neighbour)];
      if (mark != 0) continue;
      mark = 1;
      next.push_back(neighbour);
    }
  }
  return next;
}

/// Lines 5 to 9 of SearchNodesInEllipse; true if the node is in the ellipse.
bool Deformation::deformNode(int node, const Touch& touch) {
  const double q = locationRatio(projected(rest(node), touch), touch);
  if (!(q < 1.0)) return false;  // (4.14)
  const double share = curve_[static_cast<std::size_t>(std::lround(static_cast<double>(curve_.size() - 1) * q))];
  const double depth = std::clamp(touch.depth_mm, 0.0, kNormalCapMm);                     // (4.16)
  vertex(node).position += share * capped(touch.drag_mm) - share * depth * touch.normal;  // (4.3), (4.5)
  moved_.push_back(node);
  return true;
}

/// "If any triangle is changed, the normals of its vertices should be recalculated. A changed triangle list is created
/// dynamically to handle the normal recalculation."
void Deformation::recalculateNormals() {
  listed_.assign(mesh_.triangles.size(), 0);
  std::list<int> changed;
  collectTriangles(restored_, changed);
  collectTriangles(moved_, changed);
  for (const int t : changed) {
    Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
    triangle.normal = triangleNormal(mesh_, triangle);
  }
  marked_.assign(mesh_.vertices.size(), 0);
  for (const int t : changed) {
    for (const int corner : mesh_.triangles[static_cast<std::size_t>(t)].corners) {
      char& is_done = marked_[static_cast<std::size_t>(corner)];
      if (is_done != 0) continue;
      is_done = 1;
      vertex(corner).normal = averagedNormal(mesh_, vertex(corner));
    }
  }
}

void Deformation::collectTriangles(const std::list<int>& nodes, std::list<int>& changed) {
  for (const int node : nodes) {
    for (const int t : mesh_.vertices[static_cast<std::size_t>(node)].joint_triangles) {
      char& is_listed = listed_[static_cast<std::size_t>(t)];
      if (is_listed == 0) changed.push_back(t);
      is_listed = 1;
    }
  }
}

}  // namespace palpate::bench::literal
