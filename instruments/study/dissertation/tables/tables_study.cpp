// Tables 3.1, 3.2 and Appendix B: rates measured today and the printed ones; their shapes are compared, not their
// sizes.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <cctype>

#include "dissertation/numbers/printed_numbers.h"
#include "dissertation/tables/rate_curves.h"
#include "dissertation/tables/rendering_rates.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::Colour;

// ------------------------------------------------------------------------------------------------------------ plots

/// Look of a kind of frame.
struct KindLook {
  Colour colour;
  Marker marker;
};

KindLook kindLook(const FrameKind& kind) {
  const KindLook looks[] = {
      {figures::kBlue, Marker::circle}, {figures::kVermilion, Marker::square}, {figures::kGreen, Marker::triangle}};
  return looks[static_cast<std::size_t>(&kind - kFrameKinds.data())];
}

const std::vector<double> kRateTicks{1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
const std::vector<double> kTimeTicks{0.0001, 0.001, 0.01, 0.1, 1, 10, 100};  // ms

void add(Plot& plot, const std::string& name, const RateCurve& curve, const Colour& colour, Marker marker,
         bool printed) {
  if (curve.x.empty()) return;
  Series series =
      printed ? dissertationSeries(name, curve.x, curve.y, marker) : measuredSeries(name, curve.x, curve.y, marker);
  series.colour = colour;
  plot.series.push_back(series);
}

Plot wholePlot(const RatesMeasurement& found, bool as_rate) {
  RateCurve printed_haptic, printed_graphic, haptic, picture, tick;  // ms
  for (const PrintedRate& rate : printedNumbers().table_3_1) {
    printed_haptic.add(rate.triangles, 1000.0 / rate.haptic_fps);
    printed_graphic.add(rate.triangles, 1000.0 / rate.graphic_fps);
  }
  for (const WholeModelRow& row : found.whole) {
    const auto triangles = static_cast<double>(row.triangles);
    haptic.add(triangles, 1e-3 * row.touchedMicroseconds());
    tick.add(triangles, 1e-3 * row.tick_us);
    if (row.picture_us) picture.add(triangles, 1e-3 * *row.picture_us);
  }
  const auto shown = [&](const RateCurve& curve) { return as_rate ? inverse(curve) : curve; };
  Plot plot{.title = as_rate ? "Rates, whole models" : "Time of a frame, whole models"};
  plot.x = {.label = "triangles",
            .scale = Scale::logarithmic,
            .from = 2000.0,
            .to = 50000.0,
            .ticks = ticksAt({2000, 5000, 10000, 20000, 50000})};
  plot.y = {.label = as_rate ? "rate" : "time", .unit = as_rate ? "1/s" : "ms", .scale = Scale::logarithmic};
  plot.y.from = as_rate ? 1.0 : 5e-5;
  plot.y.to = as_rate ? 2e7 : 500.0;
  plot.y.ticks = as_rate ? ticksAt(kRateTicks) : ticksAt(kTimeTicks);
  add(plot, "haptic, touched (printed)", shown(printed_haptic), figures::kGreen, Marker::triangle, true);
  add(plot, "graphic (printed)", shown(printed_graphic), figures::kPurple, Marker::diamond, true);
  add(plot, "haptic, dissertation's way here", shown(haptic), figures::kGreen, Marker::triangle, false);
  add(plot, "graphic, dissertation's way here", shown(picture), figures::kPurple, Marker::diamond, false);
  add(plot, "our tick", shown(tick), figures::kInk, Marker::cross, false);
  return plot;
}

figures::Axis renderedAxis(const RatesMeasurement& found) {
  return {.label = "triangles rendered", .from = 0.0, .to = 0.4 * static_cast<double>(found.plan.partitioned)};
}

RateCurve tickCurve(const RatesMeasurement& found) {
  const double ms = 1e-3 * found.tick_us;
  return {{0.0, *renderedAxis(found).to}, {ms, ms}};
}

Plot treePlot(const RatesMeasurement& found, const TreeRates& rates, const PrintedTimings& printed, bool as_rate) {
  const auto shown = [&](const RateCurve& curve) { return as_rate ? inverse(curve) : curve; };
  Plot plot{.title = as_rate ? "Rate against triangles rendered" : "Time against triangles rendered"};
  plot.x = renderedAxis(found);
  plot.y = {.label = as_rate ? "rate" : "time", .unit = as_rate ? "1/s" : "ms", .scale = Scale::logarithmic};
  plot.y.from = as_rate ? 1.0 : 5e-5;
  plot.y.to = as_rate ? 2e7 : 500.0;
  plot.y.ticks = as_rate ? ticksAt(kRateTicks) : ticksAt(kTimeTicks);
  for (const FrameKind& kind : kFrameKinds) {
    add(plot, fmt::format("{} (printed)", kind.name), shown(printedCurve(printed.*kind.printed)), kindLook(kind).colour,
        kindLook(kind).marker, true);
  }
  for (const FrameKind& kind : kFrameKinds) {
    add(plot, fmt::format("{} (here)", kind.name), shown(measuredCurve(rates, kind)), kindLook(kind).colour,
        kindLook(kind).marker, false);
  }
  add(plot, "our tick", shown(tickCurve(found)), figures::kInk, Marker::none, false);
  return plot;
}

Plot comparedPlot(const RatesMeasurement& found, const FrameKind& kind) {
  const PrintedNumbers printed = printedNumbers();
  Plot plot{.title = fmt::format("{}{}", static_cast<char>(std::toupper(kind.name[0])), kind.name + 1)};
  plot.x = renderedAxis(found);
  plot.y = {.label = "time", .unit = "ms", .scale = Scale::logarithmic, .from = 0.01, .to = 1000.0};
  add(plot, "BSP (printed)", printedCurve(printed.table_3_2.*kind.printed), figures::kBlue, Marker::circle, true);
  add(plot, "octree (printed)", printedCurve(printed.appendix_b.*kind.printed), figures::kVermilion, Marker::square,
      true);
  add(plot, "BSP (here)", measuredCurve(found.bsp, kind), figures::kBlue, Marker::circle, false);
  add(plot, "octree (here)", measuredCurve(found.octree, kind), figures::kVermilion, Marker::square, false);
  return plot;
}

Figure treeFigure(const RatesMeasurement& found, const TreeRates& rates, const PrintedTimings& printed) {
  return {.panels = {treePlot(found, rates, printed, false), treePlot(found, rates, printed, true)}, .columns = 2};
}

std::vector<StudyFigure> makeFigures(const RatesMeasurement& found) {
  const PrintedNumbers printed = printedNumbers();
  Figure trees{.columns = 3};
  trees.panel_width_px = 380.0;
  for (const FrameKind& kind : kFrameKinds) {
    Plot plot = comparedPlot(found, kind);
    if (!plot.series.empty()) trees.panels.emplace_back(plot);
  }
  return {{"tables_3_1", "Figure 3.1: whole models without a partition. Dashed: printed, 2008.",
           Figure{.panels = {wholePlot(found, true), wholePlot(found, false)}, .columns = 2}},
          {"tables_3_10", "Figure 3.10: a BSP tree on 41,582 triangles. Dashed: printed, 2008; solid: here.",
           treeFigure(found, found.bsp, printed.table_3_2)},
          {"tables_appendix_b", "The same with an octree (Appendix B).",
           treeFigure(found, found.octree, printed.appendix_b)},
          {"tables_3_16_to_18", "Figures 3.16 to 3.18: BSP tree against octree at equal numbers of triangles.", trees}};
}

// ----------------------------------------------------------------------------------------------------------- tables

std::string optionalRate(const std::optional<double>& us) { return us ? rounded(1e6 / *us, 3) : "-"; }

TextTable wholeTable(const RatesMeasurement& found) {
  TextTable table{{"triangles", "haptic printed (1/s)", "haptic here (1/s)", "graphic printed (1/s)",
                   "graphic here (1/s)", "haptic / graphic printed", "here", "our tick (us)", "ticks (1/s)"},
                  {}};
  const auto printed = printedNumbers().table_3_1;
  for (std::size_t i = 0; i < found.whole.size(); ++i) {
    const WholeModelRow& row = found.whole[i];
    const std::string ratio = row.picture_us ? rounded(*row.picture_us / row.touchedMicroseconds()) : "-";
    table.rows.push_back({counted(static_cast<double>(row.triangles)), rounded(printed[i].haptic_fps, 3),
                          rounded(1e6 / row.touchedMicroseconds(), 3), rounded(printed[i].graphic_fps, 3),
                          optionalRate(row.picture_us), rounded(printed[i].haptic_fps / printed[i].graphic_fps), ratio,
                          rounded(row.tick_us), rounded(1e6 / row.tick_us)});
  }
  return table;
}

TextTable treeTable(const TreeRates& rates, const PrintedTimings& printed) {
  TextTable table{{"frame", "triangles printed", "ms printed", "triangles here", "box (mm)", "ms here", "1/s printed",
                   "1/s here", "our list (us)"},
                  {}};
  for (const FrameKind& kind : kFrameKinds) {
    const auto& timings = printed.*kind.printed;
    const auto& rows = rates.*kind.measured;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::optional<double> us = kind.us(rows[i]);
      table.rows.push_back({kind.name, fmt::format("{}", timings[i].triangles), timings[i].ms,
                            counted(rows[i].triangles), rounded(rows[i].edge_mm), us ? rounded(1e-3 * *us, 3) : "-",
                            timings[i].fps, optionalRate(us), rounded(rows[i].exact_us)});
    }
  }
  return table;
}

