// Stations -> rings with ends -> triangles.
#include "palpate/body/swept_ellipse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"

namespace palpate::body {
namespace {

constexpr int kEndRings = 4;  // rings of each rounded end

double depthOf(const Station& end, const SweptEnd& shape) {
  return shape.rounding_mm > 0.0 ? shape.rounding_mm : end.half_thickness;
}

// The section shrinks over the end's depth along a quarter circle: all of it (a round end) or its edge alone.
void addEnd(std::vector<Station>& rings, const Station& end, double direction, const SweptEnd& shape) {
  for (int i = 1; i <= kEndRings; ++i) {
    const double t = std::numbers::pi / 2 * i / (kEndRings + 1);
    Station ring = end;
    ring.centre += direction * elementary::sin(t) * depthOf(end, shape) * end.along;
    if (shape.rounding_mm > 0.0) {
      ring.half_height -= (1.0 - elementary::cos(t)) * shape.rounding_mm;
      ring.half_thickness -= (1.0 - elementary::cos(t)) * shape.rounding_mm;
    } else {
      ring.half_height *= elementary::cos(t);
      ring.half_thickness *= elementary::cos(t);
    }
    rings.push_back(ring);
  }
}

std::vector<Station> withEnds(const std::vector<Station>& stations, const SweptEnd& first, const SweptEnd& last) {
  std::vector<Station> rings;
  addEnd(rings, stations.front(), -1.0, first);
  std::reverse(rings.begin(), rings.end());
  rings.insert(rings.end(), stations.begin(), stations.end());
  addEnd(rings, stations.back(), 1.0, last);
  return rings;
}

Vec3 capPoint(const Station& end, double direction, const SweptEnd& shape) {
  return end.centre + direction * depthOf(end, shape) * end.along;
}

}  // namespace

mesh::TriangleMesh sweepEllipse(const std::vector<Station>& stations, Index corners, SweptEnd first, SweptEnd last) {
  mesh::TriangleMesh mesh;
  const std::vector<Station> rings = withEnds(stations, first, last);
  for (const Station& ring : rings) {
    for (Index c = 0; c < corners; ++c) {
      const double angle = 2.0 * std::numbers::pi * c / corners;
      mesh.positions.push_back(ring.centre + elementary::cos(angle) * ring.half_thickness * ring.outward +
                               elementary::sin(angle) * ring.half_height * ring.upward);
    }
  }
  const auto last_ring = static_cast<Index>((rings.size() - 1) * corners);
  const auto first_cap = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(capPoint(stations.front(), -1.0, first));
  mesh.positions.push_back(capPoint(stations.back(), 1.0, last));
  for (Index c = 0; c < corners; ++c) {
    const Index d = (c + 1) % corners;
    mesh.triangles.push_back({first_cap, d, c});
    for (Index ring = 0; ring < last_ring; ring += corners) {
      mesh.triangles.push_back({ring + c, ring + d, ring + corners + d});
      mesh.triangles.push_back({ring + c, ring + corners + d, ring + corners + c});
    }
    mesh.triangles.push_back({first_cap + 1, last_ring + c, last_ring + d});
  }
  return mesh;
}

Index cornersOf(double height, double thickness, double edge_mm) {
  // Ramanujan's girth of the section, first term.
  const double girth = std::numbers::pi * 0.75 * (height + thickness);
  return std::max<Index>(8, 2 * static_cast<Index>(std::ceil(0.5 * girth / edge_mm)));
}

}  // namespace palpate::body
