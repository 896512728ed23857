// Rounds of local operations on an indexed mesh with the triangles round each vertex kept up to date; then the count is
// made exact by the shortest edges or the longest; then quarters of triangles, and the last few edges split.
//
// Based on: Botsch and Kobbelt, "A remeshing approach to multiresolution modeling" (2004), the rounds and their limits
// 4/3 and 4/5; Dey et al., "Topology preserving edge contraction" (1999), when a collapse keeps the surface.
#include "palpate/body/trunk/even_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/mesh/topology.h"

namespace palpate::body {

namespace {

// Up to this count triangles are made by rounds; more by quartering, which is less even where curvature is strong.
constexpr std::size_t kMaxByRounds = 40000;
constexpr int kEvenRounds = 6;
constexpr int kSmoothings = 6;            // after the count is exact
constexpr double kLongShare = 4.0 / 3.0;  // against the wanted edge
constexpr double kShortShare = 4.0 / 5.0;
constexpr double kMaxTurn = 0.5;  // least cosine between a triangle's normals before and after a change
constexpr std::size_t kFewestNeighbours = 4;
constexpr std::size_t kMaxNeighbours = 9;

struct Edge {
  Index a, b;
};

/// A closed mesh that changes edge by edge. Dead triangles have kNoIndex as first corner, dead vertices none around.
class ChangingMesh {
 public:
  ChangingMesh(const mesh::TriangleMesh& mesh, const OntoSurface& onto)
      : onto_(onto), triangles_(mesh.triangles), live_(mesh.triangles.size()), around_(mesh.positions.size()) {
    for (const Vec3& p : mesh.positions) addPoint(onto_(p));
    for (Index t = 0; t < triangles_.size(); ++t) {
      for (const Index v : triangles_[t]) around_[v].push_back(t);
    }
  }

  std::size_t triangles() const { return live_; }
  double length(const Edge& edge) const { return (position_[edge.a] - position_[edge.b]).norm(); }
  double length(Index a, Index b) const { return (position_[a] - position_[b]).norm(); }

  /// Each edge once, in order of the triangles.
  std::vector<Edge> edges() const {
    std::vector<Edge> edges;
    edges.reserve(3 * live_ / 2);
    for (const Triangle& t : triangles_) {
      if (t[0] == kNoIndex) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        if (t[i] < t[(i + 1) % 3]) edges.push_back({t[i], t[(i + 1) % 3]});
      }
    }
    return edges;
  }

  double area() const {
    double sum = 0;
    for (const Triangle& t : triangles_) {
      if (t[0] != kNoIndex) sum += 0.5 * areaVector(t).norm();
    }
    return sum;
  }

  bool isEdge(const Edge& edge) const { return leftTriangle(edge.a, edge.b) != kNoIndex; }

  /// The new vertex, on the surface between the two.
  Index split(const Edge& edge) {
    const Index left = leftTriangle(edge.a, edge.b);
    const Index right = leftTriangle(edge.b, edge.a);
    const Index c = oppositeVertex(left, edge.a, edge.b);
    const Index d = oppositeVertex(right, edge.b, edge.a);
    const Index middle = addPoint(onto_(0.5 * (position_[edge.a] + position_[edge.b])));
    around_.emplace_back();
    replaceCorner(left, edge.b, middle);
    replaceCorner(right, edge.b, middle);
    addTriangle({middle, edge.b, c});
    addTriangle({edge.b, middle, d});
    return middle;
  }

  /// Takes b away, a goes to the middle. False where the surface would fold, tear or get edges beyond `longest`.
  bool collapse(const Edge& edge, double longest) {
    const Index a = edge.a;
    const Index b = edge.b;
    if (!keepsSurface(a, b)) return false;
    const SkinPoint middle = onto_(0.5 * (position_[a] + position_[b]));
    for (const Index v : {a, b}) {
      for (const Index t : around_[v]) {
        const bool dies = has(t, a) && has(t, b);
        if (!dies && !staysSound(t, v, middle.position, longest)) return false;
      }
    }
    position_[a] = middle.position;
    normal_[a] = middle.normal;
    const std::vector<Index> of_b = around_[b];
    for (const Index t : of_b) {
      if (has(t, a)) {
        removeTriangle(t);
      } else {
        replaceCorner(t, b, a);
      }
    }
    return true;
  }

