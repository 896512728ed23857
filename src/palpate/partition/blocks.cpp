// Blocks: below each leaf its entries are divided further, by the middle of their widest extent, until a few neighbours
// are left. They are not part of the dissertation's tree; they keep the exact query from testing every triangle of a
// large leaf, whatever threshold was asked for.
#include <algorithm>

#include "palpate/partition/growth.h"

namespace palpate::partition {

namespace {

constexpr Index kBlockEntries = 16;  // fewer cost nodes, more cost box tests
/// Below this many divisions items are halved by number, so that nothing nests deeper than this and 32 more.
constexpr int kDivisionsBySpace = 32;

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

}  // namespace palpate::partition
