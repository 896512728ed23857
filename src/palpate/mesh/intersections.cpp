// A complete binary tree of boxes over triangles in Morton order, descended against itself.
//
// Based on: Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", 2012 (boxes over a
// Morton order); Shewchuk, "Adaptive precision floating-point arithmetic", 1997 (the error bound of orient3d).
#include "palpate/mesh/intersections.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "palpate/mesh/reorder.h"

namespace palpate::mesh {

namespace {

// --- boxes ---

struct Box {
  std::array<float, 3> low;
  std::array<float, 3> high;
};

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Box kEmptyBox = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

bool overlap(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  }
  return true;
}

void include(Box& box, const Box& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], other.low[i]);
    box.high[i] = std::max(box.high[i], other.high[i]);
  }
}

/// Rounded outwards, so that a float box never misses what the doubles touch.
void include(Box& box, const Vec3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto rounded = static_cast<float>(point[static_cast<Eigen::Index>(i)]);
    box.low[i] = std::min(box.low[i], std::nextafter(rounded, -kInfinity));
    box.high[i] = std::max(box.high[i], std::nextafter(rounded, kInfinity));
  }
}

// --- the crossing test ---

/// The sign of the volume of a, b, c, d: on which side of the plane abc is d. 0 when rounding could have made it.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ad = a - d;
  const Vec3 bd = b - d;
  const Vec3 cd = c - d;
  const double bc_z = bd.x() * cd.y();
  const double cb_z = cd.x() * bd.y();
  const double ca_z = cd.x() * ad.y();
  const double ac_z = ad.x() * cd.y();
  const double ab_z = ad.x() * bd.y();
  const double ba_z = bd.x() * ad.y();
  const double volume = ad.z() * (bc_z - cb_z) + bd.z() * (ca_z - ac_z) + cd.z() * (ab_z - ba_z);
  const double permanent = (std::abs(bc_z) + std::abs(cb_z)) * std::abs(ad.z()) +
                           (std::abs(ca_z) + std::abs(ac_z)) * std::abs(bd.z()) +
                           (std::abs(ab_z) + std::abs(ba_z)) * std::abs(cd.z());
  const double bound = 8e-16 * permanent;  // (7 + 56 eps) eps, eps = 2^-53, rounded up
  return volume > bound ? 1 : volume < -bound ? -1 : 0;
}

/// Sharing vertices is the caller's concern. The ends must lie clearly on both sides; the crossing point may lie on the
/// border of the triangle, which is where the lattices of cubes and grids like to meet.
bool pierces(const Vec3& p, const Vec3& q, const std::array<const Vec3*, 3>& t) {
  if (side(*t[0], *t[1], *t[2], p) * side(*t[0], *t[1], *t[2], q) >= 0) return false;
  const std::array<int, 3> turns = {side(p, q, *t[0], *t[1]), side(p, q, *t[1], *t[2]), side(p, q, *t[2], *t[0])};
  const auto [low, high] = std::minmax_element(turns.begin(), turns.end());
  return *low >= 0 || *high <= 0;
}

