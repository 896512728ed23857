// Squares by the better diagonal, others by a sweep over what is seen of them along their mean normal.
//
// Based on: Newell's normal (Sutherland, Sproull, Schumacker, "A characterization of ten hidden-surface algorithms",
// 1974).
#include "palpate/mesh/files/detail/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/outline_cut.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/holes.h"

namespace palpate::mesh {

namespace {

/// A surface of least area costs the cube of its corners.
constexpr std::size_t kMaxGuessed = 64;
/// Corners that deviate from a line by less than this share of its length are on it.
constexpr double kFlat = 1e-12;

bool allAreUsable(std::span<const Index> polygon, const std::vector<Vec3>& positions) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](Index v) { return v < positions.size() && isUsable(positions[v]); });
}

void cutAsFan(std::span<const Index> polygon, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

/// Twice the area vector of the polygon's projection along its mean normal (Newell's sum).
Vec3 newellNormal(const std::vector<Vec3>& positions, std::span<const Index> polygon) {
  const Vec3& origin = positions[polygon[0]];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += areaVector2(origin, positions[polygon[i - 1]], positions[polygon[i]]);
  }
  return sum;
}

/// Along the diagonal whose halves face one way; where both do, along the shorter one.
void cutSquare(const std::vector<Vec3>& positions, std::span<const Index> q, std::vector<Triangle>& triangles) {
  const auto at = [&](int i) -> const Vec3& { return positions[q[static_cast<std::size_t>(i)]]; };
  const auto agreement = [](const Vec3& n, const Vec3& m) { return n.stableNormalized().dot(m.stableNormalized()); };
  const double first = agreement(areaVector2(at(0), at(1), at(2)), areaVector2(at(0), at(2), at(3)));
  const double second = agreement(areaVector2(at(0), at(1), at(3)), areaVector2(at(1), at(2), at(3)));
  const bool one_is_folded = std::min(first, second) < 0.0;
  const bool by_first = one_is_folded ? first >= second : (at(2) - at(0)).norm() <= (at(3) - at(1)).norm();
  if (by_first) {
    triangles.insert(triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  } else {
    triangles.insert(triangles.end(), {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}});
  }
}

bool isBowTie(const std::vector<Vec3>& positions, std::span<const Index> q) {
  const auto facing = [&](int i, int j, int k) {
    return areaVector2(positions[q[i]], positions[q[j]], positions[q[k]]);
  };
  return facing(0, 1, 2).dot(facing(0, 2, 3)) < 0.0 && facing(0, 1, 3).dot(facing(1, 2, 3)) < 0.0;
}

// --- longer ones: seen along one direction, then cut exactly