std::vector<std::string> describeMethod(const RatesMeasurement& found) {
  const RatesPlan& plan = found.plan;
  const std::string drawing =
      found.renderer.empty()
          ? "Drawing is left out, because this machine offers no such OpenGL (" + found.no_renderer + ")."
          : fmt::format(
                "Drawing is what OpenHaptics had its programs do: every triangle of the leaves goes vertex by vertex, "
                "each with its normal, through glBegin and glEnd into the feedback buffer of OpenGL 2.1 "
                "(`engine/view/palpate/view/layers/immediate_drawing.h`), here offscreen by {}. \"Graphic\" is the "
                "whole model, lit, into a picture of {} x {} pixels in the same way.",
                found.renderer, plan.width_px, plan.height_px);
  return {
      drawing,
      "Untouched adds finding the leaves and testing every triangle rendered against the tip's way; touched adds the "
      "nearest point of every triangle, spring and friction (`instruments/study/lab/measured/literal_process.h`). What "
      "the haptic library of 2008 did inside is not known; this is the least that it had to do, so times in the "
      "dissertation's way are lower bounds.",
      fmt::format(
          "Models: the benchmark's back in the sizes of Appendix A, because none of the author's was published. Table "
          "3.2 and Appendix B: {} triangles, case C, threshold 1024; for each printed number of triangles the place "
          "(of {}) and box (2 to 100 % of the model) whose leaves hold about as many. Each time is the fastest of {} "
          "runs. Our tick: the mean over strokes at 0.2 m/s.",
          counted(static_cast<double>(plan.partitioned)), plan.places, plan.runs)};
}

