// The study of directions: the dissertation's own data and back first, then axes whose truth is known.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dissertation/directions/axis_means.h"
#include "dissertation/directions/direction_fields.h"
#include "lab/measured/back_map.h"
#include "palpate/scene/words.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using maps::DirectionBlend;

constexpr std::array<const char*, 3> kMeanNames{"degrees as numbers (printed)", "double angle", "tensor (ours)"};

std::vector<PointMeans> meansOfAppendixC() {
  std::vector<PointMeans> all;
  for (const auto force : {maps::ForceDirection::up, maps::ForceDirection::down}) {
    for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
      const auto rows = maps::measuredAt(force, point);
      PointMeans& means = all.emplace_back(PointMeans{force, point, {}, maps::axialMean(rows).resultant});
      for (std::size_t i = 0; i < kAxisMeans.size(); ++i) means.deg[i] = meanAxisDeg(rows, kAxisMeans[i]);
    }
  }
  return all;
}

// P3 of all subjects is at 180 degree. Written as 0 for one of them it is the same axis; how far each mean turns.
std::array<double, 3> turnByOneFlip() {
  auto rows = maps::measuredAt(maps::ForceDirection::up, 3);
  std::array<double, 3> before{};
  std::array<double, 3> turn{};
  for (std::size_t i = 0; i < kAxisMeans.size(); ++i) before[i] = meanAxisDeg(rows, kAxisMeans[i]);
  rows[0].direction_deg = 0.0;
  for (std::size_t i = 0; i < kAxisMeans.size(); ++i) {
    turn[i] = axisDifferenceDeg(meanAxisDeg(rows, kAxisMeans[i]), before[i]);
  }
  return turn;
}

AxisCurve curveOver(const std::vector<double>& x, const AxisScatter& scatter, double AxisScatter::*varied) {
  AxisCurve curve{x, {}};
  for (const double value : x) {
    AxisScatter one = scatter;
    one.*varied = value;
    const auto errors = meanErrorsDeg(one);
    for (std::size_t i = 0; i < errors.size(); ++i) curve.error_deg[i].push_back(errors[i]);
  }
  return curve;
}

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

std::vector<maps::KeyPoint> keysOf(maps::ForceDirection force) {
  return maps::dissertationKeyPoints({force, maps::Averaging::plain});
}

constexpr double kMirrorStep = 25.0;  // mm

DirectionResults measuredDirections(const StudySettings& settings) {
  const auto places = placesOnBack(settings.quick ? 25.0 : 5.0);
  const int trials = settings.quick ? 100 : 4000;
  const int count = settings.quick ? 5 : 13;
  DirectionResults results;
  results.means = meansOfAppendixC();
  results.flip = turnByOneFlip();
  report(settings.progress, "directions over the back", 0.1);
  const auto up = keysOf(maps::ForceDirection::up);
  results.printed_up = compareFields(up, DirectionBlend::raw_degrees, places);
  results.doubled_up = compareFields(up, DirectionBlend::double_angle, places);
  results.printed_down = compareFields(keysOf(maps::ForceDirection::down), DirectionBlend::raw_degrees, places);
  results.tensor_mirror_deg = compareFields(up, DirectionBlend::tensor, placesOnBack(kMirrorStep)).mirror_deg;
  report(settings.progress, "means of known axes", 0.5);
  const auto spreads = steps(0.0, 40.0, count);
  results.spread_away = curveOver(spreads, {.true_deg = 90.0, .trials = trials}, &AxisScatter::spread_deg);
  results.spread_seam = curveOver(spreads, {.true_deg = 0.0, .trials = trials}, &AxisScatter::spread_deg);
  results.direction = curveOver(steps(0.0, 180.0, 2 * count - 1), {.spread_deg = kStudiedSpread, .trials = trials},
                                &AxisScatter::true_deg);
  results.noise = curveOver(steps(0.0, 0.2, count), {.true_deg = -1.0, .trials = trials}, &AxisScatter::radius_noise);
  return results;
}

// --- figures