  /// Turns the edge where its four vertices get nearer to six neighbours and no triangle gets worse.
  bool flip(const Edge& edge) {
    const Index left = leftTriangle(edge.a, edge.b);
    const Index right = leftTriangle(edge.b, edge.a);
    const Index c = oppositeVertex(left, edge.a, edge.b);
    const Index d = oppositeVertex(right, edge.b, edge.a);
    if (c == d || leftTriangle(c, d) != kNoIndex || leftTriangle(d, c) != kNoIndex) return false;
    if (!flipHelps(edge, c, d)) return false;
    const Triangle one{c, d, edge.b};
    const Triangle other{d, c, edge.a};
    if (!facesOut(one) || !facesOut(other)) return false;
    setTriangle(left, one);
    setTriangle(right, other);
    return true;
  }

  /// Every vertex to the middle of its neighbours, weighted by the areas there, along the surface.
  void smooth() {
    std::vector<Vec3> moved(position_.size());
    for (Index v = 0; v < position_.size(); ++v) {
      if (!around_[v].empty()) moved[v] = middleRound(v);
    }
    for (Index v = 0; v < position_.size(); ++v) {
      if (around_[v].empty()) continue;
      const Vec3 step = moved[v] - position_[v];
      const Vec3 along = step - step.dot(normal_[v]) * normal_[v];
      const SkinPoint there = onto_(position_[v] + along);
      if (!movesSoundly(v, there.position)) continue;
      position_[v] = there.position;
      normal_[v] = there.normal;
    }
  }

  /// Without the dead.
  mesh::TriangleMesh compact() const {
    mesh::TriangleMesh mesh;
    std::vector<Index> number(position_.size(), kNoIndex);
    for (Index v = 0; v < position_.size(); ++v) {
      if (around_[v].empty()) continue;
      number[v] = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(position_[v]);
    }
    for (const Triangle& t : triangles_) {
      if (t[0] != kNoIndex) mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return mesh;
  }

 private:
  Index addPoint(const SkinPoint& point) {
    position_.push_back(point.position);
    normal_.push_back(point.normal);
    return static_cast<Index>(position_.size() - 1);
  }
  void addTriangle(const Triangle& triangle) {
    const auto t = static_cast<Index>(triangles_.size());
    triangles_.push_back(triangle);
    ++live_;
    for (const Index v : triangle) around_[v].push_back(t);
  }
  void forget(Index v, Index t) {
    std::vector<Index>& round = around_[v];
    round.erase(std::find(round.begin(), round.end(), t));
  }
  void removeTriangle(Index t) {
    for (const Index v : triangles_[t]) forget(v, t);
    triangles_[t][0] = kNoIndex;
    --live_;
  }
  void replaceCorner(Index t, Index old, Index with) {
    *std::find(triangles_[t].begin(), triangles_[t].end(), old) = with;
    forget(old, t);
    around_[with].push_back(t);
  }
  void setTriangle(Index t, const Triangle& corners) {
    for (const Index v : triangles_[t]) forget(v, t);
    triangles_[t] = corners;
    for (const Index v : corners) around_[v].push_back(t);
  }

  bool has(Index t, Index v) const { return mesh::hasCorner(triangles_[t], v); }
  /// The triangle whose side goes from a to b.
  Index leftTriangle(Index a, Index b) const {
    for (const Index t : around_[a]) {
      const Triangle& c = triangles_[t];
      if ((c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b)) return t;
    }
    return kNoIndex;
  }
  Index oppositeVertex(Index t, Index a, Index b) const {
    for (const Index v : triangles_[t]) {
      if (v != a && v != b) return v;
    }
    return kNoIndex;
  }
  Vec3 areaVector(const Triangle& t) const {
    return mesh::areaVector2(position_[t[0]], position_[t[1]], position_[t[2]]);
  }
  bool facesOut(const Triangle& t) const {
    const Vec3 area = areaVector(t);
    return area.dot(normal_[t[0]] + normal_[t[1]] + normal_[t[2]]) > kMaxTurn * 3.0 * area.norm() && area.norm() > 0;
  }

  /// The two vertices have just the two third corners of their triangles in common, and none gets too few neighbours.
  bool keepsSurface(Index a, Index b) const {
    if (around_[a].size() + around_[b].size() - 4 > kMaxNeighbours) return false;
    std::size_t common = 0;
    for (const Index t : around_[a]) {
      for (const Index v : triangles_[t]) {
        // Each neighbour of a is counted once, in the triangle whose side runs from a to it.
        if (v != a && v != b && leftTriangle(a, v) == t && leftTriangle(b, v) != kNoIndex) ++common;
      }
    }
    if (common != 2) return false;
    for (const Index t : {leftTriangle(a, b), leftTriangle(b, a)}) {
      if (around_[oppositeVertex(t, a, b)].size() <= kFewestNeighbours) return false;
    }
    return true;
  }
  /// The triangle with its corner v elsewhere.
  bool staysSound(Index t, Index v, const Vec3& there, double longest) const {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index other = triangles_[t][i];
      corner[i] = other == v ? there : position_[other];
      if (other != v && (position_[other] - there).norm() > longest) return false;
    }
    const Vec3 before = areaVector(triangles_[t]);
    const Vec3 after = mesh::areaVector2(corner[0], corner[1], corner[2]);
    return after.dot(before) > kMaxTurn * after.norm() * before.norm();
  }
  bool movesSoundly(Index v, const Vec3& there) const {
    return std::all_of(around_[v].begin(), around_[v].end(), [&](Index t) { return staysSound(t, v, there, 1e300); });
  }
  bool flipHelps(const Edge& edge, Index c, Index d) const {
    const auto off = [&](Index v, int change) {
      const int far = static_cast<int>(around_[v].size()) + change - 6;
      return far * far;
    };
    if (around_[edge.a].size() <= kFewestNeighbours || around_[edge.b].size() <= kFewestNeighbours) return false;
    const int before = off(edge.a, 0) + off(edge.b, 0) + off(c, 0) + off(d, 0);
    const int after = off(edge.a, -1) + off(edge.b, -1) + off(c, 1) + off(d, 1);
    return after < before;
  }
  Vec3 middleRound(Index v) const {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const Index t : around_[v]) {
      const Triangle& c = triangles_[t];
      const double area = areaVector(c).norm();
      sum += area * (position_[c[0]] + position_[c[1]] + position_[c[2]]) / 3.0;
      weights += area;
    }
    return weights > 0 ? Vec3(sum / weights) : position_[v];
  }

