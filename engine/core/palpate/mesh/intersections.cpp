// A complete binary tree of boxes over triangles in Morton order, descended against itself.
//
// The descent falls apart into a hundred tasks that share nothing, for as many threads as there are processors. Tasks
// and what each may cost depend on the mesh alone, so the answer does too.
//
// Based on: Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees", 2012 (boxes over a
// Morton order); Shewchuk, "Adaptive precision floating-point arithmetic", 1997 (the error bound of orient3d).
#include "palpate/mesh/intersections.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <tuple>

#include "palpate/base/background.h"
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

/// Without branches between the six comparisons, which no processor could foresee.
bool overlap(const Box& a, const Box& b) {
  return bool((a.low[0] <= b.high[0]) & (a.low[1] <= b.high[1]) & (a.low[2] <= b.high[2]) & (b.low[0] <= a.high[0]) &
              (b.low[1] <= a.high[1]) & (b.low[2] <= a.high[2]));
}

void include(Box& box, const Box& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::min(box.low[i], other.low[i]);
    box.high[i] = std::max(box.high[i], other.high[i]);
  }
}

/// Rounded outwards, so that a float box never misses what the doubles touch.
Box roundedOutBox(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 low = a.cwiseMin(b).cwiseMin(c);
  const Vec3 high = a.cwiseMax(b).cwiseMax(c);
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = std::nextafter(static_cast<float>(low[static_cast<Eigen::Index>(i)]), -kInfinity);
    box.high[i] = std::nextafter(static_cast<float>(high[static_cast<Eigen::Index>(i)]), kInfinity);
  }
  return box;
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

enum class Meeting : std::uint8_t { none, touches, pierces };

/// False for an edge in the plane of the triangle, up to rounding: the pieces of a side that was split at many vertices
/// are in line, and would all seem to touch each other's triangles.
bool leavesPlane(const Vec3& p, const Vec3& q, const std::array<const Vec3*, 3>& t) {
  constexpr double kFlat = 1e-9;  // height per length of the edge; rounding leaves 1e-15
  const Vec3 normal = areaVector2(*t[0], *t[1], *t[2]);
  return std::abs(normal.dot(q - p)) > kFlat * normal.norm() * (q - p).norm();
}

/// Sharing vertices is the caller's concern. The ends must be clearly on both sides; the crossing point may be on the
/// border of the triangle, where the lattices of cubes and grids often meet: then it touches.
Meeting classifyMeeting(const Vec3& p, const Vec3& q, const std::array<const Vec3*, 3>& t) {
  if (side(*t[0], *t[1], *t[2], p) * side(*t[0], *t[1], *t[2], q) >= 0) return Meeting::none;
  const std::array<int, 3> turns = {side(p, q, *t[0], *t[1]), side(p, q, *t[1], *t[2]), side(p, q, *t[2], *t[0])};
  const auto [low, high] = std::minmax_element(turns.begin(), turns.end());
  if (*low < 0 && *high > 0) return Meeting::none;
  if (std::count(turns.begin(), turns.end(), 0) == 0) return Meeting::pierces;
  return leavesPlane(p, q, t) ? Meeting::touches : Meeting::none;
}

/// True only where no edge of `t` can have its ends on both sides of the plane of `plane` for side(), except those with
/// a vertex in common: one normal and three heights decide it for most pairs.
bool onOneSide(const std::vector<Vec3>& positions, const Triangle& t, const Triangle& plane) {
  const Vec3& a = positions[plane[0]];
  const Vec3 ab = positions[plane[1]] - a;
  const Vec3 ac = positions[plane[2]] - a;
  const Vec3 normal = ab.cross(ac);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double longest = 0.0;
  for (const Index v : t) {
    if (hasCorner(plane, v)) continue;
    const Vec3 from_a = positions[v] - a;
    const double height = normal.dot(from_a);
    low = std::min(low, height);
    high = std::max(high, height);
    longest = std::max(longest, from_a.lpNorm<Eigen::Infinity>());
  }
  // Rounding makes less than 24 epsilon of the longest coordinates' product; ten times that leaves no doubt.
  constexpr double kRounding = 240 * std::numeric_limits<double>::epsilon();
  const double bound = kRounding * ab.lpNorm<Eigen::Infinity>() * ac.lpNorm<Eigen::Infinity>() * longest;
  return low > bound || high < -bound;
}

// --- the search ---

constexpr std::size_t kTrianglesPerLeaf = 4;
/// Work is counted in box tests (about 3 ns); testing a pair of triangles costs as much as this many.
constexpr std::size_t kPairCost = 16;
/// A sound mesh needs about 130 a triangle. A cloud where everything overlaps everything would need the square of the
/// number of triangles: give up at this many. Fans (the caps of a cylinder) overlap like that too and are sound, so a
/// small mesh is searched whatever it looks like: 0.1 s, which is every pair of 1,900 triangles.
constexpr std::size_t kWorkPerTriangle = 1000;
constexpr std::size_t kMinWork = 30'000'000;