// Short lines along the axes, longer where the ellipse is slimmer.
figures::Shape axisStrokes(const maps::LiteralEllipseMap& map) {
  constexpr double kGrid = 18.0;
  constexpr double kLongest = 8.0;    // mm to both sides
  constexpr double kSlimmest = 0.75;  // aspect of a stroke of full length
  figures::Shape strokes{.closed = false, .colour = figures::kInk, .width_px = 1.4};
  for (const Vec2& place : placesOnBack(kGrid)) {
    const maps::Ellipse ellipse = map.at(place.x(), place.y());
    const double share = std::min(1.0, (1.0 - ellipse.aspect) / (1.0 - kSlimmest));
    const Vec2 along(std::cos(ellipse.direction_rad), std::sin(ellipse.direction_rad));
    const Vec2 reach = kLongest * (0.25 + 0.75 * share) * along;
    strokes.paths.push_back({place - reach, place + reach});
  }
  return strokes;
}

// Away from the spine instead of against x: no jump between 180 and 0, and a mirror image looks like one.
Plot directionPlot(const std::string& title, std::span<const maps::KeyPoint> keys, DirectionBlend blend) {
  const maps::LiteralEllipseMap map = directionMap(keys, blend);
  const MapLook look{.label = "major axis from the spine", .unit = "degree", .to = 90.0, .colours = ColourMap::cividis};
  Plot plot = backMap(
      title, [&](const Vec2& place) { return axisDifferenceDeg(directionDegAt(map, place), 90.0); }, look, keys);
  plot.shapes.push_back(axisStrokes(map));
  return plot;
}

Plot differencePlot(std::span<const maps::KeyPoint> keys) {
  const maps::LiteralEllipseMap printed = directionMap(keys, DirectionBlend::raw_degrees);
  const maps::LiteralEllipseMap tensor = directionMap(keys, DirectionBlend::tensor);
  const MapLook look{.label = "between the two axes", .unit = "degree", .to = 90.0, .contour_levels = {10, 30, 60}};
  return backMap(
      "Where they differ",
      [&](const Vec2& place) {
        return axisDifferenceDeg(directionDegAt(printed, place), directionDegAt(tensor, place));
      },
      look, keys);
}

Figure fieldFigure(maps::ForceDirection force) {
  const auto keys = keysOf(force);
  return {.panels = {directionPlot("Degrees as numbers, as printed", keys, DirectionBlend::raw_degrees),
                     directionPlot("Tensors, ours", keys, DirectionBlend::tensor), differencePlot(keys)},
          .columns = 3,
          .panel_width_px = 400.0,
          .panel_height_px = 390.0};
}

Series errorSeries(const std::string& name, const AxisCurve& curve, std::size_t mean) {
  return {.name = name, .x = curve.x, .y = curve.error_deg[mean], .marker = Marker::circle};
}

Plot errorPlot(const std::string& title, const std::string& label, const std::string& unit) {
  Plot plot{.title = title};
  plot.x = {.label = label, .unit = unit};
  plot.y = {.label = "error of the mean, rms", .unit = "degree", .from = 0.0};
  return plot;
}

Figure meansFigure(const DirectionResults& results) {
  Plot spread = errorPlot("Five axes that spread", "standard deviation of the angles", "degree");
  spread.series = {errorSeries("numbers, true axis at 90 degree", results.spread_away, 0),
                   errorSeries("numbers, true axis at 0 degree", results.spread_seam, 0),
                   errorSeries("tensor, at 90", results.spread_away, 2),
                   errorSeries("tensor, at 0", results.spread_seam, 2)};
  spread.series[0].colour = spread.series[1].colour = figures::kBlue;
  spread.series[2].colour = spread.series[3].colour = figures::kVermilion;
  spread.series[1].stroke = spread.series[3].stroke = Stroke::dashed;
  spread.series[3].marker = Marker::none;
  Plot around = errorPlot(fmt::format("A spread of {} degree", kStudiedSpread), "true axis", "degree");
  around.x.ticks = {{0, "0"}, {45, "45"}, {90, "90"}, {135, "135"}, {180, "180"}};
  Plot noise = errorPlot("Radii that are measured badly", "noise of the radii", "%");
  for (const std::size_t mean : {0u, 2u, 1u}) {  // the double angle over the tensor: they nearly coincide
    around.series.push_back(errorSeries(kMeanNames[mean], results.direction, mean));
    noise.series.push_back(errorSeries(kMeanNames[mean], results.noise, mean));
    for (double& x : noise.series.back().x) x *= 100.0;
  }
  for (Plot* plot : {&around, &noise}) {
    plot->series[2].stroke = Stroke::dashed;
    plot->series[2].marker = Marker::none;
    plot->series[2].colour = figures::kInk;
  }
  return {.panels = {spread, around, noise}, .columns = 3, .panel_width_px = 400.0, .panel_height_px = 360.0};
}