  const OntoSurface& onto_;
  std::vector<Vec3> position_;
  std::vector<Vec3> normal_;
  std::vector<Triangle> triangles_;
  std::size_t live_;
  std::vector<std::vector<Index>> around_;  // the triangles of a vertex, in no order
};

/// Edge of equilateral triangles of which `triangles` cover `area`.
double equilateralEdge(double area, std::size_t triangles) {
  return std::sqrt(area / static_cast<double>(triangles) * 4.0 / std::sqrt(3.0));
}

void flipAll(ChangingMesh& mesh) {
  for (const Edge& edge : mesh.edges()) {
    if (mesh.isEdge(edge)) mesh.flip(edge);
  }
}

void oneRound(ChangingMesh& mesh, double edge_mm) {
  const double longest = kLongShare * edge_mm;
  for (const Edge& edge : mesh.edges()) {
    if (mesh.length(edge) > longest) mesh.split(edge);
  }
  for (const Edge& edge : mesh.edges()) {
    if (mesh.isEdge(edge) && mesh.length(edge) < kShortShare * edge_mm) mesh.collapse(edge, longest);
  }
  flipAll(mesh);
  mesh.smooth();
}

/// Splits the longest edges or collapses the shortest until the count is right: two triangles each.
void makeExact(ChangingMesh& mesh, std::size_t triangles) {
  while (mesh.triangles() != triangles) {
    const bool too_few = mesh.triangles() < triangles;
    std::vector<Edge> edges = mesh.edges();
    std::stable_sort(edges.begin(), edges.end(), [&](const Edge& one, const Edge& other) {
      return too_few ? mesh.length(one) > mesh.length(other) : mesh.length(one) < mesh.length(other);
    });
    const std::size_t before = mesh.triangles();
    // Not all in one go: what was split or collapsed changes what is longest or shortest.
    std::size_t left = std::max<std::size_t>(1, (too_few ? triangles - before : before - triangles) / 4);
    for (const Edge& edge : edges) {
      if (left == 0) break;
      if (!mesh.isEdge(edge)) continue;
      if (too_few) {
        mesh.split(edge);
        --left;
      } else if (mesh.collapse(edge, 1e300)) {
        --left;
      }
    }
    if (mesh.triangles() == before) throw Error("trunk: too few triangles for this body; use more");
  }
}

