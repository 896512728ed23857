#include "study/tree_pictures.h"

#include <limits>

namespace palpate::study {

namespace {

// Darker than the series' green and orange, so that three see-through planes stay apart.
constexpr std::array kPlaneColours{figures::Colour{0.10, 0.65, 0.25, 0.40}, figures::Colour{0.85, 0.15, 0.15, 0.40},
                                   figures::Colour{0.95, 0.80, 0.10, 0.50}};

figures::Sheet sheetAcross(const partition::Box3& cell, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  figures::Sheet sheet;
  sheet.corner = cell.min();
  sheet.corner[axis] = partition::splitPoint(cell)[axis];
  sheet.side_u = cell.sizes()[u] * Vec3::Unit(u);
  sheet.side_v = cell.sizes()[v] * Vec3::Unit(v);
  sheet.colour = kPlaneColours[static_cast<std::size_t>(axis)];
  return sheet;
}

}  // namespace

partition::Partition grownTree(const mesh::TriangleMesh& mesh, partition::TreeKind kind, Index threshold) {
  partition::BuildSettings settings;
  settings.tree = kind;
  settings.threshold = threshold;
  return partition::buildPartition(mesh, settings);
}

std::vector<figures::Sheet> splittingSheets(const partition::Partition& tree, int levels) {
  std::vector<figures::Sheet> sheets;
  for (Index i = 0; i < tree.tree_node_count; ++i) {
    const partition::Node& node = tree.nodes[i];
    if (!node.is_leaf && node.level < levels) {
      sheets.push_back(sheetAcross(tree.cells[i], partition::splitAxis(node.level)));
    }
  }
  return sheets;
}

std::vector<std::array<Vec3, 2>> leafBoxes(const partition::Partition& tree) {
  std::vector<std::array<Vec3, 2>> edges;
  for (const Index leaf : tree.leaves) {
    const auto box = figures::boxEdges(tree.cells[leaf]);
    edges.insert(edges.end(), box.begin(), box.end());
  }
  return edges;
}

std::vector<figures::Colour> hapticColours(const partition::Partition& tree, const partition::LeafHits& hits) {
  std::vector<figures::Colour> colours(tree.triangle_count, figures::kSkin);
  for (const Index leaf : hits.leaves) {
    for (const Index triangle : partition::trianglesOf(tree, tree.nodes[leaf])) colours[triangle] = kHapticGreen;
  }
  return colours;
}

}  // namespace palpate::study
