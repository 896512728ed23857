// Figures 3.4, 3.6, 3.8, 3.9, 3.13 and 3.15: partitions of surfaces and the triangles that the haptic detecting box
// finds in them.
#include <fmt/format.h>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "dissertation/figures/dissertation_figures.h"
#include "lab/measured/model_meshes.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/literal_traversal.h"
#include "palpate/hdb/partition.h"
#include "report/charts/figure.h"
#include "report/charts/mesh_view.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::MeshView;
using hdb::TreeKind;

// ---- what of a partition is shown on a surface

constexpr figures::Colour kHapticGreen{0.25, 0.70, 0.35};
// Darker than the series' green and orange, so that three see-through planes stay apart.
constexpr std::array kPlaneColours{figures::Colour{0.10, 0.65, 0.25, 0.40}, figures::Colour{0.85, 0.15, 0.15, 0.40},
                                   figures::Colour{0.95, 0.80, 0.10, 0.50}};

figures::Sheet sheetAcross(const Box3& cell, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  figures::Sheet sheet;
  sheet.corner = cell.min();
  sheet.corner[axis] = hdb::splitPoint(cell)[axis];
  sheet.side_u = cell.sizes()[u] * Vec3::Unit(u);
  sheet.side_v = cell.sizes()[v] * Vec3::Unit(v);
  sheet.colour = kPlaneColours[static_cast<std::size_t>(axis)];
  return sheet;
}

/// Case C, as the dissertation chose.
hdb::Partition grownTree(const mesh::TriangleMesh& mesh, hdb::TreeKind kind, Index threshold) {
  hdb::BuildSettings settings;
  settings.tree = kind;
  settings.threshold = threshold;
  return hdb::buildPartition(mesh, settings);
}

/// The splitting planes of the inner nodes above a level: x green, y red, z yellow, as printed.
std::vector<figures::Sheet> splittingSheets(const hdb::Partition& tree, int levels) {
  std::vector<figures::Sheet> sheets;
  for (Index i = 0; i < tree.tree_node_count; ++i) {
    const hdb::Node& node = tree.nodes[i];
    if (!node.is_leaf && node.level < levels) {
      sheets.push_back(sheetAcross(tree.cells[i], hdb::splitAxis(node.level)));
    }
  }
  return sheets;
}

/// The edges of the leaves' cells.
std::vector<std::array<Vec3, 2>> leafBoxes(const hdb::Partition& tree) {
  std::vector<std::array<Vec3, 2>> edges;
  for (const Index leaf : tree.leaves) {
    const auto box = figures::boxEdges(tree.cells[leaf]);
    edges.insert(edges.end(), box.begin(), box.end());
  }
  return edges;
}

/// Green for the triangles in the found leaves, the skin's colour for the others.
std::vector<figures::Colour> colourFoundLeaves(const hdb::Partition& tree, const hdb::LeafHits& hits) {
  std::vector<figures::Colour> colours(tree.triangle_count, figures::kSkin);
  for (const Index leaf : hits.leaves) {
    for (const Index triangle : hdb::trianglesOf(tree, tree.nodes[leaf])) colours[triangle] = kHapticGreen;
  }
  return colours;
}

// ---- the figures

const Vec3 kFromBelow(0.55, -0.75, 0.9);  // view of the back: its relief and the planes are seen

MeshView makeMeshView(const mesh::TriangleMesh& mesh, const std::string& title) {
  MeshView view{.title = title};
  view.positions = mesh.positions;
  view.triangles = mesh.triangles;
  return view;
}

Figure figure34() {
  const mesh::TriangleMesh back = backModel();
  const hdb::Partition tree = grownTree(back, TreeKind::Bsp, 64);
  Figure figure{.columns = 3, .panel_width_px = 330.0, .panel_height_px = 340.0};
  for (int levels = 1; levels <= 3; ++levels) {
    MeshView view = makeMeshView(back, fmt::format("Level {}", levels));
    view.towards_viewer = kFromBelow;
    view.sheets = splittingSheets(tree, levels);
    view.lines.push_back({.segments = figures::boxEdges(tree.bounds), .colour = figures::kBlue});
    figure.panels.emplace_back(view);
  }
  return figure;
}

Figure figure36() {
  const mesh::TriangleMesh back = backModel();
  const hdb::Partition tree = grownTree(back, TreeKind::Bsp, 256);
  MeshView planes = makeMeshView(back, "Splitting planes");
  planes.towards_viewer = kFromBelow;
  planes.sheets = splittingSheets(tree, 100);
  planes.legend = {{"x", {0.10, 0.65, 0.25, 0.7}}, {"y", {0.85, 0.15, 0.15, 0.7}}, {"z", {0.95, 0.80, 0.10, 0.8}}};
  MeshView boxes = makeMeshView(back, fmt::format("{} leaves", tree.leaves.size()));
  boxes.towards_viewer = kFromBelow;
  boxes.lines.push_back({.name = "leaf boxes", .segments = leafBoxes(tree), .colour = figures::kBlue});
  return {.panels = {planes, boxes}, .columns = 2, .panel_width_px = 460.0, .panel_height_px = 440.0};
}

// The surface with the haptic triangles green, the proxy and its box.
MeshView hapticView(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, const hdb::LeafHits& hits,
                    const Vec3& proxy) {
  MeshView view =
      makeMeshView(mesh, fmt::format("{} of {} triangles", hdb::entriesIn(tree, hits.leaves), mesh.triangles.size()));
  view.colours = colourFoundLeaves(tree, hits);
  const Box3 box = hdb::hapticBox(proxy, hdb::hdbEdges(tree.bounds));
  view.lines.push_back({.segments = figures::boxEdges(box), .colour = figures::kBlue});
  view.balls.push_back({proxy, 0.012 * tree.bounds.diagonal().norm(), figures::kVermilion});
  return view;
}