/// Complete binary tree: node n has the children 2 n and 2 n + 1, leaves start at `leaves`.
struct BoxTree {
  std::vector<Index> order;  // triangles along Morton's curve
  std::vector<Box> boxes;    // in that order
  std::vector<Box> nodes;
  std::size_t leaves = 0;

  explicit BoxTree(const TriangleMesh& mesh)
      : order(mortonOrder(triangleCentres(mesh))),
        leaves(std::bit_ceil((order.size() + kTrianglesPerLeaf - 1) / kTrianglesPerLeaf)) {
    boxes.reserve(order.size());
    for (const Index t : order) {
      const auto& [a, b, c] = mesh.triangles[t];
      boxes.push_back(roundedOutBox(mesh.positions[a], mesh.positions[b], mesh.positions[c]));
    }
    nodes.assign(2 * leaves, kEmptyBox);
    for (std::size_t i = 0; i < boxes.size(); ++i) include(nodes[leaves + i / kTrianglesPerLeaf], boxes[i]);
    for (std::size_t node = leaves - 1; node > 0; --node) {
      include(nodes[node], nodes[2 * node]);
      include(nodes[node], nodes[2 * node + 1]);
    }
  }
};

/// All pairs of triangles below one node (a == b), or with one below each of two nodes of the same level.
struct Task {
  std::size_t a = 1;
  std::size_t b = 1;
  std::size_t work = 0;  // limit of its cost
};

/// Does one task.
class PairSearch {
 public:
  PairSearch(const TriangleMesh& mesh, const BoxTree& tree, const Task& task)
      : mesh_(mesh), tree_(tree), work_left_(task.work) {
    if (task.a == task.b) {
      searchWithin(task.a);
    } else {
      searchBetween(task.a, task.b);
    }
  }

  bool complete() const { return work_left_ > 0; }
  std::size_t workLeft() const { return work_left_; }
  const std::vector<Crossing>& crossings() const { return crossings_; }

 private:
  void searchWithin(std::size_t node) {
    if (node >= tree_.leaves) {
      testLeaves(node, node);
      return;
    }
    searchWithin(2 * node);
    searchWithin(2 * node + 1);
    searchBetween(2 * node, 2 * node + 1);
  }

  void searchBetween(std::size_t a, std::size_t b) {
    if (work_left_ == 0) return;
    --work_left_;
    if (!overlap(tree_.nodes[a], tree_.nodes[b])) return;
    if (a >= tree_.leaves) {
      testLeaves(a, b);
      return;
    }
    for (std::size_t child_a : {2 * a, 2 * a + 1}) {
      for (std::size_t child_b : {2 * b, 2 * b + 1}) searchBetween(child_a, child_b);
    }
  }

  void testLeaves(std::size_t a, std::size_t b) {
    const std::size_t first_a = (a - tree_.leaves) * kTrianglesPerLeaf;
    const std::size_t first_b = (b - tree_.leaves) * kTrianglesPerLeaf;
    const std::size_t end_a = std::min(first_a + kTrianglesPerLeaf, tree_.order.size());
    const std::size_t end_b = std::min(first_b + kTrianglesPerLeaf, tree_.order.size());
    for (std::size_t i = first_a; i < end_a; ++i) {
      for (std::size_t j = a == b ? i + 1 : first_b; j < end_b; ++j) {
        if (overlap(tree_.boxes[i], tree_.boxes[j])) testTriangles(tree_.order[i], tree_.order[j]);
      }
    }
  }

  void testTriangles(Index a, Index b) {
    if (work_left_ == 0) return;
    work_left_ -= std::min(work_left_, kPairCost);
    const Triangle& ta = mesh_.triangles[a];
    const auto shared = std::count_if(ta.begin(), ta.end(), [&](Index v) { return hasCorner(mesh_.triangles[b], v); });
    if (shared > 1) return;  // every edge of one has a vertex of the other
    if (!onOneSide(mesh_.positions, ta, mesh_.triangles[b])) testEdges(a, b);
    if (!onOneSide(mesh_.positions, mesh_.triangles[b], ta)) testEdges(b, a);
  }

  void testEdges(Index with_edges, Index pierced) {
    const Triangle& edges = mesh_.triangles[with_edges];
    const Triangle& target = mesh_.triangles[pierced];
    const std::array<const Vec3*, 3> corners = {&mesh_.positions[target[0]], &mesh_.positions[target[1]],
                                                &mesh_.positions[target[2]]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = edges[i];
      const Index q = edges[(i + 1) % 3];
      if (hasCorner(target, p) || hasCorner(target, q)) continue;
      const Meeting meeting = classifyMeeting(mesh_.positions[p], mesh_.positions[q], corners);
      if (meeting == Meeting::none) continue;
      crossings_.push_back({std::min(p, q), std::max(p, q), pierced, meeting == Meeting::touches});
    }
  }

  const TriangleMesh& mesh_;
  const BoxTree& tree_;
  std::size_t work_left_;
  std::vector<Crossing> crossings_;
};

