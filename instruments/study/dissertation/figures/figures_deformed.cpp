// Figures 4.7, 4.11, 4.12 and 4.16 to 4.18: the deformed skin.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dissertation/figures/dissertation_figures.h"
#include "lab/measured/model_meshes.h"
#include "lab/measured/pressed_skin.h"
#include "palpate/body/hand.h"
#include "report/page/plot_parts.h"

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

Plot sectionPlot(const std::string& title, const mesh::TriangleMesh& back, const FeltStroke& press,
                 const deform::FormSettings& forms) {
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm", .from = press.at.x() - 100.0, .to = press.at.x() + 100.0};
  plot.y = {.label = "z", .unit = "mm", .from = 60.0, .to = 130.0};
  const PressedSkin skin = pressed(back, feltContact(back, press, forms), forms);
  plot.series = {
      sectionSeries("at rest", crossSection(back.positions, back.triangles, press.at.y()), figures::Stroke::dashed),
      sectionSeries("pressed 10 mm", crossSection(skin.positions, back.triangles, press.at.y()),
                    figures::Stroke::solid)};
  return plot;
}

Figure figure47() {
  const mesh::TriangleMesh back = backModel(kFine);
  const FeltStroke press{.at = Vec2(40.0, 0.0)};
  deform::FormSettings shared;
  shared.region = deform::NormalRegion::shared;
  const double circle = feltContact(back, press).normal_region.half_major.norm();
  const double ellipse = feltContact(back, press, shared).normal_region.half_major.norm();
  return {
      .panels = {sectionPlot(fmt::format("Region of the tissue, R = {:.0f} mm", circle), back, press, {}),
                 sectionPlot(fmt::format("As printed: the map's ellipse, {:.0f} mm", ellipse), back, press, shared)},
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
void dropUnusedVertices(MeshView& view) {
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

// (4.17)'s 20 mm at (4.15)'s 10 mm lie outside the friction cone; with this tangential spring they are reached (E2).
constexpr double kLooseRatio = 0.23;

// The engine's finger, pressed 10 mm and drawn on until it slips.
FeltStroke pressAndDrag() {
  return {.at = Vec2(45.0, 10.0), .depth_mm = 10.0, .stroke_mm = Vec2(0.0, 30.0), .stiffness_ratio = kLooseRatio};
}

Figure figure412() {
  const mesh::TriangleMesh back = backModel(8163);
  deform::Contact contact = feltContact(
      back, {.at = Vec2(0.0, 0.0), .depth_mm = 10.0, .stroke_mm = Vec2(21.0, 21.0), .stiffness_ratio = kLooseRatio});
  contact.depth_mm = 0.0;  // the tangential part alone
  const PressedSkin skin = pressed(back, contact);
  MeshView rest = patchView("At rest", back.positions, back, contact.anchor.head<2>(), 85.0);
  MeshView dragged = patchView(fmt::format("Dragged {:.0f} mm by friction", contact.drag_mm.norm()), skin.positions,
                               back, contact.anchor.head<2>(), 85.0);
  for (MeshView* view : {&rest, &dragged}) dropUnusedVertices(*view);
  return {.panels = {rest, dragged}, .columns = 2, .panel_width_px = 420.0, .panel_height_px = 460.0};
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

// A grid of lines painted on the skin at rest: the texture shows where the skin goes.
void paintGrid(MeshView& view, const mesh::TriangleMesh& back) {
  constexpr double kLines = 20.0;  // mm apart
  constexpr double kWidth = 3.0;
  constexpr figures::Colour kLine{0.62, 0.40, 0.33};
  const auto is_line = [](double at) { return std::abs(at - kLines * std::round(at / kLines)) < 0.5 * kWidth; };
  for (const Triangle& triangle : view.triangles) {
    const Vec3 middle = centreOf(back, triangle);
    view.colours.push_back(is_line(middle.x()) || is_line(middle.y()) ? kLine : figures::kSkin);
  }
}

// The hand with the tip of its index finger on the deformed skin, pointing along the drag and down at it.
void addHand(MeshView& view, const deform::Contact& contact, const Vec3& forward) {
  constexpr double kSteepness = 0.6;    // radian, finger to skin
  constexpr double kFingertipMm = 5.0;  // the index finger's tip above the skin that it presses
  const Vec3 normal = contact.normal.normalized();
  const Vec3 along = (forward - forward.dot(normal) * normal).normalized();
  Mat3 turn;
  turn.col(1) = std::cos(kSteepness) * along - std::sin(kSteepness) * normal;
  turn.col(2) = std::sin(kSteepness) * along + std::cos(kSteepness) * normal;
  turn.col(0) = turn.col(1).cross(turn.col(2));
  const deform::TissueSettings tissue;
  const Vec3 tip = contact.anchor + deform::cappedLength(contact.drag_mm, tissue.tangential_cap_mm) +
                   (kFingertipMm - deform::cappedDepth(contact.depth_mm, tissue.normal_cap_mm)) * normal;
  const mesh::TriangleMesh hand = handModel();
  const Vec3 index_tip = body::indexTip();
  const auto first = static_cast<Index>(view.positions.size());
  for (const Vec3& position : hand.positions) view.positions.push_back(tip + turn * (position - index_tip));
  for (const Triangle& t : hand.triangles) {
    view.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    view.colours.push_back(figures::Colour{0.80, 0.62, 0.52});
  }
}

Figure figure416() {
  const mesh::TriangleMesh back = backModel(41582);
  FeltStroke press_only = pressAndDrag();
  press_only.stroke_mm = Vec2::Zero();
  Figure figure{.columns = 2, .panel_width_px = 470.0, .panel_height_px = 430.0};
  for (const FeltStroke& stroke : {press_only, pressAndDrag()}) {
    const deform::Contact contact = feltContact(back, stroke);
    const double drag = contact.drag_mm.norm();
    MeshView view = pressedView(drag > 1.0 ? fmt::format("Pressed 10 mm and dragged {:.0f} mm by friction", drag)
                                           : std::string("Pressed 10 mm"),
                                back, pressed(back, contact));
    paintGrid(view, back);
    dropUnusedVertices(view);
    addHand(view, contact, Vec3::UnitY());
    figure.panels.emplace_back(view);
  }
  return figure;
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

Figure figure411() {
  const mesh::TriangleMesh patch = flatPatch();
  const Press press{.at = Vec2(0.1, -0.1), .drag_mm = Vec2(12.0, 0.0), .half_major_mm = 32.0};
  const PressedSkin skin = pressed(patch, press);
  Plot plot = mapPlane("The skin dragged 12 mm in a circle of 32 mm");
  plot.shapes = {wires("deformed", skin.positions, patch),
                 wires("at rest", patch.positions, patch),
                 {.name = "boundary",
                  .paths = {figures::ellipseOutline(press.at, press.half_major_mm, press.half_major_mm, 0.0)},
                  .stroke = figures::Stroke::dashed,
                  .colour = figures::kVermilion,
                  .width_px = 1.8}};
  plot.shapes[0].width_px = 1.6;
  plot.shapes[1].stroke = figures::Stroke::dashed;
  plot.shapes[1].colour = figures::kBlue;
  plot.shapes[1].width_px = 0.7;
  plot.arrows = {{press.at, press.at + press.drag_mm, figures::kVermilion, 2.2}};
  plot.places = {{press.at, "A"}, {press.at + press.drag_mm, "A'"}};
  return {.panels = {plot}, .panel_width_px = 560.0, .panel_height_px = 520.0};
}

MeshView strainView(const std::string& title, const mesh::TriangleMesh& back, deform::StrainKind kind) {
  constexpr double kRange = 0.2;  // E24
  deform::FormSettings forms;
  forms.common.strain = true;
  forms.strain_kind = kind;
  const PressedSkin skin = pressed(back, feltContact(back, pressAndDrag(), forms), forms);
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
  dropUnusedVertices(view);
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
  const std::string ours = "Our back instead of the author's scan, at a place of ours.";
  const std::string felt =
      " The ellipse is the map's. The drag is what friction makes of a finger that is pressed 10 mm and drawn on until "
      "it slips, with a tangential spring of 0.23 of the normal one, which the text's 20 mm need (E2).";
  return {{"4.7", "Cross-section of the back, at rest and pressed",
           ours + " Both regions of the press are shown (E21); the depth of 10 mm is (4.15).", figure47,
           FigureBasis::own_example},
          {"4.11", "Tangential deformation in the circle", "A patch of our own; drag and circle are set.", figure411,
           FigureBasis::own_example},
          {"4.12", "Tangential deformation of the back's mesh, seen along its normal",
           ours + felt + " The press itself is left out.", figure412, FigureBasis::own_example},
          {"4.16", "Normal and tangential components together, with the hand",
           ours + felt + " A painted grid of 20 mm stands for the photograph on the skin.", figure416,
           FigureBasis::own_example},
          {"4.17", "Displacements of neighbouring points, and the strain made of them",
           "A patch of our own; drag and circle are set.", figure417, FigureBasis::own_example},
          {"4.18", "Strain of the deformed surface: red is tension, blue compression",
           ours + felt + " The right panel is added: a mean over edges hides shear (E24).", figure418,
           FigureBasis::own_example}};
}

}  // namespace palpate::study
