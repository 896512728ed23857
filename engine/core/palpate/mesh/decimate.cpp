// Quadric edge collapse to an exact count of triangles.
//
// A heap holds every edge with the error that its collapse would cost. The cheapest is taken if it keeps the topology
// (link condition) and turns no triangle over; its vertex then gets new edges, older entries are recognised by the
// stamps of their ends. Edges refused when they came up may be fine later, so the heap is refilled until nothing
// moves. Vertices keep their triangles in linked lists of corners, which join in constant time.
//
// Load time only: the built-in bones and the hand are drawn fine and reduced here (body/bones.cpp, body/hand.cpp).
//
// Based on: Garland and Heckbert, "Surface simplification using quadric error metrics" (1997); Dey, Edelsbrunner, Guha,
// Nekhayev, "Topology preserving edge contraction" (1999), the link condition.
//
// Preferred to meshoptimizer 0.18 (meshopt_simplify; Debian 12, one core, the same run; distances from 60,000 points of
// each surface to the other; smallest angle of all triangles; turned: triangles that face away from the input). This |
// meshopt:
//
//                                     time, ms      mean (largest) distance, mm       smallest angle   turned over
//   vertebra T6, half, 12,138 -> 776  14 |   3      0.040 (0.32) | 0.078 (0.60)       3.5 | 1.0 deg    0 |   2
//   scapula        83,708 ->   3,410  138 |  25     0.032 (0.32) | 0.070 (0.53)       2.0 | 0.8        0 |   6
//   hand           95,360 ->   2,800  178 |  29     0.052 (0.42) | 0.104 (0.57)       4.3 | 1.1        0 |   3
//   bumpy ball    128,220 ->  64,110  137 |  31     0.001 (0.03) | 0.004 (0.10)       0.3 | 0.0        1 | 149
//   back        1,000,000 -> 100,000  4628 | 892    0.001 (0.02) | 0.015 (0.19)       5.2 | 0.0        0 |  85
//
// It is five times as fast and needs twice to ten times the distance, because it only picks among the existing
// vertices. Its triangles rule it out: they lie on each other (42 doubled pairs on the ball, 1 to 6 where two halves of
// a vertebra are joined), which `repair` would have to remove again, and the count is missed by 1 to 22. On flat faces
// with sharp folds (groove, pit) it is exact where this is up to 0.03 mm off. For the bones it would save 0.4 s of the
// second they take at start, make another body, and with it other depths, stiffnesses and forces.
#include "palpate/mesh/decimate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/vec.h"

namespace palpate::mesh {

namespace {

/// The sum of squared, area-weighted distances to a set of planes, as a symmetric 4x4 matrix:
/// E(x) = x^T M x + 2 b^T x + c, mm^2 times the weight of the planes (mm^2).
struct Quadric {
  Mat3 m = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;

  static Quadric ofPlane(const Vec3& unit_normal, const Vec3& point, double weight) {
    const double offset = -unit_normal.dot(point);
    return {weight * unit_normal * unit_normal.transpose(), weight * offset * unit_normal, weight * offset * offset};
  }
  Quadric& operator+=(const Quadric& q) {
    m += q.m;
    b += q.b;
    c += q.c;
    return *this;
  }
  double at(const Vec3& x) const { return x.dot(m * x) + 2.0 * b.dot(x) + c; }

  /// The point of least error, held near `guess` by `stiffness` (a share of the mean eigenvalue): flat and straight
  /// regions leave directions free that would otherwise send the point anywhere.
  Vec3 best(const Vec3& guess, double stiffness) const {
    const double hold = stiffness * m.trace() / 3.0 + 1e-30;
    const Mat3 held = m + hold * Mat3::Identity();
    return held.inverse() * (hold * guess - b);
  }

