// Touched triangles have the colour of their value, unlit, so that it can be read off the legend; the rest of the skin
// is lit, so that the body is seen.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "palpate/base/language.h"
#include "report/page/study_page.h"
#include "report/recording/report_figures.h"

namespace palpate::app {

namespace {

/// This share of the touched area is hotter than the end of the colours: one place where a finger rested would make all
/// else one colour.
constexpr double kHottestShare = 0.02;
/// Around what was touched, in the picture from nearby.
constexpr double kMarginMm = 25.0;
/// From this share of the body on, a picture from nearby shows nothing more.
constexpr double kLargeShare = 0.6;

/// The side of the body in the picture: the most touched of six.
struct ReportSight {
  Vec3 towards_viewer = Vec3::UnitZ();
  Vec3 up = Vec3::UnitY();
  const char* words = toTranslate("from behind");
};

Vec3 triangleAreaVector2(const mesh::TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return mesh::areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
}

ReportSight chooseSight(const trace::TouchedSurface& surface) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < surface.ticks.size(); ++t) sum += surface.ticks[t] * triangleAreaVector2(surface.mesh, t);
  const std::array<ReportSight, 6> sights = {{{Vec3::UnitZ(), Vec3::UnitY(), toTranslate("from behind")},
                                              {-Vec3::UnitZ(), Vec3::UnitY(), toTranslate("from the front")},
                                              {Vec3::UnitX(), Vec3::UnitY(), toTranslate("from the right")},
                                              {-Vec3::UnitX(), Vec3::UnitY(), toTranslate("from the left")},
                                              {Vec3::UnitY(), Vec3::UnitZ(), toTranslate("from above the head")},
                                              {-Vec3::UnitY(), Vec3::UnitZ(), toTranslate("from the feet")}}};
  return *std::max_element(sights.begin(), sights.end(), [&](const ReportSight& a, const ReportSight& b) {
    return a.towards_viewer.dot(sum) < b.towards_viewer.dot(sum);
  });
}

figures::Colour litSkin(const Vec3& normal2, const ReportSight& sight) {
  const Vec3 right = sight.up.cross(sight.towards_viewer);
  const Vec3 light = (sight.towards_viewer + 0.6 * sight.up - 0.4 * right).normalized();
  const double length = normal2.norm();
  const double facing = length > 0.0 ? std::abs(normal2.dot(light)) / length : 0.0;
  const double brightness = 0.5 + 0.5 * facing;
  const figures::Colour& skin = figures::kSkin;
  return {skin.red * brightness, skin.green * brightness, skin.blue * brightness, 1.0};
}

/// A value of each triangle, and where its colours end.
struct HeatValues {
  std::vector<double> values;
  double most = 1.0;
  std::string title;
  std::string label;
  std::string unit;
};

/// Exceeded in only this share of the touched area.
double upperQuantile(const trace::TouchedSurface& surface, const std::vector<double>& values) {
  std::vector<std::pair<double, double>> by_value;  // value, area
  double area = 0.0;
  for (std::size_t t = 0; t < values.size(); ++t) {
    if (!(surface.ticks[t] > 0.0)) continue;
    by_value.emplace_back(values[t], triangleAreaVector2(surface.mesh, t).norm());
    area += by_value.back().second;
  }
  std::sort(by_value.begin(), by_value.end());
  double left = kHottestShare * area;
  while (by_value.size() > 1 && left > by_value.back().second) {
    left -= by_value.back().second;
    by_value.pop_back();
  }
  return by_value.empty() || !(by_value.back().first > 0.0) ? 1.0 : by_value.back().first;
}

std::array<HeatValues, 2> makeHeatValues(const RecordingReport& report, const trace::TouchedSurface& surface) {
  HeatValues time{{}, 1.0, tr("Time in contact"), tr("time"), "s"};
  for (const double ticks : surface.ticks) time.values.push_back(ticks / report.statistics.ticks_per_s);
  HeatValues force{surface.peak_force_n, 1.0, tr("Peak force"), tr("force"), "N"};
  time.most = upperQuantile(surface, time.values);
  force.most = upperQuantile(surface, force.values);
  return {time, force};
}

/// The part of the body that a picture shows, across and along the view; depth is ignored.
struct ShownPart {
  Vec3 across = Vec3::UnitX();
  Vec3 along = Vec3::UnitY();
  Eigen::AlignedBox2d box;  ///< empty: all of it
};