// --- tasks and threads ---

/// The tree is cut this many levels below its root: 64 parts to search within, and 63 pairs above them.
constexpr std::size_t kTaskLevels = 6;

/// Half of the work is for within the parts; each level of pairs above has an equal share of the other half.
std::vector<Task> makeTasks(const BoxTree& tree) {
  const std::size_t work = kMinWork + kWorkPerTriangle * tree.order.size();
  const std::size_t parts = std::size_t{1} << kTaskLevels;
  if (tree.leaves < parts) return {{1, 1, work}};
  std::vector<Task> tasks;
  for (std::size_t node = 1; node < parts; ++node) {
    const std::size_t pairs_of_level = std::bit_floor(node);
    tasks.push_back({2 * node, 2 * node + 1, work / (2 * kTaskLevels * pairs_of_level)});
  }
  for (std::size_t node = parts; node < 2 * parts; ++node) tasks.push_back({node, node, work / (2 * parts)});
  return tasks;
}

// --- the answer ---

bool isBefore(const Crossing& l, const Crossing& r) {
  return std::tie(l.low, l.high, l.triangle) < std::tie(r.low, r.high, r.triangle);
}

void sortUnique(std::vector<Index>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

/// An edge that pierces one triangle and touches another is one that pierces. Both its triangles find it: once counts.
void countEdges(Intersections& found) {
  auto& all = found.crossings;
  std::sort(all.begin(), all.end(), isBefore);
  const auto same = [](const Crossing& l, const Crossing& r) { return !isBefore(l, r) && !isBefore(r, l); };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  for (auto first = all.begin(); first != all.end();) {
    const auto end =
        std::find_if(first, all.end(), [&](const Crossing& c) { return c.low != first->low || c.high != first->high; });
    const bool only_touches = std::all_of(first, end, [](const Crossing& c) { return c.touches; });
    ++found.piercing_edges;
    found.touching_edges += only_touches ? 1 : 0;
    for (; first != end; ++first) {
      if (only_touches) found.touched_triangles.push_back(first->triangle);
      if (!first->touches) found.pierced_triangles.push_back(first->triangle);
    }
  }
  sortUnique(found.pierced_triangles);
  sortUnique(found.touched_triangles);
}

class SelfSearch {
 public:
  SelfSearch(const TriangleMesh& mesh, const Progress& progress) : mesh_(mesh), progress_(progress) {
    report(progress_, "looking for self-intersections", 0.0);
  }

  Intersections run() {
    if (mesh_.triangles.empty()) return finished();
    tree_.emplace(mesh_);
    tasks_ = makeTasks(*tree_);
    std::vector<Background> helpers;
    for (std::size_t i = 1; i < workers(); ++i) helpers.emplace_back([this] { work({}); });
    work(progress_);
    for (Background& helper : helpers) helper.join();
    retryWithSpareBudget();
    return finished();
  }

 private:
  /// Starting a thread costs some tasks of a small mesh.
  std::size_t workers() const {
    constexpr std::size_t kMinTriangles = 20000;
    return tree_->order.size() < kMinTriangles ? 1 : std::min(processors(), tasks_.size());
  }

  void work(const Progress& progress) {
    for (std::size_t task = next_++; task < tasks_.size(); task = next_++) {
      const PairSearch search(mesh_, *tree_, tasks_[task]);
      add(task, search);
      report(progress, "looking for self-intersections", static_cast<double>(task) / tasks_.size());
    }
  }

  void add(std::size_t task, const PairSearch& search) {
    const std::lock_guard lock(mutex_);
    crossings_.insert(crossings_.end(), search.crossings().begin(), search.crossings().end());
    work_left_ += search.workLeft();
    if (!search.complete()) given_up_.push_back(task);
  }

  /// Spends the budget that most tasks did not need on those that ran out: a cap whose boxes all overlap is in one of
  /// them.
  void retryWithSpareBudget() {
    std::sort(given_up_.begin(), given_up_.end());
    for (const std::size_t task : given_up_) {
      Task again = tasks_[task];
      again.work += work_left_;
      const PairSearch search(mesh_, *tree_, again);
      crossings_.insert(crossings_.end(), search.crossings().begin(), search.crossings().end());
      work_left_ = search.workLeft();
      complete_ = complete_ && search.complete();
    }
  }

  Intersections finished() {
    Intersections result;
    result.crossings = std::move(crossings_);
    countEdges(result);
    result.complete = complete_;
    return result;
  }

  const TriangleMesh& mesh_;
  const Progress& progress_;
  std::optional<BoxTree> tree_;
  std::vector<Task> tasks_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;  // guards what follows
  std::vector<Crossing> crossings_;
  std::vector<std::size_t> given_up_;  // tasks that ran out of work
  std::size_t work_left_ = 0;          // left over from tasks
  bool complete_ = true;
};

}  // namespace

Intersections findIntersections(const TriangleMesh& mesh, const Progress& progress) {
  return SelfSearch(mesh, progress).run();
}

}  // namespace palpate::mesh
