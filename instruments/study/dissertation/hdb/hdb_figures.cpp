// The pictures of the study of the detecting box.
#include "dissertation/hdb/hdb_measurement.h"

#include <fmt/format.h>

#include <iterator>

#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr Marker kCurveMarkers[] = {Marker::circle,  Marker::square, Marker::triangle,
                                    Marker::diamond, Marker::cross,  Marker::none};
// 3.3.4: "1/3 triangles (tested in experiments)", and r = 0.1 a page later.
constexpr double kPrintedShares[] = {1.0 / 3.0, 0.1};

figures::Axis shareAxis() {
  return {.label = "edge of the box / longest edge of the model",
          .scale = Scale::logarithmic,
          .from = 1.0 / 20.0,
          .to = 1.0,
          .ticks = fractionTicksAt({1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0})};
}

figures::Axis throughAxis() {
  return {.label = "strokes that get through the skin", .unit = "%", .from = 0.0, .to = 100.0};
}

/// A curve for each of the values through the places of the rows that have it, with markers in turn.
template <class Value, class Row, class Name, class Place>
std::vector<Series> makeCurves(const std::vector<Value>& values, Value Row::*member, const std::vector<Row>& rows,
                               const Name& name, const Place& place) {
  std::vector<Series> curves;
  for (const Value value : values) {
    const Marker marker = kCurveMarkers[curves.size() % std::size(kCurveMarkers)];
    Series& curve = curves.emplace_back(measuredSeries(name(value), {}, {}, marker));
    for (const Row& row : rows) {
      if (row.*member != value) continue;
      const Vec2 at = place(row);
      curve.x.push_back(at.x());
      curve.y.push_back(at.y());
    }
  }
  return curves;
}

Plot trianglesPlot(const HdbMeasurement& found) {
  Plot plot{.title = "What is rendered"};
  plot.x = shareAxis();
  plot.y = {.label = "triangles", .scale = Scale::logarithmic, .from = 100.0, .to = 100000.0};
  const auto shares = column(found.sizes, &HdbSizeRow::share);
  const auto all = static_cast<double>(found.plan.triangles);
  plot.series = {measuredSeries("leaves of the BSP tree", shares, column(found.sizes, &HdbSizeRow::bsp_triangles)),
                 measuredSeries("leaves of the octree", shares, column(found.sizes, &HdbSizeRow::octree_triangles),
                                Marker::square),
                 measuredSeries("triangles of the box", shares, column(found.sizes, &HdbSizeRow::exact_triangles),
                                Marker::triangle),
                 dissertationSeries("printed: a third, a tenth of all", {kPrintedBoxShare, kPrintedBoxShare},
                                    {kPrintedShares[0] * all, kPrintedShares[1] * all}, Marker::cross)};
  plot.series.back().stroke = figures::Stroke::none;
  plot.shapes = {verticalLine("1/4, the dissertation's", kPrintedBoxShare, 100.0, 100000.0)};
  return plot;
}

Plot timesPlot(const HdbMeasurement& found) {
  Plot plot{.title = "Time of a frame, touched, without drawing"};
  plot.x = shareAxis();
  plot.y = {.label = "time", .unit = "us", .scale = Scale::logarithmic, .from = 0.05, .to = 2000.0};
  const auto shares = column(found.sizes, &HdbSizeRow::share);
  plot.series = {
      measuredSeries("dissertation's way, BSP tree", shares, column(found.sizes, &HdbSizeRow::bsp_us)),
      measuredSeries("dissertation's way, octree", shares, column(found.sizes, &HdbSizeRow::octree_us), Marker::square),
      measuredSeries("our list of the box's triangles", shares, column(found.sizes, &HdbSizeRow::exact_us),
                     Marker::triangle),
      measuredSeries("our tick, without a box", shares, std::vector<double>(shares.size(), found.tick_us),
                     Marker::none)};
  plot.shapes = {verticalLine("", kPrintedBoxShare, 0.05, 2000.0)};
  return plot;
}

std::string speedName(double mm_s) { return fmt::format("{:g} m/s", metresPerSecond(mm_s)); }