/// Every triangle in four, the new vertices on the surface.
mesh::TriangleMesh quartered(const mesh::TriangleMesh& mesh, const OntoSurface& onto) {
  mesh::TriangleMesh fine;
  fine.positions = mesh.positions;
  fine.positions.reserve(4 * mesh.positions.size());
  fine.triangles.reserve(4 * mesh.triangles.size());
  std::vector<std::array<Index, 3>> middle(mesh.triangles.size());  // middle of the side from corner i to corner i + 1
  const mesh::EdgeUses uses = mesh::edgeUses(mesh);
  mesh::forEachEdge(uses, [&](Index low, Index high, std::span<const mesh::EdgeUse> sides) {
    const auto vertex = static_cast<Index>(fine.positions.size());
    fine.positions.push_back(onto(0.5 * (mesh.positions[low] + mesh.positions[high])).position);
    for (const mesh::EdgeUse& side : sides) middle[side.half_edge / 3][side.half_edge % 3] = vertex;
  });
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& [ab, bc, ca] = middle[t];
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

void splitSide(mesh::TriangleMesh& mesh, const OntoSurface& onto, Index low, Index high, Index left, Index right) {
  const auto middle = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(onto(0.5 * (mesh.positions[low] + mesh.positions[high])).position);
  for (const Index t : {left, right}) {
    Triangle near_high = mesh.triangles[t];
    std::replace(near_high.begin(), near_high.end(), low, middle);
    std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), high, middle);
    mesh.triangles.push_back(near_high);
  }
}

/// The `count` longest edges that have no triangle in common, split.
void splitLongest(mesh::TriangleMesh& mesh, const OntoSurface& onto, std::size_t count) {
  if (count == 0) return;
  struct Side {
    double length;
    Index low, high;
    auto key() const { return std::pair(low, high); }
  };
  std::vector<Side> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i];
      const Index b = t[(i + 1) % 3];
      if (a < b) sides.push_back({(mesh.positions[a] - mesh.positions[b]).norm(), a, b});
    }
  }
  // A triangle has three sides: among these longest enough are apart from each other.
  const std::size_t kept = std::min(sides.size(), 8 * count + 8);
  const auto longer = [](const Side& one, const Side& other) {
    return one.length != other.length ? one.length > other.length : one.key() < other.key();
  };
  std::partial_sort(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(kept), sides.end(), longer);
  sides.resize(kept);
  std::map<std::pair<Index, Index>, std::array<Index, 2>> both;
  for (const Side& side : sides) both[side.key()] = {kNoIndex, kNoIndex};
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = mesh.triangles[t][i];
      const Index b = mesh.triangles[t][(i + 1) % 3];
      const auto found = both.find({std::min(a, b), std::max(a, b)});
      if (found != both.end()) found->second[a < b ? 0 : 1] = t;
    }
  }
  std::set<Index> used;
  for (const Side& side : sides) {
    if (count == 0) return;
    const auto [left, right] = both[side.key()];
    if (used.contains(left) || used.contains(right)) continue;
    used.insert({left, right});
    splitSide(mesh, onto, side.low, side.high, left, right);
    --count;
  }
  if (count != 0) throw Error("trunk: this exact number of triangles cannot be reached; use a slightly different one");
}

}  // namespace

mesh::TriangleMesh evenMesh(const mesh::TriangleMesh& rough, const OntoSurface& onto, std::size_t triangles) {
  std::size_t coarse = triangles;
  int quarterings = 0;
  for (; coarse > kMaxByRounds; ++quarterings) coarse /= 4;
  coarse = coarse / 2 * 2;
  ChangingMesh mesh(rough, onto);
  for (int round = 0; round < kEvenRounds; ++round) oneRound(mesh, equilateralEdge(mesh.area(), coarse));
  makeExact(mesh, coarse);
  for (int round = 0; round < kSmoothings; ++round) {
    flipAll(mesh);
    mesh.smooth();
  }
  mesh::TriangleMesh fine = mesh.compact();
  for (int i = 0; i < quarterings; ++i) fine = quartered(fine, onto);
  splitLongest(fine, onto, (triangles - fine.triangles.size()) / 2);
  return fine;
}

}  // namespace palpate::body
