// Builds the triangle tree: ranges of triangles are cut by the surface area heuristic until eight of them fill a node.
//
// Instead of a binary tree that is collapsed afterwards, each node cuts its own range: of the parts so far, the one
// with the largest surface is cut next. A leaf is a part of at most kLeafTriangles. The parts below the root's children
// are cut by several threads, each child by one, and joined in the order of the children: the same tree however many
// there are. Neighbours of triangles and far plates are made in parallel.
//
// Based on: Wald, "On fast construction of SAH-based bounding volume hierarchies" (2007) for the binned heuristic.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "palpate/base/background.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/mesh/topology.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

namespace {

constexpr std::size_t kLeafTriangles = 4;  // fewer cost nodes, more cost triangle tests
constexpr int kBins = 16;
/// One thread cuts as many in 10 to 20 ms: fewer are not worth another.
constexpr std::size_t kSharedTriangles = 20'000;
constexpr std::string_view kTreeStage = "building the tree";
/// Cutting fewer triangles, and all below them, takes less than 0.1 s.
constexpr std::size_t kReportedCut = 50'000;
/// Share of the time until records and plates are filled.
constexpr double kBuilt = 0.7;
/// Below this level ranges are halved by count, so that no input can nest deeper than kMaxTreeLevels: 28 bits of
/// triangles are used up after 28 more levels.
constexpr int kHeuristicLevels = 32;
static_assert(kHeuristicLevels + 28 < kMaxTreeLevels);

struct Box {
  std::array<float, 3> low = {INFINITY, INFINITY, INFINITY};
  std::array<float, 3> high = {-INFINITY, -INFINITY, -INFINITY};

  void extend(const Box& other) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  float halfArea() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
  /// Twice the middle: where a triangle counts as lying when a range is cut.
  float doubleMiddle(int axis) const { return low[axis] + high[axis]; }
};

struct Item {
  Box box;
  Index triangle;
};

struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
  Box box;
  std::size_t size() const { return end - begin; }
};

float nextDown(double value) {
  const auto rounded = static_cast<float>(value);
  return std::nextafterf(static_cast<double>(rounded) > value ? std::nextafterf(rounded, -INFINITY) : rounded,
                         -INFINITY);
}

float nextUp(double value) { return -nextDown(-value); }