Plot puncturesPlot(const HdbMeasurement& found, const std::vector<PunctureRow>& rows, const std::string& title) {
  Plot plot{.title = title};
  plot.x = {.label = "edge of the box",
            .unit = "mm",
            .scale = Scale::logarithmic,
            .from = 2.0,
            .to = 200.0,
            .ticks = ticksAt({2, 5, 10, 20, 50, 100, 200})};
  plot.y = throughAxis();
  plot.series = makeCurves(found.plan.speeds_mm_s, &PunctureRow::speed_mm_s, rows, speedName,
                           [](const PunctureRow& row) { return Vec2(row.edge_mm, 100.0 * row.punctured); });
  plot.shapes = {verticalLine("1/10", kTenth * found.longest_edge, 0.0, 100.0),
                 verticalLine("1/4 of the model", kPrintedBoxShare * found.longest_edge, 0.0, 100.0)};
  plot.shapes.front().stroke = figures::Stroke::dashed;
  return plot;
}

Plot leadPlot(const HdbMeasurement& found) {
  Plot plot{.title = "All speeds and delays"};
  plot.x = {.label = "half the edge / (speed x delay)",
            .scale = Scale::logarithmic,
            .from = 0.25,
            .to = 4.0,
            .ticks = {{0.25, "0.25"}, {0.5, "0.5"}, {1.0, "1"}, {2.0, "2"}, {4.0, "4"}}};
  plot.y = throughAxis();
  plot.series = makeCurves(
      found.plan.delays_ticks, &PunctureRow::delay_ticks, found.leads,
      [](int delay) { return fmt::format("box follows every {} ms", delay); },
      [](const PunctureRow& row) { return Vec2(row.lead(), 100.0 * row.punctured); });
  for (Series& series : plot.series) series.stroke = figures::Stroke::none;
  plot.shapes = {verticalLine("half the edge = way of the finger", 1.0, 0.0, 100.0)};
  return plot;
}

Plot recommendedPlot(const HdbMeasurement& found) {
  Plot plot{.title = "Triangles in the box that the rule asks for"};
  plot.x = {.label = "speed of the finger", .unit = "m/s", .scale = Scale::logarithmic, .from = 0.1, .to = 2.0};
  plot.y = {.label = "triangles", .scale = Scale::logarithmic};
  plot.series = makeCurves(
      found.plan.delays_ticks, &PunctureRow::delay_ticks, found.recommended,
      [](int delay) { return fmt::format("rule, {} ms", delay); },
      [](const PunctureRow& row) { return Vec2(metresPerSecond(row.speed_mm_s), row.triangles); });
  const HdbSizeRow& quarter = quarterRow(found);
  const std::vector<double> ends{metresPerSecond(found.plan.speeds_mm_s.front()),
                                 metresPerSecond(found.plan.speeds_mm_s.back())};
  const auto level = [&](const std::string& name, double triangles) {
    Series series = dissertationSeries(name, ends, {triangles, triangles}, Marker::none);
    plot.series.push_back(series);
  };
  level("1/4, leaves of the BSP tree", quarter.bsp_triangles);
  level("1/4, triangles of the box", quarter.exact_triangles);
  return plot;
}

Plot marginPlot(const HdbMeasurement& found) {
  Plot plot{.title = "Edge = 2 (speed x delay + margin)"};
  plot.x = {.label = "margin / depth of the finger", .from = 0.0, .to = 1.0};
  plot.y = throughAxis();
  plot.series = makeCurves(
      found.plan.depths_mm, &MarginRow::depth_mm, found.margins,
      [](double depth) { return fmt::format("{:g} mm deep", depth); },
      [](const MarginRow& row) { return Vec2(row.share, 100.0 * row.punctured); });
  return plot;
}

}  // namespace

std::vector<StudyFigure> hdbFigures(const HdbMeasurement& found) {
  return {{"hdb_size", "Triangles rendered and time of a frame for every size of box.",
           Figure{.panels = {trianglesPlot(found), timesPlot(found)}, .columns = 2}},
          {"hdb_punctures",
           fmt::format("Strokes that get through the skin when the box follows every {} ms. Left, the finger collides "
                       "with the triangles that the box meets; right, as printed, with all triangles of the leaves.",
                       found.plan.delays_ticks.front()),
           Figure{.panels = {puncturesPlot(found, found.punctures, "Triangles of the box"),
                             puncturesPlot(found, found.leaf_punctures, "Leaves of the octree, 1024")},
                  .columns = 2}},
          {"hdb_lead", "One number decides: half the edge over the way of the finger until the box follows.",
           Figure{.panels = {leadPlot(found)}}},
          {"hdb_margin",
           "What must be added to the way of the finger: a share of its depth, whatever the depth; all speeds and "
           "delays together.",
           Figure{.panels = {marginPlot(found)}}},
          {"hdb_rule", "What the rule in place of 1/4 renders, against 1/4 itself.",
           Figure{.panels = {recommendedPlot(found)}}}};
}

}  // namespace palpate::study
