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
    for (std::size_t i = range.begin + 1; i < range.end; ++i) {
      if (items_[i].point != items_[range.begin].point) return false;
    }
    return true;
  }

  /// The parts that are not empty, with their slots.
  std::vector<Range> divide(Index node, const Range& range, std::vector<std::uint8_t>& slots) {
    const Vec3 at = splitPoint(growth_.cells[node]);
    std::vector<Range> parts;
    const auto append = [&](const Range& part, int slot) {
      if (part.size() == 0) return;
      parts.push_back(part);
      slots.push_back(static_cast<std::uint8_t>(slot));
    };
    if (growth_.tree == TreeKind::Bsp) {
      const auto halves = halve(range, splitAxis(growth_.nodes[node].level), at);
      for (int x = 0; x < 2; ++x) append(halves[x], x);
      return parts;
    }
    const auto by_z = halve(range, 2, at);
    for (int z = 0; z < 2; ++z) {
      const auto by_y = halve(by_z[z], 1, at);
      for (int y = 0; y < 2; ++y) {
        const auto by_x = halve(by_y[y], 0, at);
        for (int x = 0; x < 2; ++x) append(by_x[x], x + 2 * y + 4 * z);
      }
    }
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