/// The part of a convex piece on the side of a plane where normal * p >= offset (Sutherland and Hodgman 1974).
std::vector<Vec3> clipToHalfSpace(const std::vector<Vec3>& piece, const Vec3& normal, double offset) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3& from = piece[i];
    const Vec3& to = piece[(i + 1) % piece.size()];
    const double above_from = normal.dot(from) - offset;
    const double above_to = normal.dot(to) - offset;
    if (above_from >= 0.0) kept.push_back(from);
    if ((above_from < 0.0) != (above_to < 0.0))
      kept.push_back(from + (to - from) * (above_from / (above_from - above_to)));
  }
  return kept;
}

std::vector<Vec3> shownPiece(const mesh::TriangleMesh& mesh, const Triangle& triangle, const ShownPart& part) {
  std::vector<Vec3> piece;
  for (const Index vertex : triangle) piece.push_back(mesh.positions[vertex]);
  if (part.box.isEmpty()) return piece;
  piece = clipToHalfSpace(piece, part.across, part.box.min().x());
  piece = clipToHalfSpace(piece, -part.across, -part.box.max().x());
  piece = clipToHalfSpace(piece, part.along, part.box.min().y());
  return clipToHalfSpace(piece, -part.along, -part.box.max().y());
}

figures::MeshView heatView(const trace::TouchedSurface& surface, const HeatValues& heat, const ReportSight& sight,
                           const ShownPart& part) {
  figures::MeshView view{.title = heat.title};
  view.ambient = 1.0;
  view.towards_viewer = sight.towards_viewer;
  view.up = sight.up;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const std::vector<Vec3> piece = shownPiece(surface.mesh, surface.mesh.triangles[t], part);
    const auto first = static_cast<Index>(view.positions.size());
    view.positions.insert(view.positions.end(), piece.begin(), piece.end());
    const bool touched = surface.ticks[t] > 0.0;
    const figures::Colour colour = touched ? figures::mapColour(ColourMap::viridis, heat.values[t] / heat.most)
                                           : litSkin(triangleAreaVector2(surface.mesh, t), sight);
    for (Index corner = 2; corner < piece.size(); ++corner) {
      view.triangles.push_back({first, first + corner - 1, first + corner});
      view.colours.push_back(colour);
    }
  }
  view.legend = {{tr("not touched"), figures::kSkin}};
  view.colour_key = {.label = heat.label, .unit = heat.unit, .from = 0.0, .to = heat.most};
  return view;
}

figures::Figure heatFigure(const std::array<HeatValues, 2>& heats, const trace::TouchedSurface& surface,
                           const ReportSight& sight, const ShownPart& part) {
  figures::Figure figure;
  figure.columns = 2;
  figure.panel_width_px = 470.0;
  figure.panel_height_px = 470.0;
  for (const HeatValues& heat : heats) figure.panels.emplace_back(heatView(surface, heat, sight, part));
  return figure;
}

/// The box of the body, or of its touched part, as the picture has it.
Eigen::AlignedBox2d projectedBox(const trace::TouchedSurface& surface, const ShownPart& axes, bool touched_only) {
  Eigen::AlignedBox2d box;
  for (std::size_t t = 0; t < surface.ticks.size(); ++t) {
    if (touched_only && !(surface.ticks[t] > 0.0)) continue;
    for (const Index vertex : surface.mesh.triangles[t]) {
      const Vec3& position = surface.mesh.positions[vertex];
      box.extend(Vec2(position.dot(axes.across), position.dot(axes.along)));
    }
  }
  return box;
}

std::vector<ReportPicture> surfacePictures(const RecordingReport& report, const trace::TouchedSurface& surface) {
  const ReportSight sight = chooseSight(surface);
  const ShownPart all{.across = sight.up.cross(sight.towards_viewer), .along = sight.up, .box = {}};
  ShownPart near = all;
  near.box = projectedBox(surface, all, true);
  if (near.box.isEmpty()) return {};
  near.box.min() -= Vec2::Constant(kMarginMm);
  near.box.max() += Vec2::Constant(kMarginMm);
  const std::array<HeatValues, 2> heats = makeHeatValues(report, surface);
  const bool head_up = sight.up.y() > 0.5;
  std::vector<ReportPicture> pictures;
  pictures.push_back({"body", tr("On the body"),
                      trf("How long and how hard the skin was touched, {}, seen {}{}. A place counts as touched where "
                          "the finger's radius reaches it; times of several fingers are added. The last colour of each "
                          "map also covers all higher values.",
                          report.body.name, tr(sight.words), head_up ? tr(", the head upwards") : ""),
                      heatFigure(heats, surface, sight, all)});
  const Vec2 body = projectedBox(surface, all, false).sizes();
  if ((near.box.sizes().array() < kLargeShare * body.array()).all()) {
    pictures.push_back({"body_near", "", tr("The same from nearby."), heatFigure(heats, surface, sight, near)});
  }
  return pictures;
}

