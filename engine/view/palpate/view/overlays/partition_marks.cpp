// A plane is the rectangle that it cuts out of a node's cell: one in a BSP tree's node, three in an octree's.
// Data flow: Partition, proxy -> here -> Lines, Patches -> line_layer.h.
// Based on: Ji, dissertation 2008, chapter 3, Fig 3.6.
#include "palpate/view/overlays/overlays.h"

#include <cmath>

#include "palpate/scene/hdb_source.h"
#include "palpate/view/overlays/marks.h"

namespace palpate::view {

namespace {

/// Each level has this share of the opacity above; those below the least are left out.
constexpr double kLevelShare = 0.8;
constexpr double kMinShare = 0.1;
constexpr double kBoxFill = 0.04;

/// The rectangle that the plane square to `axis` cuts out of a cell.
std::array<Vec3, 4> rectangleIn(const Box3& cell, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::array<Vec3, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i][axis] = hdb::splitPoint(cell)[axis];
    corners[i][u] = i == 1 || i == 2 ? cell.max()[u] : cell.min()[u];
    corners[i][v] = i >= 2 ? cell.max()[v] : cell.min()[v];
  }
  return corners;
}

void addPlane(const Box3& cell, int axis, double share, Lines& lines, Patches& patches) {
  const std::array<Vec3, 4> corners = rectangleIn(cell, axis);
  const Paint paint = faded(kPlanePaints[axis], share);
  for (int i = 0; i < 4; ++i) lines.add(corners[i], corners[(i + 1) % 4], paint);
  patches.addQuad(corners, faded(paint, kBoxFill));
}

}  // namespace

ShownPartition makeShownPartition(const scene::World& world) {
  const auto source = world.hdb ? world.hdb : scene::buildHdbSource(world.scene, world.body->skin, world.surface);
  return {source->partition, source->settings.edges_mm};
}

void addLeafBoxes(const hdb::Partition& partition, Lines& lines) {
  for (const Index leaf : partition.leaves) lines.addBox(partition.cells[leaf], kLeafBoxPaint);
}

void addPlanes(const hdb::Partition& partition, Lines& lines, Patches& patches) {
  for (Index n = 0; n < partition.tree_node_count; ++n) {
    const hdb::Node& node = partition.nodes[n];
    const double share = std::pow(kLevelShare, node.level);
    if (node.is_leaf || share < kMinShare) continue;
    if (partition.tree == hdb::TreeKind::Bsp) {
      addPlane(partition.cells[n], hdb::splitAxis(node.level), share, lines, patches);
    } else {
      for (int axis = 0; axis < 3; ++axis) addPlane(partition.cells[n], axis, share, lines, patches);
    }
  }
}

void addDetectingBox(const ShownPartition& shown, const contact::FingerOutput& contact, Lines& lines) {
  lines.addBox(hdb::hapticBox(contact.proxy, shown.box_edges_mm), kDetectingBoxPaint);
}

void addHapticTriangles(const ShownPartition& shown, const scene::World& world, const DrawnSkin& skin,
                        const contact::FingerOutput& contact, Patches& patches) {
  hdb::LeafHits hits;
  hdb::findLeaves(*shown.partition, hdb::hapticBox(contact.proxy, shown.box_edges_mm), hits);
  for (const Index leaf : hits.leaves) {
    for (const Index t : hdb::trianglesOf(*shown.partition, shown.partition->nodes[leaf])) {
      const Triangle& v = world.body->skin.triangles[t];
      patches.addTriangle(skin.at(v[0]), skin.at(v[1]), skin.at(v[2]), kHapticTrianglePaint);
    }
  }
}

}  // namespace palpate::view