MeshView foundFrom(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, const Vec3& proxy) {
  hdb::LeafHits hits;
  hits.prepareFor(tree);
  hdb::findLeaves(tree, hdb::hapticBox(proxy, hdb::hdbEdges(tree.bounds)), hits);
  return hapticView(mesh, tree, hits, proxy);
}

MeshView literalSearchView(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, const Vec3& proxy) {
  hdb::LeafHits hits;
  hits.prepareFor(tree);
  const Box3 box = hdb::hapticBox(proxy, hdb::hdbEdges(tree.bounds));
  hdb::findLeavesLiterally(tree, hdb::LiteralTraversal::HalfSpace, box, hits);
  return hapticView(mesh, tree, hits, proxy);
}

// The vertex of the mesh nearest to a place seen along z.
Vec3 vertexAt(const mesh::TriangleMesh& mesh, double x, double y) {
  Vec3 nearest = mesh.positions.front();
  const auto distance = [&](const Vec3& p) { return (p.head<2>() - Vec2(x, y)).squaredNorm(); };
  for (const Vec3& position : mesh.positions) {
    if (distance(position) < distance(nearest)) nearest = position;
  }
  return nearest;
}

Figure figure38() {
  const mesh::TriangleMesh back = backModel();
  const hdb::Partition tree = grownTree(back, TreeKind::Bsp, 128);
  MeshView view = foundFrom(back, tree, vertexAt(back, 60.0, 20.0));
  view.edges = true;
  view.legend = {{"haptic triangles", kHapticGreen}};
  return {.panels = {view}, .panel_width_px = 560.0, .panel_height_px = 560.0};
}

Figure figure39() {
  const mesh::TriangleMesh hand = handModel();
  const hdb::Partition tree = grownTree(hand, TreeKind::Bsp, 256);
  const Vec3 tip = vertexAt(hand, 0.0, 150.0);
  Figure figure{.columns = 4, .panel_width_px = 235.0, .panel_height_px = 300.0};
  figure.title = "Above: half-spaces as printed. Below: the boxes of the leaves' triangles";
  for (const bool literal : {true, false}) {
    for (const double height : {90.0, 45.0, 25.0, 0.0}) {
      const Vec3 proxy = tip + Vec3(30.0, 30.0, 60.0).normalized() * height;
      MeshView view = literal ? literalSearchView(hand, tree, proxy) : foundFrom(hand, tree, proxy);
      view.towards_viewer = Vec3(0.9, -0.5, 0.9);
      view.scale_bar = !literal;
      figure.panels.emplace_back(view);
    }
  }
  return figure;
}

Figure figure313() {
  const mesh::TriangleMesh hand = handModel();
  const mesh::TriangleMesh back = backModel(20389);
  const hdb::Partition hand_tree = grownTree(hand, TreeKind::Octree, 256);
  const hdb::Partition back_tree = grownTree(back, TreeKind::Octree, 1024);
  MeshView left =
      makeMeshView(hand, fmt::format("Hand: {} triangles, {} leaves", hand.triangles.size(), hand_tree.leaves.size()));
  left.towards_viewer = Vec3(0.7, -0.6, 0.8);
  left.lines.push_back({.name = "leaf boxes", .segments = leafBoxes(hand_tree), .colour = figures::kBlue});
  MeshView right =
      makeMeshView(back, fmt::format("Back: {} triangles, {} leaves", back.triangles.size(), back_tree.leaves.size()));
  right.towards_viewer = kFromBelow;
  right.lines.push_back({.name = "leaf boxes", .segments = leafBoxes(back_tree), .colour = figures::kBlue});
  return {.panels = {left, right}, .columns = 2, .panel_width_px = 460.0, .panel_height_px = 460.0};
}

Figure figure315() {
  const mesh::TriangleMesh back = backModel(20389);
  const hdb::Partition tree = grownTree(back, TreeKind::Octree, 1024);
  const Vec3 place = vertexAt(back, 50.0, 30.0);
  Figure figure{.columns = 4, .panel_width_px = 245.0, .panel_height_px = 330.0};
  for (const double height : {110.0, 50.0, 20.0, 0.0}) {
    MeshView view = foundFrom(back, tree, place + height * Vec3::UnitZ());
    view.towards_viewer = kFromBelow;
    figure.panels.emplace_back(view);
  }
  return figure;
}

}  // namespace

std::vector<DissertationFigure> treeFigures() {
  const std::string ours = "Our back instead of the author's scan.";
  return {
      {"3.4", "Binary partition: planes across x (green), y (red) and z (yellow)", ours, figure34},
      {"3.6", "Splitting planes and leaf boxes of the BSP tree", ours + " Threshold 256; 1024 gives four leaves.",
       figure36},
      {"3.8", "Leaf borders of case C: the haptic triangles end like saw teeth", ours + " Threshold 128.", figure38},
      {"3.9", "Haptic triangles while the proxy comes closer",
       "Our hand instead of the bunny, threshold 256. The upper row has the far outer leaves that the text describes "
       "(E10); the lower row is the corrected search.",
       figure39},
      {"3.13", "Leaf boxes of octrees", "Our hand instead of the bunny (threshold 256), our back without bones.",
       figure313},
      {"3.15", "The haptic detecting box comes closer to the octree of a back", ours, figure315}};
}

}  // namespace palpate::study
