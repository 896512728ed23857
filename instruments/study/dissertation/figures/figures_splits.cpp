// Figures 3.7 and 3.14: where the triangles go that a split crosses.
//
// Based on: Ji, dissertation 2008, sections 3.3.2 and 3.4.1.
#include <array>
#include <cmath>
#include <vector>

#include "dissertation/figures/dissertation_figures.h"
#include "palpate/hdb/partition.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::Colour;
using figures::Shape;

constexpr Colour kFirst{0.62, 0.80, 0.92};   // child on the positive side
constexpr Colour kSecond{0.97, 0.80, 0.62};  // child on the negative side
constexpr Colour kBoth{0.75, 0.60, 0.75};

// A flat patch of uneven triangles, 10 mm a cell, so that a plane through its middle crosses many.
mesh::TriangleMesh unevenPatch() {
  constexpr Index kColumns = 8;
  constexpr Index kRows = 6;
  mesh::TriangleMesh patch;
  for (Index row = 0; row <= kRows; ++row) {
    for (Index column = 0; column <= kColumns; ++column) {
      const double shift_x = 2.6 * std::sin(5.0 * row + 3.0 * column);
      const double shift_y = 2.2 * std::cos(4.0 * row + 7.0 * column);
      const bool inner = row > 0 && row < kRows && column > 0 && column < kColumns;
      patch.positions.emplace_back(10.0 * column + (inner ? shift_x : 0.0) + 5.0 * (row % 2),
                                   10.0 * row + (inner ? shift_y : 0.0), 0.0);
    }
  }
  for (Index row = 0; row < kRows; ++row) {
    for (Index column = 0; column < kColumns; ++column) {
      const Index a = row * (kColumns + 1) + column;
      const Index up = a + kColumns + 1;
      patch.triangles.push_back({a, a + 1, up});
      patch.triangles.push_back({a + 1, up + 1, up});
    }
  }
  return patch;
}

std::vector<Vec2> outlineOf(const std::array<Vec3, 3>& corners) {
  return {corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()};
}

std::array<Vec3, 3> cornersOf(const mesh::TriangleMesh& mesh, Index triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

Shape shapeOf(const std::string& name, const Colour& fill) {
  return {.name = name, .colour = figures::kInk, .fill = fill, .width_px = 0.8};
}

// The root split once along x: one plane, two children.
hdb::Partition splitOnce(const mesh::TriangleMesh& patch, hdb::Assignment assignment) {
  hdb::BuildSettings settings;
  settings.tree = hdb::TreeKind::Bsp;
  settings.assignment = assignment;
  settings.threshold = static_cast<Index>(patch.triangles.size() - 1);
  return hdb::buildPartition(patch, settings);
}

// Number of children that each triangle belongs to.
std::vector<int> countOwners(const hdb::Partition& tree) {
  std::vector<int> owners(tree.triangle_count, 0);
  for (const Index triangle : tree.triangles) ++owners[triangle];
  return owners;
}

// The triangles (with the cut, the pieces) of both children, and those that both own.
std::vector<Shape> childShapes(const mesh::TriangleMesh& patch, const hdb::Partition& tree) {
  const std::vector<int> owners = countOwners(tree);
  const bool cut = tree.assignment == hdb::Assignment::Cut;
  std::vector<Shape> shapes{shapeOf("child 1", kFirst), shapeOf("child 2", kSecond), shapeOf("both children", kBoth)};
  for (const Index leaf : tree.leaves) {
    const hdb::Node& node = tree.nodes[leaf];
    for (Index entry = node.first_entry; entry < node.first_entry + node.entry_count; ++entry) {
      const Index triangle = tree.triangles[entry];
      const std::size_t own = node.slot == 1 ? 0 : 1;
      const std::size_t shown = !cut && owners[triangle] > 1 ? 2 : own;
      shapes[shown].paths.push_back(outlineOf(cut ? tree.pieces[entry] : cornersOf(patch, triangle)));
    }
  }
  if (shapes[2].paths.empty()) shapes.pop_back();
  return shapes;
}

Plot casePlot(const std::string& title, hdb::Assignment assignment) {
  const mesh::TriangleMesh patch = unevenPatch();
  const hdb::Partition tree = splitOnce(patch, assignment);
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x.hidden = true;
  plot.y.hidden = true;
  plot.shapes = childShapes(patch, tree);
  const double at = hdb::splitPoint(tree.cells[0]).x();
  plot.shapes.push_back({.name = "splitting plane",
                         .paths = {{Vec2(at, -4.0), Vec2(at, 64.0)}},
                         .closed = false,
                         .colour = figures::kVermilion,
                         .width_px = 2.0});
  return plot;
}

struct SplitExample {
  std::string text;
  Colour fill;
  std::vector<Vec2> corners;
};

Figure splitCasesFigure() {
  Figure figure{.columns = 3, .panel_width_px = 330.0, .panel_height_px = 320.0};
  figure.panels = {casePlot("A: cut", hdb::Assignment::Cut), casePlot("B: both sides", hdb::Assignment::BothSides),
                   casePlot("C: majority", hdb::Assignment::Majority)};
  return figure;
}

Figure octantFigure() {
  const std::vector<SplitExample> examples{{"3 in the box", kFirst, {{14, 14}, {34, 18}, {20, 34}}},
                                           {"2 in the box", kFirst, {{34, 30}, {62, 36}, {40, 46}}},
                                           {"1 in the box", kSecond, {{44, 10}, {70, 4}, {74, 22}}},
                                           {"1 in each of 3 octants (E6)", kBoth, {{42, 50}, {68, 62}, {34, 74}}}};
  Plot plot;
  plot.equal_aspect = true;
  plot.x = {.from = 0.0, .to = 150.0, .hidden = true};
  plot.y = {.from = -4.0, .to = 110.0, .hidden = true};
  plot.shapes.push_back({.name = "the node's box",
                         .paths = {figures::rectangleOutline({2, 2}, {54, 54})},
                         .colour = figures::kBlue,
                         .width_px = 2.0});
  plot.shapes.push_back({.name = "its parent",
                         .paths = {figures::rectangleOutline({2, 2}, {106, 106})},
                         .stroke = figures::Stroke::dashed,
                         .colour = figures::kBlue});
  for (const SplitExample& example : examples) {
    plot.shapes.push_back({.paths = {example.corners}, .fill = example.fill});
    plot.places.push_back({example.corners[1], example.text, figures::Marker::none});
  }
  return {.panels = {plot}, .panel_width_px = 460.0, .panel_height_px = 420.0};
}

}  // namespace

std::vector<DissertationFigure> splitFigures() {
  return {{"3.7", "Three cases of a splitting plane that crosses triangles: A cut, B both sides, C majority",
           "The plane stands upright.", splitCasesFigure, FigureBasis::own_example},
          {"3.14", "Triangles that cross the box of an octree's node",
           "The triangle in three octants is added: the printed rule loses it (E6).", octantFigure,
           FigureBasis::own_example}};
}

}  // namespace palpate::study
