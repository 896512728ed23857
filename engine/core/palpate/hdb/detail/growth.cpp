// Common part of all ways of growing a tree: how a node gets its children or becomes a leaf, and the blocks below a
// leaf.
//
// Data flow: mesh -> growByMajority, growWithBothSides or growWithCuts -> the tree in a Growth -> addBlocks (here) ->
// finishPartition (partition.cpp). At load time.
// Based on: Ji, dissertation 2008, 3.3.1 and 3.4 for the cells; the blocks are not in it.
#include "palpate/hdb/detail/growth.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::hdb {

namespace {

/// Progress is reported in steps of this share: often enough for a bar, too rarely to cost anything.
constexpr double kProgressStep = 0.01;

double medianOfThree(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

}  // namespace

Vec3 middlePoint(const mesh::TriangleMesh& mesh, Index triangle) {
  const Vec3& a = mesh.positions[mesh.triangles[triangle][0]];
  const Vec3& b = mesh.positions[mesh.triangles[triangle][1]];
  const Vec3& c = mesh.positions[mesh.triangles[triangle][2]];
  return {medianOfThree(a.x(), b.x(), c.x()), medianOfThree(a.y(), b.y(), c.y()), medianOfThree(a.z(), b.z(), c.z())};
}

void WorkDone::add(double share) {
  done_ += share;
  if (done_ < reported_ + kProgressStep) return;
  reported_ = done_;
  report(progress_, "partition", std::min(done_, 1.0));
}

Box3 childCell(TreeKind tree, const Box3& cell, int level, int slot) {
  const Vec3 middle = splitPoint(cell);
  Box3 child = cell;
  const auto halve = [&](int axis, bool positive) { (positive ? child.min() : child.max())[axis] = middle[axis]; };
  if (tree == TreeKind::Bsp) {
    halve(splitAxis(level), slot != 0);
  } else {
    for (int axis = 0; axis < 3; ++axis) halve(axis, ((slot >> axis) & 1) != 0);
  }
  return child;
}

Index addChildren(Growth& growth, Index node, const std::vector<std::uint8_t>& slots) {
  const auto first = static_cast<Index>(growth.nodes.size());
  const std::uint8_t level = growth.nodes[node].level;
  const Box3 cell = growth.cells[node];
  growth.nodes[node].first_child = first;
  growth.nodes[node].child_count = static_cast<std::uint8_t>(slots.size());
  for (const std::uint8_t slot : slots) {
    Node& child = growth.nodes.emplace_back();
    child.level = static_cast<std::uint8_t>(level + 1);
    child.slot = slot;
    growth.cells.push_back(childCell(growth.tree, cell, level, slot));
  }
  return first;
}

void makeLeaf(Growth& growth, Index node, std::size_t first_entry, std::size_t entry_count, double share) {
  if (std::uint64_t{first_entry} + entry_count > kNoIndex)
    throw Error("partition: too many entries; use assign = \"C\" or a larger threshold");
  growth.nodes[node].is_leaf = true;
  growth.nodes[node].first_entry = static_cast<Index>(first_entry);
  growth.nodes[node].entry_count = static_cast<Index>(entry_count);
  growth.leaves.push_back(node);
  growth.work_done.add(kGrowthShare * share);
}

namespace {

/// Below this many divisions items are halved by number, so that nothing nests deeper than this and 32 more.
constexpr int kDivisionsBySpace = 32;

/// Below each leaf its entries are divided further, by the middle of their widest extent, until a few neighbours are
/// left. They are not part of the dissertation's tree; they keep the exact query from testing every triangle of a large
/// leaf, whatever the threshold is.
class BlockBuilder {
 public:
  explicit BlockBuilder(Growth& growth) : growth_(growth), items_(growth.items) {}

  void divide(Index node, int depth) {
    const Index begin = growth_.nodes[node].first_entry;
    const Index count = growth_.nodes[node].entry_count;
    if (count <= kBlockEntries) return;
    const Index left = divideItems(begin, begin + count, depth) - begin;
    const auto first = static_cast<Index>(growth_.nodes.size());
    growth_.nodes[node].first_child = first;
    growth_.nodes[node].child_count = 2;
    addBlock(node, begin, left);
    addBlock(node, begin + left, count - left);
    divide(first, depth + 1);
    divide(first + 1, depth + 1);
  }

 private:
  void addBlock(Index parent, Index first_entry, Index count) {
    Node block;
    block.first_entry = first_entry;
    block.entry_count = count;
    block.level = growth_.nodes[parent].level;
    growth_.nodes.push_back(block);
  }

  /// Returns where the second part begins; neither is empty.
  Index divideItems(Index begin, Index end, int depth) {
    Vec3 low = items_[begin].point, high = low;
    for (Index i = begin + 1; i < end; ++i) {
      low = low.cwiseMin(items_[i].point);
      high = high.cwiseMax(items_[i].point);
    }
    Eigen::Index axis = 0;
    const double widest = (high - low).maxCoeff(&axis);
    const double middle = 0.5 * (low[axis] + high[axis]);
    const bool by_space = widest > 0.0 && depth < kDivisionsBySpace && low[axis] < middle;
    return by_space ? divideBySpace(begin, end, axis, middle) : begin + (end - begin) / 2;
  }

  Index divideBySpace(Index begin, Index end, Eigen::Index axis, double middle) {
    aside_.resize(std::max<std::size_t>(aside_.size(), end - begin));
    Index left = begin, right = 0;
    for (Index i = begin; i < end; ++i) {
      const Item item = items_[i];
      const Index goes_right = item.point[axis] >= middle ? 1 : 0;
      items_[left] = item;
      aside_[right] = item;
      left += 1 - goes_right;
      right += goes_right;
    }
    std::copy_n(aside_.begin(), right, items_.begin() + left);
    return left;
  }

  Growth& growth_;
  std::vector<Item>& items_;
  std::vector<Item> aside_;
};

}  // namespace

void addBlocks(Growth& growth) {
  growth.nodes.reserve(growth.nodes.size() + growth.items.size() / 5);  // about one for six entries, measured
  BlockBuilder builder(growth);
  const double share = kBlocksShare / static_cast<double>(growth.items.size());
  for (const Index leaf : growth.leaves) {
    builder.divide(leaf, 0);
    growth.work_done.add(share * growth.nodes[leaf].entry_count);
  }
}

}  // namespace palpate::hdb