// --- words

StudyTable meansTable(const std::vector<PointMeans>& all) {
  StudyTable table{"directions_points", "Mean direction of the subjects at every point (degree):", {}};
  table.table.headings = {"dragged",
                          "point",
                          "numbers (printed)",
                          "double angle",
                          "tensor (ours)",
                          "printed against tensor",
                          "agreement of the subjects, 1 = all alike"};
  for (const PointMeans& means : all) {
    table.table.rows.push_back({std::string(wordFor(means.force)), fmt::format("P{}", means.point),
                                fmt::format("{:.1f}", means.deg[0]), fmt::format("{:.1f}", means.deg[1]),
                                fmt::format("{:.1f}", means.deg[2]), fmt::format("{:.1f}", printedAgainstTensor(means)),
                                fmt::format("{:.2f}", means.resultant)});
  }
  return table;
}

StudyTable fieldTable(const DirectionResults& results) {
  StudyTable table{"directions_fields", "Blended over the back, against the tensor field:", {}};
  table.table.headings = {"blend",           "mean difference",   "largest",
                          "above 10 degree", "boundary moves by", "breach of the mirror symmetry"};
  const auto add = [&](const std::string& name, const FieldComparison& field) {
    table.table.rows.push_back(
        {name, fmt::format("{:.1f} deg", field.mean_deg), fmt::format("{:.1f} deg", field.most_deg),
         fmt::format("{} of the back", percent(field.share_above_10_deg)),
         fmt::format("up to {:.1f} mm", field.most_boundary_mm), fmt::format("{:.1f} deg", field.mirror_deg)});
  };
  add("numbers, dragged up", results.printed_up);
  add("double angle, dragged up", results.doubled_up);
  add("numbers, dragged down", results.printed_down);
  return table;
}

}  // namespace

StudyPage studyDirections(const StudySettings& settings) {
  const DirectionResults results = measuredDirections(settings);
  return {
      .title = "Directions of ellipses: numbers or tensors",
      .question =
          "The dissertation averages the directions of ellipses as numbers, between subjects (Appendix C) and between "
          "key points (5.17). An axis has no sense, so 0 and 180 degree are the same, and a circle has no direction at "
          "all (E29, E30). Where does this matter, and by how much?",
      .findings = directionFindings(results),
      .method = {"The fields are the engine's ellipse map over the seven key points (radius of effect 200 mm, basic "
                 "circle 150 mm), with the printed, the double-angle and the tensor blend and nothing else changed. "
                 "Where the points lie on the back is assumed (E33).",
                 "Known axes: five ellipses with the mean size and ratio of Appendix C, turned by normal noise, or "
                 "with normal noise on the logarithms of their radii; 4000 trials a point. The degrees are written in "
                 "[0, 180) as in Appendix C."},
      .tables = {meansTable(results.means), fieldTable(results)},
      .figures = {{"directions_up",
                   "The field of directions, dragged up: printed, ours, and the angle between the two. Short strokes "
                   "are near-circles.",
                   fieldFigure(maps::ForceDirection::up)},
                  {"directions_down", "The same with the data of the three subjects dragged down.",
                   fieldFigure(maps::ForceDirection::down)},
                  {"directions_means", "Error of the mean of five axes whose truth is known.", meansFigure(results)}},
      .numbers = {{"field_mean_deg_up", results.printed_up.mean_deg},
                  {"field_max_deg_up", results.printed_up.most_deg},
                  {"field_share_above_10_deg_up", results.printed_up.share_above_10_deg},
                  {"boundary_max_mm_up", results.printed_up.most_boundary_mm},
                  {"mirror_breach_deg_up", results.printed_up.mirror_deg},
                  {"field_max_deg_down", results.printed_down.most_deg},
                  {"p5_up_printed_deg", results.means[4].deg[0]},
                  {"p5_up_tensor_deg", results.means[4].deg[2]}}};
}

}  // namespace palpate::study
