// Figures 4.13 to 4.15: the ellipse in the tangent plane, the two location ratios, the rings of neighbours.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dissertation/figures/dissertation_figures.h"
#include "lab/measured/model_meshes.h"
#include "lab/measured/pressed_skin.h"
#include "palpate/deform/region_frame.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::MeshView;

// A dome of 60 mm radius, cut off: a skin whose points lie off the tangent plane.
MeshView dome() {
  constexpr int kSide = 24;
  constexpr double kRadius = 70.0;
  MeshView view;
  for (int row = 0; row <= kSide; ++row) {
    for (int column = 0; column <= kSide; ++column) {
      const double x = 80.0 * column / kSide - 40.0;
      const double y = 80.0 * row / kSide - 40.0;
      view.positions.emplace_back(x, y, std::sqrt(kRadius * kRadius - x * x - y * y) - kRadius);
    }
  }
  for (Index row = 0; row < kSide; ++row) {
    for (Index column = 0; column < kSide; ++column) {
      const Index a = row * (kSide + 1) + column;
      view.triangles.push_back({a, a + 1, a + kSide + 2});
      view.triangles.push_back({a, a + kSide + 2, a + kSide + 1});
    }
  }
  return view;
}

std::vector<std::array<Vec3, 2>> loopSegments(const std::vector<Vec2>& outline) {
  std::vector<std::array<Vec3, 2>> loop;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    loop.push_back({Vec3(a.x(), a.y(), 0.0), Vec3(b.x(), b.y(), 0.0)});
  }
  return loop;
}

Figure figure413() {
  MeshView view = dome();
  view.towards_viewer = Vec3(0.35, -1.0, 0.42);
  view.up = Vec3::UnitZ();
  view.edges = true;
  view.scale_bar = false;
  const Vec3 j = view.positions[6 * 25 + 17];
  const Vec3 d = maps::projectedOnPlane(j, Vec3::Zero(), Vec3::UnitZ());
  view.sheets.push_back({Vec3(-45, -32, 0), Vec3(90, 0, 0), Vec3(0, 64, 0), figures::withAlpha(figures::kSky, 0.3)});
  view.lines.push_back({.name = "ellipse in the tangent plane",
                        .segments = loopSegments(figures::ellipseOutline({0, 0}, 40, 26, 0.0)),
                        .colour = figures::kVermilion,
                        .width_px = 1.8});
  view.lines.push_back(
      {.name = "J to D (4.9)", .segments = {{j, d}}, .colour = figures::kBlue, .width_px = 2.0, .on_top = true});
  view.lines.push_back({.name = "normal ON",
                        .segments = {{Vec3::Zero(), Vec3(0, 0, 26)}},
                        .colour = figures::kGreen,
                        .width_px = 2.0,
                        .on_top = true});
  view.places = {
      {Vec3::Zero(), "O"}, {Vec3(0, 0, 26), "N", figures::Marker::none}, {j, "J"}, {d, "D"}, {Vec3(40, 0, 0), "A"}};
  return {.panels = {view}, .panel_width_px = 600.0, .panel_height_px = 380.0};
}

// Where (4.13) is q: its radius along every direction by solving q(r) = r q(1).
std::vector<Vec2> pedalOutline(double half_major, double t, double q) {
  constexpr int kCorners = 180;
  std::vector<Vec2> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Vec2 along(std::cos(angle), std::sin(angle));
    outline.emplace_back(along * (q / deform::pedalLocation(half_major, t, along).q));
  }
  return outline;
}

Plot ratioPlot(const std::string& title, double half_major, double aspect) {
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "along the major axis", .unit = "mm"};
  plot.y = {.label = "across", .unit = "mm"};
  figures::Shape ellipse{.name = "true ellipses (E14)", .colour = figures::kBlue, .width_px = 1.6};
  figures::Shape pedal{
      .name = "(4.13)", .stroke = figures::Stroke::dashed, .colour = figures::kVermilion, .width_px = 1.6};
  for (const double q : {0.25, 0.5, 0.75, 1.0}) {
    ellipse.paths.push_back(figures::ellipseOutline({0, 0}, q * half_major, q * half_major * aspect, 0.0));
    pedal.paths.push_back(pedalOutline(half_major, aspect, q));
  }
  plot.shapes = {ellipse, pedal};
  return plot;
}

