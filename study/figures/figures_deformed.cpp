// Figures 4.7, 4.12 and 4.16 to 4.18: the deformed skin.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/figures/dissertation_figures.h"
#include "study/measured/model_meshes.h"
#include "study/measured/pressed_skin.h"
#include "study/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::MeshView;

constexpr std::size_t kFine = 20389;  // triangles of the model that the text timed

figures::Series sectionSeries(const std::string& name, const std::vector<Vec2>& cut, figures::Stroke stroke) {
  figures::Series series{.name = name, .stroke = stroke};
  for (const Vec2& point : cut) {
    series.x.push_back(point.x());
    series.y.push_back(point.y());
  }
  return series;
}

Plot sectionPlot(const std::string& title, const mesh::TriangleMesh& back, const Press& press,
                 const deform::FormSettings& forms) {
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm", .from = press.at.x() - 100.0, .to = press.at.x() + 100.0};
  plot.y = {.label = "z", .unit = "mm", .from = 60.0, .to = 130.0};
  const PressedSkin skin = pressed(back, press, forms);
  plot.series = {
      sectionSeries("at rest", crossSection(back.positions, back.triangles, press.at.y()), figures::Stroke::dashed),
      sectionSeries("pressed 10 mm", crossSection(skin.positions, back.triangles, press.at.y()),
                    figures::Stroke::solid)};
  return plot;
}

Figure figure47() {
  const mesh::TriangleMesh back = backModel(kFine);
  const Press press{.at = Vec2(40.0, 0.0), .depth_mm = 10.0, .half_major_mm = 90.0};
  deform::FormSettings shared;
  shared.region = deform::NormalRegion::shared;
  return {.panels = {sectionPlot("Region of the tissue, R = 25 mm", back, press, {}),
                     sectionPlot("As printed: region of the drag, 90 mm", back, press, shared)},
          .columns = 2,
          .panel_height_px = 270.0};
}

MeshView patchView(const std::string& title, const std::vector<Vec3>& positions, const mesh::TriangleMesh& mesh,
                   const Vec2& centre, double half) {
  MeshView view{.title = title};
  view.positions = positions;
  view.edges = true;
  view.ambient = 0.75;
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 middle = centreOf(mesh, triangle);
    if ((middle.head<2>() - centre).cwiseAbs().maxCoeff() < half) view.triangles.push_back(triangle);
  }
  return view;
}

// Drops the vertices that no triangle uses, so that the view is fitted to the patch.
void keepUsedVertices(MeshView& view) {
  std::vector<Index> renumbered(view.positions.size(), kNoIndex);
  std::vector<Vec3> kept;
  for (Triangle& triangle : view.triangles) {
    for (Index& corner : triangle) {
      if (renumbered[corner] == kNoIndex) {
        renumbered[corner] = static_cast<Index>(kept.size());
        kept.push_back(view.positions[corner]);
      }
      corner = renumbered[corner];
    }
  }
  view.positions = std::move(kept);
}

Figure figure412() {
  const mesh::TriangleMesh back = backModel(8163);
  const Press press{.at = Vec2(0.0, 0.0), .drag_mm = Vec2(14.0, 14.0), .half_major_mm = 70.0};
  const PressedSkin skin = pressed(back, press);
  MeshView rest = patchView("At rest", back.positions, back, press.at, 85.0);
  MeshView dragged = patchView("Dragged 20 mm", skin.positions, back, press.at, 85.0);
  for (MeshView* view : {&rest, &dragged}) keepUsedVertices(*view);
  return {.panels = {rest, dragged}, .columns = 2, .panel_width_px = 420.0, .panel_height_px = 460.0};
}

Press pressAndDrag() {
  return {.at = Vec2(45.0, 10.0), .depth_mm = 10.0, .drag_mm = Vec2(0.0, 18.0), .half_major_mm = 80.0, .aspect = 0.8};
}

// The skin around the finger.
MeshView pressedView(const std::string& title, const mesh::TriangleMesh& back, const PressedSkin& skin) {
  constexpr double kAround = 105.0;  // mm
  MeshView view = patchView(title, skin.positions, back, pressAndDrag().at, kAround);
  view.edges = false;
  view.towards_viewer = Vec3(0.75, -0.55, 0.75);
  view.ambient = 0.3;
  return view;
}

Figure figure416() {
  const mesh::TriangleMesh back = backModel(kFine);
  Press press_only = pressAndDrag();
  press_only.drag_mm = Vec2::Zero();
  MeshView first = pressedView("Pressed 10 mm", back, pressed(back, press_only));
  MeshView second = pressedView("Pressed 10 mm and dragged 18 mm", back, pressed(back, pressAndDrag()));
  for (MeshView* view : {&first, &second}) keepUsedVertices(*view);
  return {.panels = {first, second}, .columns = 2, .panel_width_px = 470.0, .panel_height_px = 430.0};
}