class Builder {
 public:
  Builder(const mesh::TriangleMesh& mesh, TriangleTree& tree, const Progress& progress)
      : tree_(tree), progress_(progress) {
    items_.resize(mesh.triangles.size());
    shareOut(items_.size(), kSharedTriangles, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) items_[t] = {unitBox(mesh, mesh.triangles[t]), static_cast<Index>(t)};
    });
  }

  void build() {
    Range all{0, items_.size(), {}};
    for (const Item& item : items_) all.box.extend(item.box);
    std::array<Range, kNodeWidth> parts;
    const int count = cutIntoParts(all, 0, parts, progress_);
    addNode(parts, count, tree_.nodes);
    const std::array<Nodes, kNodeWidth> below = cutBelow(parts, count);
    std::size_t nodes = 1;
    for (const Nodes& part : below) nodes += part.size();
    tree_.nodes.reserve(nodes);
    for (int i = 0; i < count; ++i) {
      tree_.nodes[0].children[i] =
          isLeaf(parts[i]) ? leafLink(parts[i]) : ChildLink::toNode(static_cast<std::uint32_t>(tree_.nodes.size()));
      append(below[i]);
    }
  }

  /// The triangles in the order of the leaves. The boxes are gone afterwards: 24 bytes a triangle.
  std::vector<Index> extractOrder() {
    std::vector<Index> order;
    order.reserve(items_.size());
    for (const Item& item : items_) order.push_back(item.triangle);
    std::vector<Item>().swap(items_);
    return order;
  }

 private:
  Box unitBox(const mesh::TriangleMesh& mesh, const Triangle& triangle) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = mesh.positions[triangle[0]][axis];
      const double b = mesh.positions[triangle[1]][axis];
      const double c = mesh.positions[triangle[2]][axis];
      box.low[axis] = nextDown((std::min({a, b, c}) - tree_.center[axis]) * tree_.to_unit);
      box.high[axis] = nextUp((std::max({a, b, c}) - tree_.center[axis]) * tree_.to_unit);
    }
    return box;
  }

  using Nodes = AlignedVector<WideNode>;

  /// The nodes below each part, which count from its own first.
  std::array<Nodes, kNodeWidth> cutBelow(const std::array<Range, kNodeWidth>& parts, int count) {
    std::array<Nodes, kNodeWidth> below;
    const auto all = static_cast<std::size_t>(count);
    shareOut(all, items_.size() < kSharedTriangles ? all : 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        // The caller, who alone may report, begins with the first part.
        if (!isLeaf(parts[i])) buildNode(parts[i], 1, below[i], begin == 0 ? progress_ : Progress());
      }
    });
    return below;
  }

  void append(const Nodes& nodes) {
    const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
    for (WideNode node : nodes) {
      for (int i = 0; i < kNodeWidth; ++i) {
        const bool is_used = node.low[0][i] <= node.high[0][i];
        if (is_used && !node.children[i].isLeaf())
          node.children[i] = ChildLink::toNode(first + node.children[i].node());
      }
      tree_.nodes.push_back(node);
    }
  }

  /// Returns its index. Children are not linked yet.
  static std::uint32_t addNode(const std::array<Range, kNodeWidth>& parts, int count, Nodes& nodes) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    for (int i = 0; i < kNodeWidth; ++i) setBox(nodes[index], i, i < count ? parts[i].box : Box{});
    return index;
  }

  std::uint32_t buildNode(const Range& range, int level, Nodes& nodes, const Progress& progress) {
    std::array<Range, kNodeWidth> parts;
    const int count = cutIntoParts(range, level, parts, progress);
    const std::uint32_t index = addNode(parts, count, nodes);
    for (int i = 0; i < count; ++i) {
      const ChildLink link =
          isLeaf(parts[i]) ? leafLink(parts[i]) : ChildLink::toNode(buildNode(parts[i], level + 1, nodes, progress));
      nodes[index].children[i] = link;
    }
    return index;
  }

  static ChildLink leafLink(const Range& range) {
    return ChildLink::toLeaf(static_cast<Index>(range.begin), static_cast<Index>(range.size()));
  }

  static bool isLeaf(const Range& range) { return range.size() <= kLeafTriangles; }

  static void setBox(WideNode& node, int slot, const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][slot] = box.low[axis];
      node.high[axis][slot] = box.high[axis];
    }
  }

  /// Cuts the range into up to eight parts, the one with the largest surface first. Returns how many.
  int cutIntoParts(const Range& range, int level, std::array<Range, kNodeWidth>& parts, const Progress& progress) {
    parts[0] = range;
    int count = 1;
    while (count < kNodeWidth) {
      int largest = -1;
      for (int i = 0; i < count; ++i) {
        if (isLeaf(parts[i])) continue;
        if (largest < 0 || parts[i].box.halfArea() > parts[largest].box.halfArea()) largest = i;
      }
      if (largest < 0) break;
      // Keep the parts in the order of their triangles: neighbours in space stay neighbours in memory.
      for (int i = count; i > largest + 1; --i) parts[i] = parts[i - 1];
      const Range whole = parts[largest];
      if (whole.size() >= kReportedCut) reportFrom(whole.begin, progress);
      cut(whole, level, parts[largest], parts[largest + 1]);
      ++count;
    }
    return count;
  }

  void reportFrom(std::size_t triangle, const Progress& progress) {
    if (!progress) return;  // a helper's
    done_ = std::max(done_, static_cast<double>(triangle) / static_cast<double>(items_.size()));
    report(progress, kTreeStage, kBuilt * done_);
  }

  void cut(const Range& range, int level, Range& left, Range& right) {
    const auto [axis, low, high] = widestAxis(range);
    std::size_t middle = range.begin;
    if (level < kHeuristicLevels && high > low) middle = partitionByHeuristic(range, axis, low, high, left, right);
    if (middle == range.begin || middle == range.end) halve(range, axis, left, right);
  }

  struct Extent {
    int axis;
    float low;
    float high;
  };

  Extent widestAxis(const Range& range) const {
    Box middles;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const float middle = items_[i].box.doubleMiddle(axis);
        middles.low[axis] = std::min(middles.low[axis], middle);
        middles.high[axis] = std::max(middles.high[axis], middle);
      }
    }
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (middles.high[axis] - middles.low[axis] > middles.high[widest] - middles.low[widest]) widest = axis;
    }
    return {widest, middles.low[widest], middles.high[widest]};
  }

  struct Bin {
    Box box;
    std::size_t count = 0;
    void add(const Bin& other) {
      box.extend(other.box);
      count += other.count;
    }
    float cost() const { return count == 0 ? 0.0f : box.halfArea() * static_cast<float>(count); }
  };

  /// Returns where the right part begins; range.begin or range.end when the triangles could not be distinguished.
  std::size_t partitionByHeuristic(const Range& range, int axis, float low, float high, Range& left, Range& right) {
    const float scale = static_cast<float>(kBins) / (high - low);
    const auto bin_of = [&](const Item& item) {
      return std::clamp(static_cast<int>((item.box.doubleMiddle(axis) - low) * scale), 0, kBins - 1);
    };
    std::array<Bin, kBins> bins;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Bin& bin = bins[bin_of(items_[i])];
      bin.box.extend(items_[i].box);
      ++bin.count;
    }
    const int first_right = bestCut(bins);
    const auto middle = std::partition(items_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                                       items_.begin() + static_cast<std::ptrdiff_t>(range.end),
                                       [&](const Item& item) { return bin_of(item) < first_right; });
    Bin left_bin, right_bin;
    for (int i = 0; i < kBins; ++i) (i < first_right ? left_bin : right_bin).add(bins[i]);
    const auto split = static_cast<std::size_t>(middle - items_.begin());
    left = {range.begin, split, left_bin.box};
    right = {split, range.end, right_bin.box};
    return split;
  }

  static int bestCut(const std::array<Bin, kBins>& bins) {
    std::array<float, kBins> right_cost{};
    Bin right;
    for (int i = kBins - 1; i > 0; --i) {
      right.add(bins[i]);
      right_cost[i] = right.cost();
    }
    int best = 1;
    float best_cost = INFINITY;
    Bin left;
    for (int i = 1; i < kBins; ++i) {
      left.add(bins[i - 1]);
      const float cost = left.cost() + right_cost[i];
      if (cost < best_cost) {
        best_cost = cost;
        best = i;
      }
    }
    return best;
  }

  void halve(const Range& range, int axis, Range& left, Range& right) {
    const std::size_t middle = range.begin + range.size() / 2;
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(range.begin), at(middle), at(range.end), [&](const Item& l, const Item& r) {
      const float lm = l.box.doubleMiddle(axis), rm = r.box.doubleMiddle(axis);
      return lm != rm ? lm < rm : l.triangle < r.triangle;
    });
    left = {range.begin, middle, {}};
    right = {middle, range.end, {}};
    for (std::size_t i = left.begin; i < left.end; ++i) left.box.extend(items_[i].box);
    for (std::size_t i = right.begin; i < right.end; ++i) right.box.extend(items_[i].box);
  }

  TriangleTree& tree_;
  const Progress& progress_;
  double done_ = 0.0;  // share that the caller has cut
  std::vector<Item> items_;
};

