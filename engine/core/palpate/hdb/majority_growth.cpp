// Grows a tree with case C: each triangle goes to the side on which two of its three vertices lie.
//
// That side is the side of the middle one of the three coordinates, so a triangle is a point here: its middle x, middle
// y and middle z. An octree decides axis by axis, which is three case-C tests in a row: the printed rule "at least two
// vertices in the same octant" loses triangles with vertices in three octants (E6). Items are divided in place and
// keep their order.
//
// Data flow: mesh -> here -> the tree in a Growth -> finishPartition (partition.cpp). At load time.
// Based on: Ji, dissertation 2008, 3.3.2 (case C) and 3.4, as E6 corrects it.
#include <algorithm>

#include "palpate/hdb/detail/growth.h"

namespace palpate::hdb {

namespace {

std::vector<Item> middlePoints(const mesh::TriangleMesh& mesh) {
  std::vector<Item> items;
  items.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) items.push_back({middlePoint(mesh, t), t, 0});
  return items;
}

struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

class MajorityGrowth {
 public:
  explicit MajorityGrowth(Growth& growth)
      : growth_(growth), items_(growth.items), aside_(growth.items.size()), share_(1.0 / items_.size()) {}

  void grow(Index node, const Range& range) {
    const int level = growth_.nodes[node].level;
    if (range.size() <= growth_.most_in_leaf || level >= mostLevels(growth_.tree) || allEqual(range)) {
      makeLeaf(growth_, node, range.begin, range.size(), static_cast<double>(range.size()) * share_);
      return;
    }
    std::vector<std::uint8_t> slots;
    const std::vector<Range> parts = divide(node, range, slots);
    const Index first = addChildren(growth_, node, slots);
    for (Index i = 0; i < parts.size(); ++i) grow(first + i, parts[i]);
  }

 private:
  /// No plane separates coincident triangles (E7). Ends at the first difference, as a rule the second item.
  bool allEqual(const Range& range) const {
    const std::span<const Item> items(items_.data() + range.begin, range.size());
    return std::ranges::all_of(items, [&](const Item& item) { return item.point == items.front().point; });
  }

  /// The parts that are not empty, with their slots.
  std::vector<Range> divide(Index node, const Range& range, std::vector<std::uint8_t>& slots) {
    std::vector<Range> parts;
    const auto append = [&](const Range& part, int slot) {
      if (part.size() == 0) return;
      parts.push_back(part);
      slots.push_back(static_cast<std::uint8_t>(slot));
    };
    const auto halves = [this](const Range& whole, int axis, const Vec3& at) { return halve(whole, axis, at); };
    divideAmongChildren(growth_, node, range, halves, append);
    return parts;
  }

  /// Negative side first, each in its old order. Every item is written to both ends and only one end moves on: no
  /// branch that the processor could guess wrong.
  std::array<Range, 2> halve(const Range& range, int axis, const Vec3& at) {
    std::size_t negative = range.begin;
    std::size_t positive = 0;
    const double plane = at[axis];
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Item item = items_[i];
      const std::size_t is_positive = item.point[axis] >= plane ? 1 : 0;  // E9
      items_[negative] = item;
      aside_[positive] = item;
      negative += 1 - is_positive;
      positive += is_positive;
    }
    std::copy_n(aside_.begin(), positive, items_.begin() + static_cast<std::ptrdiff_t>(negative));
    return {Range{range.begin, negative}, Range{negative, range.end}};
  }

  Growth& growth_;
  std::vector<Item>& items_;
  std::vector<Item> aside_;  // the positive side of the range that is being halved
  double share_;             // share of the progress per triangle
};

}  // namespace

void growByMajority(Growth& growth, const mesh::TriangleMesh& mesh) {
  growth.items = middlePoints(mesh);
  MajorityGrowth(growth).grow(0, {0, growth.items.size()});
}

}  // namespace palpate::hdb
