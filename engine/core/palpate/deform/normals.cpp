// Normals from triangles: the sum at one vertex, and sums that are kept and changed triangle by triangle.
//
// Data flow: displaced positions -> here, for the blocks of the plan -> normals of the surface.
// Based on: Ji, dissertation 2008, section 4.5, last page.
#include "palpate/deform/normals.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "palpate/base/elementary.h"

namespace palpate::deform {

namespace {

/// Sums stay below 2^62.
constexpr double kRoom = 4.611686018427388e18;

double longestEdge(const Skin& skin) {
  double longest2 = 0.0;
  for (const Triangle& t : skin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3f edge = skin.restPosition(t[(i + 1) % 3]) - skin.restPosition(t[i]);
      if (edge.allFinite()) longest2 = std::max(longest2, edge.cast<double>().squaredNorm());
    }
  }
  return std::sqrt(longest2);
}

Index mostTrianglesOfVertex(const Skin& skin) {
  Index most = 1;
  for (Index v = 0; v < skin.vertices; ++v) {
    most = std::max(most, static_cast<Index>(skin.triangles_of_vertex[v].size()));
  }
  return most;
}

}  // namespace

Vec3f areaWeightedNormal(const Skin& skin, const PositionStreams& positions, Index vertex) noexcept {
  Vec3 sum = Vec3::Zero();
  for (const Index t : skin.triangles_of_vertex[vertex]) {
    const auto& [a, b, c] = skin.triangles[t];
    sum += mesh::areaVector2(positions.at(a), positions.at(b), positions.at(c));
  }
  sum.stableNormalize();
  return sum.cast<float>();
}

IncrementalNormals::IncrementalNormals(const Skin& skin, double most_mm)
    : areas_(skin.triangles.size()),
      sums_(skin.vertices, Fixed{}),
      changed_(0),
      is_listed_(blocksFor(static_cast<Index>(skin.triangles.size())), 0),
      followed_(skin.blocks) {
  largest_ = kRoom / mostTrianglesOfVertex(skin);
  const double longest = longestEdge(skin) + 2.0 * most_mm;
  // A power of two: the conversion rounds once.
  scale_ = elementary::exp2(std::floor(elementary::log2(largest_ / (1.0 + longest * longest))));
  changed_.reserve(skin.triangles.size());
  for (Index v = 0; v < skin.vertices; ++v) positions_.push_back(skin.restPosition(v));
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    areas_[t] = areaOf(skin.triangles[t]);
    for (const Index v : skin.triangles[t]) {
      for (std::size_t axis = 0; axis < 3; ++axis) sums_[v][axis] += areas_[t][axis];
    }
  }
  rest_sums_ = sums_;
}

IncrementalNormals::Fixed IncrementalNormals::areaOf(const Triangle& triangle) const noexcept {
  const auto& [a, b, c] = triangle;
  const Vec3 area =
      mesh::areaVector2(positions_[a].cast<double>(), positions_[b].cast<double>(), positions_[c].cast<double>());
  if (!area.allFinite()) return {};
  Fixed fixed{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fixed[axis] = std::llround(std::clamp(area[static_cast<int>(axis)] * scale_, -largest_, largest_));
  }
  return fixed;
}

void IncrementalNormals::place(const Skin& skin, Index vertex, const Vec3f& position) noexcept {
  if (positions_[vertex] == position) return;
  positions_[vertex] = position;
  for (const Index t : skin.triangles_of_vertex[vertex]) {
    if (insertNew(t, is_listed_)) changed_.push_back(t);
  }
}

Index IncrementalNormals::update(const Skin& skin) noexcept {
  for (const Index t : changed_) {
    const Fixed now = areaOf(skin.triangles[t]);
    for (const Index v : skin.triangles[t]) {
      for (std::size_t axis = 0; axis < 3; ++axis) sums_[v][axis] += now[axis] - areas_[t][axis];
    }
    areas_[t] = now;
    is_listed_[blockOf(t)] &= ~bitOf(t);
  }
  const auto count = static_cast<Index>(changed_.size());
  changed_.clear();
  return count;
}

Index IncrementalNormals::follow(const Skin& skin, const PositionStreams& positions, const BlockSet& moved) noexcept {
  BlockSet::forEachOfBoth(followed_, moved, [&](Index block) {
    const bool moves = moved.contains(block);
    const Index end = std::min((block + 1) * kBlockVertices, skin.vertices);
    for (Index v = block * kBlockVertices; v < end; ++v) {
      place(skin, v, moves ? Vec3f(positions.x[v], positions.y[v], positions.z[v]) : skin.restPosition(v));
    }
  });
  followed_ = moved;
  return update(skin);
}

Vec3f IncrementalNormals::normal(const Skin& skin, Index vertex) const noexcept {
  const Fixed& sum = sums_[vertex];
  if (sum == rest_sums_[vertex]) return skin.restNormal(vertex);
  Vec3 normal(static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2]));
  normal.stableNormalize();
  return normal.cast<float>();
}

}  // namespace palpate::deform
