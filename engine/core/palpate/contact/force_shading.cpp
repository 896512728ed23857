// Phong projection: D = P(v, w) - s N(v, w), P and N linear over a triangle, solved by Newton in the triangle and
// across its edges.
//
// The answer is continuous from facet to facet, so the false ridges of a coarse mesh of a smooth body disappear. It is
// not the nearest point, so the walk's proxy stays the state that keeps the finger from falling through; this is only
// felt.
//
// Based on: Kobbelt, Vorsatz, Seidel, "Multiresolution hierarchies on unstructured triangle meshes" (1999) for the
// projection along blended normals; Morgenbesser and Srinivasan (1996) for shading forces.
#include "palpate/contact/surface_walk.h"

#include <cmath>

namespace palpate::contact {

namespace {

constexpr int kMaxHops = 60;
constexpr int kMaxNewtonSteps = 8;
/// Barycentric: how far outside counts as on the edge, and when Newton has arrived.
constexpr double kOnEdge = 1e-9;
constexpr double kArrived = 1e-12;

struct Solution {
  double v = 1.0 / 3.0;
  double w = 1.0 / 3.0;
  double s = 0.0;
  bool found = false;
};

/// The triangle's corners and the normals at them, as functions of v and w.
struct Patch {
  Vec3 origin, along_v, along_w;
  Vec3 normal, normal_v, normal_w;
  Vec3 pointAt(double v, double w) const { return origin + v * along_v + w * along_w; }
  Vec3 normalAt(double v, double w) const { return normal + v * normal_v + w * normal_w; }
};

Patch makePatch(const Surface& surface, const tree::TriangleRecord& record) {
  const auto& [a, b, c] = record.corners;
  const Vec3& na = surface.geometry->vertex_normals[record.vertices[0]];
  const Vec3& nb = surface.geometry->vertex_normals[record.vertices[1]];
  const Vec3& nc = surface.geometry->vertex_normals[record.vertices[2]];
  return {a, b - a, c - a, na, nb - na, nc - na};
}

Solution solve(const Patch& patch, const Vec3& tip) {
  Solution x;
  x.s = (patch.pointAt(x.v, x.w) - tip).norm();
  for (int i = 0; i < kMaxNewtonSteps && !x.found; ++i) {
    const Vec3 normal = patch.normalAt(x.v, x.w);
    const Vec3 residual = patch.pointAt(x.v, x.w) - x.s * normal - tip;
    const Vec3 by_v = patch.along_v - x.s * patch.normal_v;
    const Vec3 by_w = patch.along_w - x.s * patch.normal_w;
    const double determinant = by_v.dot(by_w.cross(-normal));
    if (determinant == 0.0) break;
    const double dv = -residual.dot(by_w.cross(-normal)) / determinant;
    const double dw = -by_v.dot(residual.cross(-normal)) / determinant;
    const double ds = -by_v.dot(by_w.cross(residual)) / determinant;
    x.v += dv;
    x.w += dw;
    x.s += ds;
    x.found = std::abs(dv) + std::abs(dw) <= kArrived;
    if (!(std::abs(x.v) + std::abs(x.w) < 1e6)) break;  // far away or not a number: no solution here
  }
  return x;
}

/// The edge that the solution lies outside of by most; -1 when it is inside.
int violatedEdge(const Solution& x) {
  const double outside[3] = {-x.w, x.v + x.w - 1.0, -x.v};  // edges 01, 12, 20
  int worst = -1;
  double most = kOnEdge;
  for (int edge = 0; edge < 3; ++edge) {
    if (outside[edge] <= most) continue;
    most = outside[edge];
    worst = edge;
  }
  return worst;
}

}  // namespace

std::optional<ShadedProxy> shadedProxy(const Surface& surface, const SurfacePoint& proxy, const Vec3& tip) noexcept {
  Index triangle = proxy.triangle;
  for (int hop = 0; hop < kMaxHops; ++hop) {
    const tree::TriangleRecord& record = surface.geometry->tree.records[triangle];
    const Patch patch = makePatch(surface, record);
    const Solution x = solve(patch, tip);
    if (!std::isfinite(x.v + x.w + x.s)) return std::nullopt;
    const int edge = violatedEdge(x);
    if (edge < 0) {
      const Vec3 normal = patch.normalAt(x.v, x.w);
      if (!x.found || !(x.s > 0.0)) return std::nullopt;
      return ShadedProxy{patch.pointAt(x.v, x.w), normal.normalized(), x.s * normal.norm()};
    }
    triangle = record.neighbours[edge];
    if (triangle == kNoIndex) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace palpate::contact