// ---- without a body

/// A map of the plane, seen from behind; NaN where nothing was touched.
struct PlanGrid {
  figures::Field time;
  figures::Field force;
};

double reachOf(const RecordingReport& report, std::uint32_t finger) {
  return finger < report.body.reach_mm.size() ? report.body.reach_mm[finger] : trace::kMinReachMm;
}

PlanGrid emptyPlan(const RecordingReport& report) {
  constexpr double kMaxCells = 300.0;  // along a side; more would be unreadable
  Eigen::AlignedBox2d box;
  for (const trace::TouchedPlace& place : report.statistics.places) {
    const Vec2 reach = Vec2::Constant(reachOf(report, place.finger) + trace::kPlaceCellMm);
    box.extend(Vec2(place.place.head<2>() - reach)).extend(Vec2(place.place.head<2>() + reach));
  }
  const double cell = std::max(0.5 * trace::kPlaceCellMm, box.sizes().maxCoeff() / kMaxCells);
  PlanGrid plan;
  figures::Field& field = plan.time;
  field.origin = box.min();
  field.step = Vec2::Constant(cell);
  field.columns = static_cast<int>(box.sizes().x() / cell) + 2;
  field.rows = static_cast<int>(box.sizes().y() / cell) + 2;
  field.values.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows),
                      std::numeric_limits<double>::quiet_NaN());
  field.from = 0.0;
  plan.force = field;
  field.label = tr("time");
  field.unit = "s";
  plan.force.label = tr("force");
  plan.force.unit = "N";
  return plan;
}

/// Adds everything within the finger's reach, whether above each other or not.
void addToPlan(const RecordingReport& report, const trace::TouchedPlace& place, PlanGrid& plan) {
  const figures::Field& grid = plan.time;
  const double cell = grid.step.x();
  const double reach = std::max(reachOf(report, place.finger), 0.75 * cell);
  const Vec2 middle = (place.place.head<2>() - grid.origin) / cell;
  const int cells = static_cast<int>(std::ceil(reach / cell));
  const int column = static_cast<int>(std::lround(middle.x()));
  const int row = static_cast<int>(std::lround(middle.y()));
  for (int j = std::max(0, row - cells); j <= std::min(grid.rows - 1, row + cells); ++j) {
    for (int i = std::max(0, column - cells); i <= std::min(grid.columns - 1, column + cells); ++i) {
      if ((Vec2(i, j) - middle).norm() * cell > reach) continue;
      const auto at =
          static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(i);
      double& time = plan.time.values[at];
      time = (std::isnan(time) ? 0.0 : time) + report.statistics.seconds(place.ticks);
      plan.force.values[at] = std::fmax(plan.force.values[at], place.peak_force_n);
    }
  }
}

ReportPicture planPicture(const RecordingReport& report) {
  PlanGrid plan = emptyPlan(report);
  for (const trace::TouchedPlace& place : report.statistics.places) addToPlan(report, place, plan);
  figures::Figure figure;
  figure.columns = 2;
  figure.panel_width_px = 470.0;
  figure.panel_height_px = 430.0;
  const std::array panels = {std::pair{tr("Time in contact"), &plan.time}, std::pair{tr("Peak force"), &plan.force}};
  for (const auto& [title, values] : panels) {
    figures::Plot plot{.title = title};
    plot.x = {.label = tr("x, to the right"), .unit = "mm"};
    plot.y = {.label = tr("y, to the head"), .unit = "mm"};
    plot.equal_aspect = true;
    plot.field = *values;
    figure.panels.emplace_back(std::move(plot));
  }
  return {
      "plan", tr("On the body"),
      tr("Where the fingers touched, seen from behind, without the body: what their radii reached, how long and how "
         "hard."),
      std::move(figure)};
}

}  // namespace

std::vector<ReportPicture> bodyPictures(const RecordingReport& report) {
  if (report.statistics.places.empty()) return {};
  if (report.body.surface) return surfacePictures(report, *report.body.surface);
  return {planPicture(report)};
}

}  // namespace palpate::app