std::vector<std::pair<std::string, double>> numbersOf(const RatesMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers{{"tick_us", found.tick_us}};
  for (const FrameKind& kind : kFrameKinds) {
    numbers.emplace_back(fmt::format("bsp_{}_ns_per_triangle", kind.name),
                         1e3 * costPerTriangle(measuredCurve(found.bsp, kind)));
    numbers.emplace_back(fmt::format("octree_{}_ns_per_triangle", kind.name),
                         1e3 * costPerTriangle(measuredCurve(found.octree, kind)));
  }
  for (const WholeModelRow& row : found.whole) {
    numbers.emplace_back(fmt::format("touched_us_{}", row.triangles), row.touchedMicroseconds());
    numbers.emplace_back(fmt::format("tick_us_{}", row.triangles), row.tick_us);
  }
  return numbers;
}

}  // namespace

StudyPage studyTables(const StudySettings& settings) {
  const RatesMeasurement found = measureRates(ratesPlan(settings.quick), settings.progress);
  const PrintedNumbers printed = printedNumbers();
  return {.title = "Tables 3.1, 3.2 and Appendix B",
          .question =
              "In 2008 haptics slowed down with the model: 104 frames a second with 2,915 triangles, 6 with 41,582 "
              "(Table 3.1); a partition brought it back to 7 to 91 (Table 3.2), an octree a little further (Appendix "
              "B). What becomes of these tables on a computer of today, in the dissertation's way and in ours?",
          .findings = ratesFindings(found),
          .method = describeMethod(found),
          .tables = {{"tables_3_1_table", "Table 3.1.", wholeTable(found)},
                     {"tables_3_2_table", "Table 3.2: BSP tree.", treeTable(found.bsp, printed.table_3_2)},
                     {"tables_appendix_b_table", "Appendix B: octree.", treeTable(found.octree, printed.appendix_b)}},
          .figures = makeFigures(found),
          .numbers = numbersOf(found)};
}

}  // namespace palpate::study