void check(const mesh::TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Error("triangle tree: the mesh has no triangles");
  if (mesh.triangles.size() > ChildLink::kMaxTriangles) {
    throw Error("triangle tree: more than " + std::to_string(ChildLink::kMaxTriangles) + " triangles");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index vertex : mesh.triangles[t]) {
      if (vertex >= mesh.positions.size()) {
        throw Error("triangle tree: triangle " + std::to_string(t) + " uses a vertex that does not exist");
      }
    }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!mesh.positions[v].allFinite()) {
      throw Error("triangle tree: vertex " + std::to_string(v) + " is not finite");
    }
  }
}

void setUnitFrame(const mesh::TriangleMesh& mesh, TriangleTree& tree) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(mesh);
  tree.center = box.center();
  tree.diagonal = box.diagonal().norm();
  const double longest = box.sizes().maxCoeff();
  tree.to_unit = longest > 0.0 ? elementary::exp2(-std::ceil(elementary::log2(longest))) : 1.0;
}

using Neighbours = std::vector<std::array<Index, 3>>;

/// `tree.source_triangle` is there.
void fillRecords(const mesh::TriangleMesh& mesh, const Neighbours& neighbours, TriangleTree& tree,
                 const Progress& progress) {
  const std::size_t count = tree.source_triangle.size();
  std::vector<Index> record_of(count);
  for (Index r = 0; r < count; ++r) record_of[tree.source_triangle[r]] = r;
  tree.records.resize(count);
  report(progress, kTreeStage, 0.82);
  shareOut(count, kSharedTriangles, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index t = tree.source_triangle[r];
      TriangleRecord& record = tree.records[r];
      record.vertices = mesh.triangles[t];
      for (int i = 0; i < 3; ++i) {
        record.corners[i] = mesh.positions[record.vertices[i]];
        const Index neighbour = neighbours[t][i];
        record.neighbours[i] = neighbour == kNoIndex ? kNoIndex : record_of[neighbour];
      }
    }
  });
}

/// Nodes with their boxes, and records.
void buildBoxes(const mesh::TriangleMesh& mesh, TriangleTree& tree, const Progress& progress) {
  Neighbours neighbours;
  Background finding_neighbours([&] { neighbours = mesh::neighboursOfTriangles(mesh); });
  Builder builder(mesh, tree, progress);
  builder.build();
  tree.nodes.shrink_to_fit();
  report(progress, kTreeStage, kBuilt);
  finding_neighbours.join();
  report(progress, kTreeStage, 0.8);
  tree.source_triangle = builder.extractOrder();
  fillRecords(mesh, neighbours, tree, progress);
}

}  // namespace

TriangleTree buildTriangleTree(const mesh::TriangleMesh& mesh, const Progress& progress) {
  check(mesh);
  TriangleTree tree;
  setUnitFrame(mesh, tree);
  buildBoxes(mesh, tree, progress);
  // One writes the plates in the nodes, the other reads only boxes and children there.
  Background filling_far_plates([&] { fillFarPlates(tree); });
  fillPlates(tree, [&](std::string_view, double done) { report(progress, kTreeStage, 0.85 + 0.1 * done); });
  report(progress, kTreeStage, 0.95);
  filling_far_plates.join();
  report(progress, kTreeStage, 1.0);
  return tree;
}

}  // namespace palpate::tree
