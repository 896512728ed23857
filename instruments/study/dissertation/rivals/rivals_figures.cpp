// Plots of one measurement of the rivals.
#include "dissertation/rivals/rivals_findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr double kDeep = 10.0;  // mm, of the presses shown

figures::Colour colourOfRival(Rival rival) {
  return figures::seriesColour(
      static_cast<std::size_t>(std::find(kRivals.begin(), kRivals.end(), rival) - kRivals.begin()));
}

// The section through the ball along x, of what moved where.
Series profileSeries(const RivalRow& row) {
  Series series{.name = nameOf(row.rival), .marker = Marker::none, .colour = colourOfRival(row.rival), .width_px = 1.5};
  for (std::size_t v = 0; v < row.rest.size(); ++v) {
    if (std::abs(row.rest[v].y()) > 1e-9 || row.rest[v].x() < 0.0) continue;
    series.x.push_back(row.rest[v].x() + row.displacements[v].x());
    series.y.push_back(row.displacements[v].z());
  }
  return series;
}

Series profileSeries(const LayeredPress& truth) {
  Series series{.name = "truth", .colour = figures::kInk, .width_px = 2.6};
  for (std::size_t i = 0; i < truth.inward.size(); ++i) {
    const double radius = truth.step_mm * static_cast<double>(i);
    series.x.push_back(radius + truth.central_mm * truth.outward[i]);
    series.y.push_back(-truth.central_mm * truth.inward[i]);
  }
  return series;
}

Plot sectionPlot(const RivalsMeasurement& found, const std::string& tissue) {
  Plot plot{.title = fmt::format("\"{}\" pressed {:g} mm", tissue, kDeep)};
  plot.x = {.label = "distance from the ball", .unit = "mm", .from = 0.0, .to = 60.0};
  plot.y = {.label = "height of the skin", .unit = "mm", .from = -11.0, .to = 2.0};
  plot.series = {profileSeries(findRivalRow(found, Rival::fsmd, tissue, kDeep, found.plan.common_cells).truth)};
  for (const Rival rival : kRivals) {
    if (rival == Rival::elements_answers) continue;  // the same skin as elements
    plot.series.push_back(profileSeries(findRivalRow(found, rival, tissue, kDeep, found.plan.common_cells)));
  }
  return plot;
}

Plot costPlot(const RivalsMeasurement& found) {
  constexpr Marker kMarkers[] = {Marker::circle,  Marker::cross,  Marker::triangle,
                                 Marker::diamond, Marker::square, Marker::square};
  Plot plot{.title = fmt::format("\"back_mid\" pressed {:g} mm, skins of {} to {} vertices", kDeep,
                                 (found.plan.cells.front() + 1) * (found.plan.cells.front() + 1),
                                 (found.plan.cells.back() + 1) * (found.plan.cells.back() + 1))};
  plot.x = {.label = "time of a press", .unit = "ms", .scale = Scale::logarithmic};
  plot.y = {
      .label = "error of the skin", .unit = "% of the depth", .scale = Scale::logarithmic, .from = 1.0, .to = 100.0};
  for (std::size_t i = 0; i < kRivals.size(); ++i) {
    Series series{.name = nameOf(kRivals[i]), .marker = kMarkers[i], .colour = colourOfRival(kRivals[i])};
    for (const int cells : found.plan.cells) {
      const RivalRow& row = findRivalRow(found, kRivals[i], "back_mid", kDeep, cells);
      series.x.push_back(1e-3 * row.press_us);
      series.y.push_back(100.0 * row.error);
    }
    plot.series.push_back(series);
  }
  plot.shapes = {verticalLine("a picture at 60 Hz", 1e3 / 60.0, 1.0, 100.0)};
  return plot;
}

figures::MeshView errorView(const RivalsMeasurement& found, Rival rival) {
  constexpr double kRange = 0.15;
  const RivalRow& row = findRivalRow(found, rival, "back_mid", kDeep, found.plan.common_cells);
  figures::MeshView view{.title = nameOf(rival)};
  view.towards_viewer = Vec3(0.3, -1.0, 0.75);
  view.up = Vec3::UnitZ();
  view.ambient = 0.7;
  view.edges = true;
  view.triangles = TissueBlock(row.truth.layers, found.plan.side_mm, row.cells).skin().triangles;
  std::vector<double> errors;
  for (std::size_t v = 0; v < row.vertices; ++v) {
    const Vec3 truth = trueDisplacement(row.truth, row.rest[v].head<2>());
    errors.push_back((row.displacements[v] - truth).norm() / row.truth.central_mm);
    view.positions.push_back(row.rest[v] + row.displacements[v]);
  }
  for (const Triangle& t : view.triangles) {
    const double error = (errors[t[0]] + errors[t[1]] + errors[t[2]]) / 3.0;
    view.colours.push_back(figures::mapColour(ColourMap::viridis, std::min(1.0, error / kRange)));
  }
  view.colour_key =
      figures::ColourKey{.label = "off the truth", .unit = "% of the depth", .from = 0.0, .to = 100.0 * kRange};
  return view;
}

}  // namespace

std::vector<StudyFigure> rivalFigures(const RivalsMeasurement& found) {
  Figure sections{.columns = 2};
  for (const char* tissue : {"back_mid", "bony", "stiff_skin"})
    sections.panels.emplace_back(sectionPlot(found, tissue));
  Figure skins{.columns = 2, .panel_width_px = 430.0, .panel_height_px = 300.0};
  for (const Rival rival : {Rival::fsmd, Rival::free_form, Rival::mass_spring, Rival::elements}) {
    skins.panels.emplace_back(errorView(found, rival));
  }
  return {{"rivals_sections", "The skin beside the ball, for three tissues; only the right half.", sections},
          {"rivals_cost", "Error against time of a press, each method on skins of several sizes.",
           Figure{.panels = {costPlot(found)}, .panel_width_px = 640.0, .panel_height_px = 420.0}},
          {"rivals_skins", "The pressed skin, coloured by how far it is off the truth.", skins}};
}

std::string readableTime(double microseconds) {
  if (microseconds < 1e3) return rounded(microseconds) + " us";
  return microseconds < 1e6 ? rounded(1e-3 * microseconds) + " ms" : rounded(1e-6 * microseconds) + " s";
}

std::string readableBytes(double bytes) {
  return bytes < 1e6 ? rounded(1e-3 * bytes) + " kB" : rounded(1e-6 * bytes) + " MB";
}

}  // namespace palpate::study
