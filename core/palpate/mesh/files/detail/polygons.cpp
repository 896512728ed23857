// Squares by the better diagonal, others by clipping ears on the plane of their mean normal, in the order of their
// corners.
//
// Based on: Meisters, "Polygons have ears" (1975); Newell's normal (Sutherland, Sproull, Schumacker, "A
// characterization of ten hidden-surface algorithms", 1974).
#include "palpate/mesh/files/detail/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/readers.h"

namespace palpate::mesh {

namespace {

constexpr std::size_t kMaxClippedCorners = 64;

bool allInRange(std::span<const Index> polygon, std::size_t vertices) {
  return std::all_of(polygon.begin(), polygon.end(), [vertices](Index v) { return v < vertices; });
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

class EarClipper {
 public:
  EarClipper(const std::vector<Vec3>& positions, std::span<const Index> polygon)
      : positions_(positions), corners_(polygon.begin(), polygon.end()), normal_(newellNormal(positions, polygon)) {}

  void clip(std::vector<Triangle>& triangles) {
    while (corners_.size() > 3) {
      const std::size_t ear = findEar();
      triangles.push_back(triangleAt(ear));
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({corners_[0], corners_[1], corners_[2]});
  }

 private:
  Triangle triangleAt(std::size_t i) const {
    const std::size_t n = corners_.size();
    return {corners_[(i + n - 1) % n], corners_[i], corners_[(i + 1) % n]};
  }
  double turn(Index a, Index b, Index c) const {
    return areaVector2(positions_[a], positions_[b], positions_[c]).dot(normal_);
  }
  bool isEar(std::size_t i) const {
    const auto [a, b, c] = triangleAt(i);
    if (!(turn(a, b, c) > 0.0)) return false;
    return std::none_of(corners_.begin(), corners_.end(), [&, a = a, b = b, c = c](Index v) {
      return v != a && v != b && v != c && turn(a, b, v) >= 0.0 && turn(b, c, v) >= 0.0 && turn(c, a, v) >= 0.0;
    });
  }
  /// The first ear; the first corner when rounding or self-intersection leaves none.
  std::size_t findEar() const {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (isEar(i)) return i;
    }
    return 0;
  }

  const std::vector<Vec3>& positions_;
  std::vector<Index> corners_;
  Vec3 normal_;
};

void checkIndices(std::span<const Index> polygon, std::size_t place, std::size_t vertices,
                  const FileCounting& counting) {
  for (Index v : polygon) {
    if (v < vertices) continue;
    const std::string which =
        v == kNoIndex ? "a vertex below the first" : fmt::format("vertex {}", std::size_t{v} + counting.first_vertex);
    const auto cause = fmt::format("the face uses {}, but there are {} vertices", which, vertices);
    if (counting.place == FileCounting::Place::line) throw Error::atLine(counting.name, place, cause);
    throw Error::atByte(counting.name, place, cause);
  }
}

}  // namespace

void triangulate(const std::vector<Vec3>& positions, std::span<const Index> polygon, std::vector<Triangle>& triangles) {
  if (polygon.size() < 3) return;
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
  } else if (polygon.size() > kMaxClippedCorners || !allInRange(polygon, positions.size())) {
    cutAsFan(polygon, triangles);
  } else if (polygon.size() == 4) {
    cutSquare(positions, polygon, triangles);
  } else {
    EarClipper(positions, polygon).clip(triangles);
  }
}

void PolygonList::cut(TriangleMesh& mesh, const FileCounting& counting, bool keep_wrong_indices) const {
  mesh.triangles.reserve(corners_.size() - std::min(corners_.size(), 2 * polygons_.size()));
  std::size_t first = 0;
  for (const auto& [end, place] : polygons_) {
    const std::span<const Index> polygon(corners_.data() + first, end - first);
    if (!keep_wrong_indices) checkIndices(polygon, place, mesh.positions.size(), counting);
    triangulate(mesh.positions, polygon, mesh.triangles);
    first = end;
  }
  checkTriangleCount(mesh.triangles.size(), counting.name);
}

}  // namespace palpate::mesh