Figure figure414() {
  return {.panels = {ratioPlot("P4: 179 mm, ratio 1.357", 179.0, 1.0 / 1.357),
                     ratioPlot("A slim one: 179 mm, ratio 2.5", 179.0, 1.0 / 2.5)},
          .columns = 2,
          .panel_height_px = 430.0};
}

// The rings of neighbour nodes around the triangle of the contact; at the outside the ring without a node inside.
std::vector<std::vector<Index>> ringsAround(const deform::Skin& skin, const Triangle& start, std::size_t count) {
  std::vector<bool> seen(skin.vertices, false);
  std::vector<std::vector<Index>> rings{{start.begin(), start.end()}};
  for (const Index corner : start) seen[corner] = true;
  while (rings.size() < count) {
    std::vector<Index> next;
    for (const Index v : rings.back()) {
      for (const Index neighbour : skin.neighbours[v]) {
        if (seen[neighbour]) continue;
        seen[neighbour] = true;
        next.push_back(neighbour);
      }
    }
    rings.push_back(std::move(next));
  }
  return rings;
}

figures::Shape wires(const mesh::TriangleMesh& mesh) {
  figures::Shape shape{.colour = {0.6, 0.6, 0.6}, .width_px = 0.7};
  for (const Triangle& t : mesh.triangles) {
    shape.paths.push_back({mesh.positions[t[0]].head<2>(), mesh.positions[t[1]].head<2>(),  //
                           mesh.positions[t[2]].head<2>()});
  }
  return shape;
}

std::vector<figures::Series> ringSeries(const mesh::TriangleMesh& mesh, const Triangle& start) {
  constexpr std::array kMarkers{figures::Marker::circle, figures::Marker::triangle, figures::Marker::square,
                                figures::Marker::diamond, figures::Marker::cross};
  std::vector<figures::Series> rings;
  for (const auto& ring : ringsAround(deform::buildSkin(mesh), start, kMarkers.size())) {
    figures::Series& series = rings.emplace_back();
    series.name = fmt::format("ring {}", rings.size());
    series.stroke = figures::Stroke::none;
    series.marker = kMarkers[rings.size() - 1];
    for (const Index v : ring) {
      series.x.push_back(mesh.positions[v].x());
      series.y.push_back(mesh.positions[v].y());
    }
  }
  return rings;
}

Figure figure415() {
  constexpr double kAround = 46.0;  // mm
  const mesh::TriangleMesh back = backModel();
  const Vec2 centre(8.0, 3.0);
  Plot plot{.title = "Rings of neighbour nodes"};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm", .from = centre.x() - kAround, .to = centre.x() + kAround};
  plot.y = {.label = "y", .unit = "mm", .from = centre.y() - kAround, .to = centre.y() + kAround};
  const figures::Shape ellipse{.name = "ellipse",
                               .paths = {figures::ellipseOutline(centre, 27.0, 20.0, 1.0)},
                               .stroke = figures::Stroke::dashed,
                               .colour = figures::kVermilion,
                               .width_px = 2.0};
  plot.shapes = {wires(back), ellipse};
  plot.series = ringSeries(back, back.triangles[placeOn(back, centre).triangle]);
  plot.places = {{centre, "O"}};
  return {.panels = {plot}, .panel_width_px = 560.0, .panel_height_px = 560.0};
}

}  // namespace

std::vector<DissertationFigure> regionFigures() {
  return {{"4.13", "A vertex J of the skin and its foot D on the plane of the deformation ellipse", "", figure413,
           FigureBasis::own_example},
          {"4.14", "Location ratio in the deformation ellipse: lines of q = 1/4, 1/2, 3/4 and 1",
           "The printed figure shows one ellipse; here the true ratio and (4.13), which is its pedal curve (E14).",
           figure414, FigureBasis::own_example},
          {"4.15", "Rings of neighbour nodes around the contact, and the ellipse", "On our back of 2962 triangles.",
           figure415, FigureBasis::own_example}};
}

}  // namespace palpate::study