/// The greatest coordinate becomes 0.5 to 1, by a power of two, so that nothing is rounded; what is then below 2^-300
/// is nothing, so that products stay exact.
std::vector<Vec2> inRange(std::vector<Vec2> places) {
  double most = 0.0;
  for (const Vec2& place : places) most = std::max(most, place.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(most, &exponent);
  for (Vec2& place : places) {
    for (double& value : place) {
      value = std::ldexp(value, -exponent);
      if (std::abs(value) < 0x1p-300) value = 0.0;
    }
  }
  return places;
}

/// Along the axis nearest to the normal: the coordinates of the file, as they are.
std::vector<Vec2> seenAlongAxis(const std::vector<Vec3>& positions, std::span<const Index> polygon,
                                const Vec3& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index right = (axis + 1) % 3;
  Eigen::Index up = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(right, up);
  std::vector<Vec2> places;
  places.reserve(polygon.size());
  for (const Index v : polygon) places.emplace_back(positions[v][right], positions[v][up]);
  return inRange(std::move(places));
}

/// Along the normal, rounded: what is rough across its plane must not be seen from the side.
std::vector<Vec2> seenAlongNormal(const std::vector<Vec3>& positions, std::span<const Index> polygon,
                                  const Vec3& normal) {
  const Vec3 towards = normal.stableNormalized();
  Eigen::Index least = 0;
  towards.cwiseAbs().minCoeff(&least);
  const Vec3 right = Vec3::Unit(least).cross(towards).stableNormalized();
  const Vec3 up = towards.cross(right);
  std::vector<Vec2> places;
  places.reserve(polygon.size());
  for (const Index v : polygon) {
    const Vec3 at = positions[v] - positions[polygon[0]];
    places.emplace_back(at.dot(right), at.dot(up));
  }
  return inRange(std::move(places));
}

void appendTriangles(std::span<const Index> polygon, const std::vector<Triangle>& of_corners,
                     std::vector<Triangle>& triangles) {
  for (const auto& [a, b, c] : of_corners) triangles.push_back({polygon[a], polygon[b], polygon[c]});
}

bool isOnALine(const std::vector<Vec3>& positions, std::span<const Index> polygon) {
  const Vec3& from = positions[polygon[0]];
  const auto farther = [&](Index a, Index b) { return (positions[a] - from).norm() < (positions[b] - from).norm(); };
  const Vec3& farthest = positions[*std::max_element(polygon.begin(), polygon.end(), farther)];
  return std::all_of(polygon.begin(), polygon.end(), [&](Index v) {
    return areaVector2(from, farthest, positions[v]).norm() <= kFlat * (farthest - from).squaredNorm();
  });
}

/// Its surface of least area, where it is small enough for that.
PolygonCut guess(const std::vector<Vec3>& positions, std::span<const Index> polygon, std::vector<Triangle>& triangles) {
  if (polygon.size() > kMaxGuessed) return PolygonCut::impossible;
  std::vector<Vec3> loop;
  for (const Index v : polygon) loop.push_back(positions[v]);
  const auto filling = triangulateLoop(loop, [](Index, Index) { return true; });
  if (!filling) return PolygonCut::impossible;
  appendTriangles(polygon, filling->triangles, triangles);
  return PolygonCut::guessed;
}

PolygonCut cutLong(const std::vector<Vec3>& positions, std::span<const Index> polygon,
                   std::vector<Triangle>& triangles) {
  if (isOnALine(positions, polygon)) {  // nothing to see from any side
    cutAsFan(polygon, triangles);
    return PolygonCut::exact;
  }
  const Vec3 normal = newellNormal(positions, polygon);
  auto cut = triangulateOutline(seenAlongAxis(positions, polygon, normal));
  if (!cut && !normal.isZero(0.0)) cut = triangulateOutline(seenAlongNormal(positions, polygon, normal));
  if (!cut) return guess(positions, polygon, triangles);
  appendTriangles(polygon, *cut, triangles);
  return PolygonCut::exact;
}

[[noreturn]] void failAt(const FileCounting& counting, std::size_t place, std::string_view cause) {
  if (counting.place == FilePlace::line) throw Error::atLine(counting.name, place, cause);
  throw Error::atByte(counting.name, place, cause);
}

void checkIndices(std::span<const Index> polygon, std::size_t place, std::size_t vertices,
                  const FileCounting& counting) {
  for (Index v : polygon) {
    if (v < vertices) continue;
    const std::string which =
        v == kNoIndex ? "a vertex below the first" : fmt::format("vertex {}", std::size_t{v} + counting.first_vertex);
    failAt(counting, place, fmt::format("the face uses {}, but there are {} vertices", which, vertices));
  }
}

}  // namespace

PolygonCut triangulate(const std::vector<Vec3>& positions, std::span<const Index> polygon,
                       std::vector<Triangle>& triangles) {
  if (polygon.size() < 3) return PolygonCut::exact;
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return PolygonCut::exact;
  }
  if (!allAreUsable(polygon, positions)) {
    cutAsFan(polygon, triangles);
    return PolygonCut::exact;
  }
  if (polygon.size() > 4) return cutLong(positions, polygon, triangles);
  cutSquare(positions, polygon, triangles);
  return isBowTie(positions, polygon) ? PolygonCut::guessed : PolygonCut::exact;
}

void PolygonList::cut(TriangleMesh& mesh, const FileCounting& counting, bool keep_wrong_indices,
                      PassedOver& passed_over) const {
  mesh.triangles.reserve(mesh.triangles.size() + corners_.size() - std::min(corners_.size(), 2 * polygons_.size()));
  std::size_t first = 0;
  for (const auto& [end, place] : polygons_) {
    const std::span<const Index> polygon(corners_.data() + first, end - first);
    first = end;
    if (polygon.size() < 3) passed_over.add("a face with fewer than 3 corners is skipped", place, counting.place);
    if (!keep_wrong_indices && polygon.size() >= 3) checkIndices(polygon, place, mesh.positions.size(), counting);
    const PolygonCut cut = triangulate(mesh.positions, polygon, mesh.triangles);
    if (cut == PolygonCut::guessed) {
      passed_over.add("the outline of the face crosses itself; it is triangulated with the least area", place,
                      counting.place);
    } else if (cut == PolygonCut::impossible) {
      failAt(counting, place,
             fmt::format("the outline of the face of {} corners crosses itself: it bounds no surface", polygon.size()));
    }
  }
  checkTriangleCount(mesh.triangles.size(), counting.name);
}

}  // namespace palpate::mesh