bool uses(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

// --- the search ---

constexpr std::size_t kTrianglesPerLeaf = 4;
/// Work is counted in box tests (about 3 ns); testing a pair of triangles costs as much as this many.
constexpr std::size_t kPairCost = 16;
/// A sound mesh needs about 130 a triangle. A cloud where everything overlaps everything would need the square of the
/// number of triangles: give up at this many.
constexpr std::size_t kWorkPerTriangle = 1000;
constexpr std::size_t kLeastWork = 10'000'000;

class SelfSearch {
 public:
  SelfSearch(const TriangleMesh& mesh, const Progress& progress)
      : mesh_(mesh), progress_(progress), order_(mortonOrder(triangleCentres(mesh))) {
    work_left_ = kLeastWork + kWorkPerTriangle * order_.size();
    buildTree();
  }

  Intersections run() {
    if (!order_.empty()) searchWithin(1, 0.0, 1.0);
    Intersections result;
    result.piercing_edges = sortAndCountUnique(edges_);
    sortAndCountUnique(triangles_);
    result.pierced_triangles = std::move(triangles_);
    result.complete = work_left_ > 0;
    return result;
  }

 private:
  template <class T>
  static std::size_t sortAndCountUnique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values.size();
  }

  void buildTree() {
    leaves_ = std::bit_ceil((order_.size() + kTrianglesPerLeaf - 1) / kTrianglesPerLeaf);
    boxes_.reserve(order_.size());
    for (Index t : order_) {
      Box box = kEmptyBox;
      for (Index v : mesh_.triangles[t]) include(box, mesh_.positions[v]);
      boxes_.push_back(box);
    }
    nodes_.assign(2 * leaves_, kEmptyBox);
    for (std::size_t i = 0; i < boxes_.size(); ++i) include(nodes_[leaves_ + i / kTrianglesPerLeaf], boxes_[i]);
    for (std::size_t node = leaves_ - 1; node > 0; --node) {
      include(nodes_[node], nodes_[2 * node]);
      include(nodes_[node], nodes_[2 * node + 1]);
    }
  }

  /// All pairs below one node; from and to are its share of the whole, for the progress.
  void searchWithin(std::size_t node, double from, double to) {
    constexpr double kReportedShare = 0.01;
    if (node >= leaves_) {
      testLeaves(node, node);
      return;
    }
    const double middle = 0.5 * (from + to);
    searchWithin(2 * node, from, middle);
    searchWithin(2 * node + 1, middle, to);
    searchBetween(2 * node, 2 * node + 1);
    if (to - from > kReportedShare) report(progress_, "looking for self-intersections", to);
  }

  /// All pairs with one triangle below each of two nodes of the same level.
  void searchBetween(std::size_t a, std::size_t b) {
    if (work_left_ == 0) return;
    --work_left_;
    if (!overlap(nodes_[a], nodes_[b])) return;
    if (a >= leaves_) {
      testLeaves(a, b);
      return;
    }
    for (std::size_t child_a : {2 * a, 2 * a + 1}) {
      for (std::size_t child_b : {2 * b, 2 * b + 1}) searchBetween(child_a, child_b);
    }
  }

  void testLeaves(std::size_t a, std::size_t b) {
    const std::size_t first_a = (a - leaves_) * kTrianglesPerLeaf;
    const std::size_t first_b = (b - leaves_) * kTrianglesPerLeaf;
    const std::size_t end_a = std::min(first_a + kTrianglesPerLeaf, order_.size());
    const std::size_t end_b = std::min(first_b + kTrianglesPerLeaf, order_.size());
    for (std::size_t i = first_a; i < end_a; ++i) {
      for (std::size_t j = a == b ? i + 1 : first_b; j < end_b; ++j) {
        if (overlap(boxes_[i], boxes_[j])) testTriangles(order_[i], order_[j]);
      }
    }
  }

  void testTriangles(Index a, Index b) {
    if (work_left_ == 0) return;
    work_left_ -= std::min(work_left_, kPairCost);
    const Triangle& ta = mesh_.triangles[a];
    const auto shared = std::count_if(ta.begin(), ta.end(), [&](Index v) { return uses(mesh_.triangles[b], v); });
    if (shared > 1) return;  // every edge of one has a vertex of the other
    testEdges(a, b);
    testEdges(b, a);
  }

  void testEdges(Index with_edges, Index pierced) {
    const Triangle& edges = mesh_.triangles[with_edges];
    const Triangle& target = mesh_.triangles[pierced];
    const std::array<const Vec3*, 3> corners = {&mesh_.positions[target[0]], &mesh_.positions[target[1]],
                                                &mesh_.positions[target[2]]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = edges[i];
      const Index q = edges[(i + 1) % 3];
      if (uses(target, p) || uses(target, q) || !pierces(mesh_.positions[p], mesh_.positions[q], corners)) continue;
      edges_.push_back(std::uint64_t{std::min(p, q)} << 32 | std::max(p, q));
      triangles_.push_back(pierced);
    }
  }

  const TriangleMesh& mesh_;
  const Progress& progress_;
  std::vector<Index> order_;
  std::size_t leaves_ = 0;
  std::vector<Box> boxes_;  // of triangles, in order_
  std::vector<Box> nodes_;  // node n has the children 2 n and 2 n + 1; leaves from leaves_ on
  std::size_t work_left_ = 0;
  std::vector<std::uint64_t> edges_;
  std::vector<Index> triangles_;
};

}  // namespace

Intersections findIntersections(const TriangleMesh& mesh, const Progress& progress) {
  return SelfSearch(mesh, progress).run();
}

}  // namespace palpate::mesh
