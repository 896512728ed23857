// A flood over triangles from the touched ones, and the side that each triangle shows. Nothing of deform is used.
#include "lab/judges/deform_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate::lab {

namespace {

/// Height over longest side, as a share of the largest coordinate, below which a triangle of floats has no sure side:
/// sixteen roundings.
constexpr double kThinnest = 1e-6;

/// Rounded once and kept: a compiler may leave out a rounding that is only passed through (g++ 12 does, with -O3).
std::vector<Vec3f> asFloats(const mesh::TriangleMesh& mesh) {
  std::vector<Vec3f> floats;
  floats.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) floats.push_back(p.cast<float>());
  return floats;
}

std::vector<bool> movedVertices(std::span<const Vec3f> rest, std::span<const Vec3f> positions) {
  std::vector<bool> moved(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) moved[v] = rest[v].allFinite() && rest[v] != positions[v];
  return moved;
}

/// The triangles at each vertex, in one array.
struct Corners {
  std::vector<std::size_t> first;
  std::vector<std::size_t> triangles;
};

Corners cornersOf(const mesh::TriangleMesh& mesh) {
  Corners corners;
  corners.first.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) ++corners.first[v + 1];
  }
  for (std::size_t v = 0; v + 1 < corners.first.size(); ++v) corners.first[v + 1] += corners.first[v];
  corners.triangles.resize(corners.first.back());
  std::vector<std::size_t> next(corners.first.begin(), corners.first.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) corners.triangles[next[v]++] = t;
  }
  return corners;
}

/// Moved vertices that are connected to a touched triangle. Its corners count as touched even where they stay: a finger
/// on a triangle larger than its region moves vertices beyond them.
std::vector<bool> connectedVertices(const mesh::TriangleMesh& mesh, const std::vector<bool>& moved,
                                    std::span<const TouchedPlace> places) {
  const Corners corners = cornersOf(mesh);
  std::vector<bool> seen(mesh.positions.size(), false);
  std::vector<Index> open;
  for (const TouchedPlace& place : places) {
    for (const Index v : mesh.triangles[place.triangle]) {
      seen[v] = true;
      open.push_back(v);
    }
  }
  while (!open.empty()) {
    const Index v = open.back();
    open.pop_back();
    for (std::size_t i = corners.first[v]; i < corners.first[v + 1]; ++i) {
      for (const Index w : mesh.triangles[corners.triangles[i]]) {
        if (seen[w] || !moved[w]) continue;
        seen[w] = true;
        open.push_back(w);
      }
    }
  }
  return seen;
}

bool isOffAllPlanes(const Vec3& point, std::span<const TouchedPlace> places) {
  return std::all_of(places.begin(), places.end(), [&](const TouchedPlace& place) {
    return std::abs((point - place.anchor).dot(place.normal.normalized())) > place.farthest_off_plane_mm;
  });
}

void judgeTriangle(const Vec3 (&rest)[3], const Vec3 (&now)[3], DeformReport& report) {
  const Vec3 normal = (rest[1] - rest[0]).cross(rest[2] - rest[0]);
  double longest = 0.0;
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double side = (rest[(i + 1) % 3] - rest[i]).norm();
    longest = std::max(longest, side);
    largest = std::max(largest, rest[i].cwiseAbs().maxCoeff());
    const Vec3 apart = (now[(i + 1) % 3] - rest[(i + 1) % 3]) - (now[i] - rest[i]);
    report.longest_tear_mm = std::max(report.longest_tear_mm, apart.norm() - side);
  }
  if (!(normal.norm() > kThinnest * largest * longest)) {
    ++report.too_thin;
  } else if (!((now[1] - now[0]).cross(now[2] - now[0]).dot(normal) > 0.0)) {
    ++report.turned;
  }
}

}  // namespace

DeformReport checkDeformation(const mesh::TriangleMesh& rest, std::span<const Vec3f> positions,
                              std::span<const TouchedPlace> places) {
  DeformReport report;
  const std::vector<Vec3f> at_rest = asFloats(rest);
  const std::vector<bool> moved = movedVertices(at_rest, positions);
  const std::vector<bool> connected = connectedVertices(rest, moved, places);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    if (!moved[v]) continue;
    ++report.moved;
    report.unconnected += connected[v] ? 0 : 1;
    report.off_plane += isOffAllPlanes(rest.positions[v], places) ? 1 : 0;
  }
  for (const Triangle& t : rest.triangles) {
    if (!moved[t[0]] && !moved[t[1]] && !moved[t[2]]) continue;
    Vec3 was[3];
    Vec3 now[3];
    for (std::size_t i = 0; i < 3; ++i) {
      was[i] = at_rest[t[i]].cast<double>();
      now[i] = positions[t[i]].cast<double>();
    }
    judgeTriangle(was, now, report);
  }
  return report;
}

}  // namespace palpate::lab
