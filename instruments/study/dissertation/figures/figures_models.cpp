// Figures 3.2, 3.5, 3.12, 5.1 and 5.2: the back's mesh, its trees drawn as trees and boxes, the measured places.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "dissertation/figures/dissertation_figures.h"
#include "lab/measured/back_map.h"
#include "lab/measured/model_meshes.h"
#include "palpate/base/gaussian.h"
#include "palpate/hdb/partition.h"
#include "palpate/maps/key_points.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

figures::MeshView backView(const mesh::TriangleMesh& back, const std::string& title) {
  figures::MeshView view{.title = title};
  view.positions = back.positions;
  view.triangles = back.triangles;
  return view;
}

Figure figure32() {
  const mesh::TriangleMesh back = backModel();
  figures::MeshView view =
      backView(back, fmt::format("{} vertices, {} triangles", back.positions.size(), back.triangles.size()));
  view.edges = true;
  view.towards_viewer = Vec3(0.35, -0.3, 0.9);
  return {.panels = {view}, .panel_width_px = 520.0, .panel_height_px = 560.0};
}

/// The tree below a node, drawn from the leaf `next` on; returns the node's position.
struct TreeSketch {
  const hdb::Partition& tree;
  figures::Shape branches;
  Series inner;
  Series leaves;
  std::vector<figures::Place> names;
  double next = 0.0;

  Vec2 draw(Index at) {
    const hdb::Node& node = tree.nodes[at];
    const double height = -static_cast<double>(node.level);
    if (node.is_leaf) {
      const Vec2 place(next, height);
      next += 1.0;
      leaves.x.push_back(place.x());
      leaves.y.push_back(place.y());
      names.push_back({place, fmt::format("{}", node.entry_count), Marker::none});
      return place;
    }
    std::vector<Vec2> below;
    for (Index child = 0; child < node.child_count; ++child) below.push_back(draw(node.first_child + child));
    const Vec2 place(0.5 * (below.front().x() + below.back().x()), height);
    for (const Vec2& child : below) branches.paths.push_back({place, child});
    inner.x.push_back(place.x());
    inner.y.push_back(place.y());
    return place;
  }
};

Figure figure35() {
  constexpr Index kPrinted = 1024;
  const mesh::TriangleMesh back = backModel();
  const hdb::Partition tree = hdb::buildPartition(back, {.tree = hdb::TreeKind::Bsp, .threshold = kPrinted});
  TreeSketch sketch{.tree = tree, .branches = {.closed = false}, .inner = {}, .leaves = {}, .names = {}};
  sketch.inner = {.name = "node", .stroke = Stroke::none, .marker = Marker::circle};
  sketch.leaves = {.name = "leaf, with its triangles", .stroke = Stroke::none, .marker = Marker::square};
  sketch.draw(0);
  Plot plot{.title = fmt::format("BSP tree of {} triangles, threshold {}", back.triangles.size(), kPrinted)};
  const double deepest = *std::min_element(sketch.leaves.y.begin(), sketch.leaves.y.end());
  plot.x = {.from = -0.7, .to = sketch.next - 0.3, .hidden = true};
  plot.y = {.from = deepest - 0.5, .to = 0.4, .hidden = true};
  plot.shapes = {sketch.branches};
  plot.series = {sketch.inner, sketch.leaves};
  plot.places = sketch.names;
  return {.panels = {plot}, .panel_height_px = 330.0};
}

Figure figure312() {
  const mesh::TriangleMesh back = backModel();
  const Box3 bounds = hdb::buildPartition(back, {}).bounds;
  Figure figure{.columns = 3, .panel_width_px = 330.0, .panel_height_px = 340.0};
  for (int level = 0; level <= 2; ++level) {
    const int parts = 1 << level;
    figures::MeshView view = backView(back, fmt::format("Level {}: {} boxes", level, parts * parts * parts));
    view.towards_viewer = Vec3(0.55, -0.75, 0.9);
    figures::Segments boxes{.segments = {}, .colour = figures::kBlue};
    const Vec3 size = bounds.sizes() / parts;
    for (int i = 0; i < parts * parts * parts; ++i) {
      const int line = i / parts;
      const int layer = line / parts;
      const Vec3 low = bounds.min() + size.cwiseProduct(Vec3(i % parts, line % parts, layer));
      const auto edges = figures::boxEdges({low, low + size});
      boxes.segments.insert(boxes.segments.end(), edges.begin(), edges.end());
    }
    view.lines = {boxes};
    figure.panels.emplace_back(view);
  }
  return figure;
}

Figure figure51() {
  Plot plot = mapPlane("Key points on our back");
  plot.shapes = {{.name = "our back", .paths = {backOutline()}, .colour = figures::kInk}};
  for (const maps::KeyPoint& key : maps::dissertationKeyPoints()) {
    plot.places.push_back({key.position_mm, key.name, Marker::circle, figures::kVermilion});
  }
  return {.panels = {plot}, .panel_width_px = 460.0, .panel_height_px = 560.0};
}

// Dots of 3 x 3 cm painted on the skin before and after a drag of 20 mm towards the head at P2, and where the skin
// moved by 2 mm.
Figure figure52() {
  constexpr double kDots = 30.0;  // mm
  constexpr double kDrag = 20.0;  // mm, (4.17)
  const maps::KeyPoint key = maps::dissertationKeyPoints()[1];
  const auto moved = [&](const Vec2& place) {
    const double q = maps::locationRatio(key.ellipse, place - key.position_mm);
    return q < 1.0 ? kDrag * halfGaussian(q) : 0.0;
  };
  Plot plot =
      study::backMap("The skin dragged 20 mm towards the head at P2", moved,
                     {.label = "displacement", .unit = "mm", .from = 0.0, .to = kDrag, .contour_levels = {2.0, 10.0}},
                     std::span(&key, 1));
  Series before{.name = "dots before", .stroke = Stroke::none, .marker = Marker::circle, .colour = figures::kVermilion};
  Series after{.name = "dots after", .stroke = Stroke::none, .marker = Marker::circle, .colour = figures::kInk};
  for (const Vec2& place : placesOnBack(kDots)) {
    before.x.push_back(place.x());
    before.y.push_back(place.y());
    after.x.push_back(place.x());
    after.y.push_back(place.y() + moved(place));
  }
  plot.series = {before, after};
  plot.shapes.push_back(
      {.name = "measured ellipse of P2",
       .paths = {figures::ellipseOutline(key.position_mm, key.ellipse.half_major_mm,
                                         key.ellipse.half_major_mm * key.ellipse.aspect, key.ellipse.direction_rad)},
       .stroke = Stroke::dashed,
       .colour = figures::kVermilion});
  return {.panels = {plot}, .panel_width_px = 520.0, .panel_height_px = 620.0};
}

}  // namespace

std::vector<DissertationFigure> modelFigures() {
  return {{"3.2", "The back mesh", "Our back instead of the author's scan, with as many triangles.", figure32},
          {"3.5", "BSP tree of the back model", "Of our back; leaves bear their numbers of triangles.", figure35},
          {"3.12", "Octree partition of a bounding box", "The box of our back; the printed picture is a stranger's.",
           figure312},
          {"5.1", "The seven key points", "On our back, where their places are assumed (E33); no muscles are drawn.",
           figure51},
          {"5.2", "Dots on the skin before and after a drag, and contours of displacement, at P2",
           "Computed by our model instead of measured: the drag is set to (4.17)'s 20 mm. The model puts its 2 mm well "
           "inside the ellipse that was measured as the 2 mm contour (E20).",
           figure52, FigureBasis::own_example}};
}

}  // namespace palpate::study