  /// The same planes mirrored at x = 0.
  Quadric mirroredAtX0() const {
    Quadric q = *this;
    for (const int other : {1, 2}) {
      q.m(0, other) = -q.m(0, other);
      q.m(other, 0) = -q.m(other, 0);
    }
    q.b.x() = -q.b.x();
    return q;
  }
};

// Share of the mean eigenvalue that holds a new vertex near the middle of its edge (see Quadric::best).
constexpr double kHold = 1e-3;
// Cost of an edge's squared length times its squared length, so that flat regions collapse short edges first.
constexpr double kLengthCost = 1e-6;
// A triangle may turn by at most acos(0.2) = 78 degrees in one collapse.
constexpr double kMinTurnCosine = 0.2;
// A triangle below this share of the area around an edge is dust (a mesher leaves some): its own normal means nothing,
// so it is judged by the normal of the whole neighbourhood.
constexpr double kDust = 0.01;
// Shape 4 sqrt(3) area / sum of squared edges below which a triangle counts as a sliver (1: equilateral).
constexpr double kSliver = 0.05;

double shapeOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0.0 ? 2.0 * std::sqrt(3.0) * areaVector2(a, b, c).norm() / squares : 0.0;
}

struct Candidate {
  double cost;
  Index a, b;
  std::uint32_t stamp_a, stamp_b;
};
// For a heap with the cheapest on top; ends break ties, so that the order never depends on the heap.
bool later(const Candidate& p, const Candidate& q) {
  if (p.cost != q.cost) return p.cost > q.cost;
  return std::pair(p.a, p.b) > std::pair(q.a, q.b);
}

class Decimator {
 public:
  Decimator(TriangleMesh mesh, const DecimateOptions& options)
      : options_(options),
        positions_(std::move(mesh.positions)),
        triangles_(std::move(mesh.triangles)),
        live_triangles_(triangles_.size()),
        origin_(positions_.empty() ? Vec3::Zero() : positions_.front()) {
    for (Vec3& p : positions_) p -= allowedShift(origin_);
    linkCorners();
    findBorder();
    sumQuadrics();
  }

  void reduceTo(std::size_t target) {
    target_ = target;
    collapseToTarget();
    avoid_slivers_ = false;  // only if nothing else is left to reach the count
    collapseToTarget();
    if (live_triangles_ > target) throwUnreachable();
  }

  TriangleMesh result() const {
    TriangleMesh mesh;
    std::vector<Index> renumbered(positions_.size(), kNoIndex);
    for (Index v = 0; v < positions_.size(); ++v) {
      if (first_corner_[v] == kNoIndex) continue;
      renumbered[v] = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(positions_[v] + allowedShift(origin_));
    }
    for (const Triangle& t : triangles_) {
      if (t[0] != kNoIndex) mesh.triangles.push_back({renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]});
    }
    return mesh;
  }

 private:
  // Quadrics are summed near the origin to keep their digits; a mirrored half must keep its plane.
  Vec3 allowedShift(const Vec3& shift) const {
    return options_.mirrored_at_x0 ? Vec3(0.0, shift.y(), shift.z()) : shift;
  }

  // --- set-up ---

  void linkCorners() {
    first_corner_.assign(positions_.size(), kNoIndex);
    last_corner_.assign(positions_.size(), kNoIndex);
    next_corner_.assign(3 * triangles_.size(), kNoIndex);
    for (Index corner = 0; corner < next_corner_.size(); ++corner) {
      const Index v = triangles_[corner / 3][corner % 3];
      (first_corner_[v] == kNoIndex ? first_corner_[v] : next_corner_[last_corner_[v]]) = corner;
      last_corner_[v] = corner;
    }
    stamp_.assign(positions_.size(), 0);
    seen_.assign(positions_.size(), 0);
  }

  void findBorder() {
    border_.assign(positions_.size(), 0);
    for (const Triangle& t : triangles_) {
      for (int i = 0; i < 3; ++i) {
        if (sharedTriangles(t[i], t[(i + 1) % 3]) == 1) border_[t[i]] = border_[t[(i + 1) % 3]] = 1;
      }
    }
  }