// Equilateral triangles of 10 mm, 9 by 9 vertices around the origin.
mesh::TriangleMesh flatPatch() {
  constexpr Index kSide = 9;
  constexpr double kEdge = 10.0;
  constexpr double kHeight = 8.66;
  mesh::TriangleMesh patch;
  for (Index row = 0; row < kSide; ++row) {
    for (Index column = 0; column < kSide; ++column) {
      patch.positions.emplace_back(kEdge * column - 40.0 + 0.5 * kEdge * (row % 2), kHeight * (row - 4.0), 0.0);
    }
  }
  for (Index row = 0; row + 1 < kSide; ++row) {
    for (Index column = 0; column + 1 < kSide; ++column) {
      const Index a = row * kSide + column;
      const Index up = a + kSide;
      const bool leans_left = row % 2 == 0;
      patch.triangles.push_back({a, a + 1, leans_left ? up : up + 1});
      patch.triangles.push_back({leans_left ? a + 1 : a, up + 1, up});
    }
  }
  return patch;
}

figures::Shape wires(const std::string& name, const std::vector<Vec3>& positions, const mesh::TriangleMesh& mesh) {
  figures::Shape shape{.name = name};
  for (const Triangle& t : mesh.triangles) {
    shape.paths.push_back({positions[t[0]].head<2>(), positions[t[1]].head<2>(), positions[t[2]].head<2>()});
  }
  return shape;
}

std::vector<figures::Arrow> displacementArrows(const mesh::TriangleMesh& rest, const PressedSkin& skin) {
  constexpr double kSeen = 0.3;  // mm
  std::vector<figures::Arrow> arrows;
  for (std::size_t v = 0; v < rest.positions.size(); ++v) {
    const Vec2 from = rest.positions[v].head<2>();
    const Vec2 to = skin.positions[v].head<2>();
    if ((to - from).norm() > kSeen) arrows.push_back({from, to});
  }
  return arrows;
}

Figure figure417() {
  const mesh::TriangleMesh patch = flatPatch();
  deform::FormSettings forms;
  forms.common.strain = true;
  const Press press{.at = Vec2(-9.0, -4.0), .drag_mm = Vec2(9.0, 5.0), .half_major_mm = 32.0};
  const PressedSkin skin = pressed(patch, press, forms);
  Plot plot = mapPlane("Displacements and the mean strain (4.20) of four vertices");
  plot.shapes = {wires("deformed", skin.positions, patch), wires("at rest", patch.positions, patch)};
  plot.shapes[0].colour = figures::kVermilion;
  plot.shapes[0].width_px = 1.8;
  plot.shapes[1].width_px = 0.7;
  plot.arrows = displacementArrows(patch, skin);
  for (const Index v : {Index{39}, Index{42}, Index{31}, Index{49}}) {
    plot.places.push_back({skin.positions[v].head<2>(), fmt::format("{:+.0f} %", 100.0 * skin.strain[v])});
  }
  return {.panels = {plot}, .panel_width_px = 560.0, .panel_height_px = 520.0};
}

MeshView strainView(const std::string& title, const mesh::TriangleMesh& back, deform::StrainKind kind) {
  constexpr double kRange = 0.2;  // E24
  deform::FormSettings forms;
  forms.common.strain = true;
  forms.strain_kind = kind;
  const PressedSkin skin = pressed(back, pressAndDrag(), forms);
  MeshView view = pressedView(title, back, skin);
  view.towards_viewer = Vec3(0.35, -0.35, 0.9);
  view.ambient = 0.6;
  for (const Triangle& t : view.triangles) {
    const double strain = (skin.strain[t[0]] + skin.strain[t[1]] + skin.strain[t[2]]) / 3.0;
    const double share = std::clamp(0.5 + 0.5 * strain / kRange, 0.0, 1.0);
    view.colours.push_back(figures::mapColour(ColourMap::cool_warm, share));
  }
  view.colour_key =
      figures::ColourKey{.label = "strain", .unit = "%", .from = -20.0, .to = 20.0, .colours = ColourMap::cool_warm};
  keepUsedVertices(view);
  return view;
}

Figure figure418() {
  const mesh::TriangleMesh back = backModel(kFine);
  return {.panels = {strainView("Mean of the edges (4.20)", back, deform::StrainKind::edges),
                     strainView("Principal strain (E24)", back, deform::StrainKind::principal)},
          .columns = 2,
          .panel_width_px = 470.0,
          .panel_height_px = 430.0};
}

}  // namespace

std::vector<DissertationFigure> deformedFigures() {
  const std::string ours = "Our back instead of the author's scan.";
  return {
      {"4.7", "Cross-section of the back, at rest and pressed", ours + " Both regions of the press are shown (E21).",
       figure47, FigureBasis::own_example},
      {"4.12", "Tangential deformation of the back's mesh, seen along its normal", ours, figure412,
       FigureBasis::own_example},
      {"4.16", "Normal and tangential components together", ours + " No texture and no hand.", figure416,
       FigureBasis::own_example},
      {"4.17", "Displacements of neighbouring points, and the strain made of them", "A patch of our own.", figure417,
       FigureBasis::own_example},
      {"4.18", "Strain of the deformed surface: red is tension, blue compression",
       ours + " The right panel is added: a mean over edges hides shear (E24).", figure418, FigureBasis::own_example}};
}

}  // namespace palpate::study