  void sumQuadrics() {
    quadrics_.assign(positions_.size(), {});
    for (const Triangle& t : triangles_) addTriangle(t);
    if (!options_.mirrored_at_x0) return;
    for (Index v = 0; v < positions_.size(); ++v) {
      if (border_[v] != 0) quadrics_[v] += Quadric(quadrics_[v]).mirroredAtX0();
    }
  }

  void addTriangle(const Triangle& t) {
    const Vec3 area2 = areaVector2(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
    const double norm = area2.norm();
    if (norm == 0.0) return;
    const Quadric q = Quadric::ofPlane(area2 / norm, positions_[t[0]], norm / 6.0);
    for (const Index v : t) quadrics_[v] += q;
    if (!options_.mirrored_at_x0) addBorderWalls(t, area2 / norm);
  }

  // A wall through each border edge, upright on its triangle, holds the border's line.
  void addBorderWalls(const Triangle& t, const Vec3& normal) {
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i];
      const Index b = t[(i + 1) % 3];
      if (border_[a] == 0 || border_[b] == 0 || sharedTriangles(a, b) != 1) continue;
      const Vec3 edge = positions_[b] - positions_[a];
      const Quadric wall =
          Quadric::ofPlane(edge.cross(normal).normalized(), positions_[a], options_.border_weight * edge.squaredNorm());
      quadrics_[a] += wall;
      quadrics_[b] += wall;
    }
  }

  // --- the heap ---

  void fillHeap() {
    heap_.clear();
    for (const Triangle& t : triangles_) {
      if (t[0] == kNoIndex) continue;
      for (int i = 0; i < 3; ++i) {
        const Index a = t[i];
        const Index b = t[(i + 1) % 3];
        // Each inner edge is met twice, in both directions.
        if (a < b || (border_[a] != 0 && border_[b] != 0 && sharedTriangles(a, b) == 1))
          heap_.push_back(candidate(a, b));
      }
    }
    std::make_heap(heap_.begin(), heap_.end(), later);
  }

  void collapseToTarget() {
    for (std::size_t before = live_triangles_ + 1; live_triangles_ > target_ && live_triangles_ < before;) {
      before = live_triangles_;
      fillHeap();
      drainHeap();
    }
  }

  void drainHeap() {
    while (live_triangles_ > target_ && !heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const Candidate c = heap_.back();
      heap_.pop_back();
      if (stamp_[c.a] != c.stamp_a || stamp_[c.b] != c.stamp_b) continue;
      tryCollapse(c.a, c.b);
    }
  }

  Candidate candidate(Index a, Index b) const {
    if (a > b) std::swap(a, b);
    const Quadric sum = merged(a, b);
    const double length2 = (positions_[a] - positions_[b]).squaredNorm();
    const double cost = sum.at(placement(sum, a, b)) + kLengthCost * length2 * length2;
    return {cost, a, b, stamp_[a], stamp_[b]};
  }

  // Merging an inner vertex into the plane of symmetry merges its mirror image as well.
  Quadric merged(Index a, Index b) const {
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    if (options_.mirrored_at_x0 && border_[a] != border_[b]) sum += quadrics_[border_[a] != 0 ? b : a].mirroredAtX0();
    return sum;
  }

  Vec3 placement(const Quadric& sum, Index a, Index b) const {
    const Vec3 middle = 0.5 * (positions_[a] + positions_[b]);
    const double length2 = (positions_[a] - positions_[b]).squaredNorm();
    const bool in_plane = options_.mirrored_at_x0 && (border_[a] != 0 || border_[b] != 0);
    Vec3 best = sum.best(middle, kHold);
    if (in_plane) best.x() = 0.0;
    if ((best - middle).squaredNorm() <= length2) return best;
    // The optimum ran away: use the best of the near candidates.
    best = middle;
    if (in_plane) best.x() = 0.0;
    for (const Index v : {a, b}) {
      const bool allowed = !in_plane || border_[v] != 0;
      if (allowed && sum.at(positions_[v]) < sum.at(best)) best = positions_[v];
    }
    return best;
  }

  // --- one collapse ---

  void tryCollapse(Index a, Index b) {
    const Index shared = sharedTriangles(a, b);
    if (shared == 0 || live_triangles_ - target_ < shared || !linkAllows(a, b, shared)) return;
    if (options_.mirrored_at_x0 && border_[a] != border_[b] &&
        makesChord(border_[a] != 0 ? a : b, border_[a] != 0 ? b : a))
      return;
    const Quadric sum = merged(a, b);
    const Vec3 point = placement(sum, a, b);
    const Vec3 around = areaAround(a) + areaAround(b);
    if (turnsOver(a, b, point, around) || turnsOver(b, a, point, around)) return;
    collapse(a, b, point, sum);
    pushEdges(a);
  }

  template <class Visit>
  void forEachTriangleAt(Index v, Visit visit) const {
    for (Index corner = first_corner_[v]; corner != kNoIndex; corner = next_corner_[corner])
      visit(corner / 3, corner % 3);
  }

  Index sharedTriangles(Index a, Index b) const {
    Index count = 0;
    forEachTriangleAt(a, [&](Index t, Index) { count += hasCorner(triangles_[t], b) ? 1 : 0; });
    return count;
  }

  Index triangleCount(Index v) const {
    Index count = 0;
    forEachTriangleAt(v, [&](Index, Index) { ++count; });
    return count;
  }

  // The ends may share no neighbour but the tips of the triangles on the edge, and an inner edge may not join two
  // borders.
  bool linkAllows(Index a, Index b, Index shared) {
    if (shared == 2 && border_[a] != 0 && border_[b] != 0) return false;
    ++round_;
    forEachTriangleAt(a, [&](Index t, Index) {
      for (const Index v : triangles_[t]) seen_[v] = round_;
    });
    seen_[a] = seen_[b] = 0;
    Index common = 0;
    bool keeps_fans = true;
    forEachTriangleAt(b, [&](Index t, Index) {
      for (const Index v : triangles_[t]) {
        if (seen_[v] != round_) continue;
        seen_[v] = 0;
        ++common;
        keeps_fans = keeps_fans && (border_[v] != 0 || triangleCount(v) > 3);
      }
    });
    return common == shared && keeps_fans;
  }

  // Whether merging `inner` into `border` joins two border vertices by an inner edge: its mirror image would be the
  // same edge, used by four triangles.
  bool makesChord(Index border, Index inner) const {
    bool chord = false;
    forEachTriangleAt(inner, [&](Index t, Index) {
      for (const Index v : triangles_[t]) {
        chord = chord || (v != border && border_[v] != 0 && sharedTriangles(border, v) != 1);
      }
    });
    return chord;
  }

  Vec3 areaAround(Index v) const {
    Vec3 sum = Vec3::Zero();
    forEachTriangleAt(v, [&](Index t, Index) {
      const Triangle& i = triangles_[t];
      sum += areaVector2(positions_[i[0]], positions_[i[1]], positions_[i[2]]);
    });
    return sum;
  }

  // Whether moving v to the point folds or flattens one of its triangles that stay (those without `other`).
  bool turnsOver(Index v, Index other, const Vec3& point, const Vec3& around) const {
    bool turned = false;
    forEachTriangleAt(v, [&](Index t, Index corner) {
      const Triangle& triangle = triangles_[t];
      if (turned || hasCorner(triangle, other)) return;
      const Vec3& p = positions_[triangle[(corner + 1) % 3]];
      const Vec3& q = positions_[triangle[(corner + 2) % 3]];
      turned = spoils(areaVector2(positions_[v], p, q), areaVector2(point, p, q), around);
      turned = turned || (avoid_slivers_ && shapeOf(point, p, q) < kSliver && shapeOf(positions_[v], p, q) >= kSliver);
    });
    return turned;
  }

  static bool spoils(const Vec3& before, const Vec3& after, const Vec3& around) {
    const double dust = kDust * around.norm();
    if (before.norm() > dust) return before.dot(after) <= kMinTurnCosine * before.norm() * after.norm();
    return after.norm() > dust && around.dot(after) <= kMinTurnCosine * around.norm() * after.norm();
  }

  void collapse(Index a, Index b, const Vec3& point, const Quadric& sum) {
    positions_[a] = point;
    quadrics_[a] = sum;
    border_[a] = static_cast<char>(border_[a] | border_[b]);
    std::vector<Index>& gone = scratch_;
    gone.clear();
    forEachTriangleAt(b, [&](Index t, Index corner) {
      if (hasCorner(triangles_[t], a))
        gone.push_back(t);
      else
        triangles_[t][corner] = a;
    });
    joinCorners(a, b);
    for (const Index t : gone) removeTriangle(t, b);
    ++stamp_[a];
    ++stamp_[b];
  }

  void joinCorners(Index a, Index b) {
    next_corner_[last_corner_[a]] = first_corner_[b];
    last_corner_[a] = last_corner_[b];
    first_corner_[b] = last_corner_[b] = kNoIndex;
  }

  // `merged` is the vertex whose corners were handed over already.
  void removeTriangle(Index t, Index merged) {
    const Triangle corners = triangles_[t];
    triangles_[t] = {kNoIndex, kNoIndex, kNoIndex};
    --live_triangles_;
    for (const Index v : corners) {
      if (v != merged) dropDeadCorners(v);
    }
  }

  void dropDeadCorners(Index v) {
    Index* link = &first_corner_[v];
    last_corner_[v] = kNoIndex;
    while (*link != kNoIndex) {
      if (triangles_[*link / 3][0] == kNoIndex) {
        *link = next_corner_[*link];
      } else {
        last_corner_[v] = *link;
        link = &next_corner_[*link];
      }
    }
  }

  void pushEdges(Index a) {
    ++round_;
    seen_[a] = round_;
    forEachTriangleAt(a, [&](Index t, Index) {
      for (const Index v : triangles_[t]) {
        if (seen_[v] == round_) continue;
        seen_[v] = round_;
        heap_.push_back(candidate(a, v));
        std::push_heap(heap_.begin(), heap_.end(), later);
      }
    });
  }

  [[noreturn]] void throwUnreachable() const {
    throw Error("cannot reduce to " + std::to_string(target_) + " triangles: the topology stops at " +
                std::to_string(live_triangles_) + " (a closed surface has an even count)");
  }

  DecimateOptions options_;
  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;  // removed ones hold kNoIndex
  std::size_t live_triangles_;
  std::size_t target_ = 0;
  bool avoid_slivers_ = true;
  Vec3 origin_;
  std::vector<Quadric> quadrics_;
  std::vector<char> border_;
  std::vector<Index> first_corner_, last_corner_;  // per vertex, corner = 3 * triangle + place
  std::vector<Index> next_corner_;                 // per corner
  std::vector<std::uint32_t> stamp_;               // raised whenever a vertex moves or dies
  std::vector<std::uint32_t> seen_;                // equals round_ when met in this round
  std::uint32_t round_ = 0;
  std::vector<Candidate> heap_;
  std::vector<Index> scratch_;
};

}  // namespace

TriangleMesh decimate(TriangleMesh mesh, std::size_t target_triangles, const DecimateOptions& options) {
  if (mesh.triangles.size() <= target_triangles) return mesh;
  Decimator decimator(std::move(mesh), options);
  decimator.reduceTo(target_triangles);
  return decimator.result();
}

}  // namespace palpate::mesh
