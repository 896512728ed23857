#include "study/hdb_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/hdb_measurement.h"
#include "study/number_row.h"
#include "study/plot_parts.h"
#include "study/printed_numbers.h"

namespace palpate::study {

namespace {

using figures::Figure;
using figures::Marker;
using figures::Plot;
using figures::Scale;
using figures::Series;

constexpr double kQuarter = 0.25;  // the dissertation's choice
constexpr double kTenth = 0.1;     // its example of a box that is too small
// 3.3.4: "1/3 triangles (tested in experiments)", and r = 0.1 a page later.
constexpr double kPrintedShares[] = {1.0 / 3.0, 0.1};

double metresPerSecond(double mm_s) { return 1e-3 * mm_s; }

const HdbSizeRow& quarterRow(const HdbMeasurement& found) {
  return *std::min_element(found.sizes.begin(), found.sizes.end(), [](const HdbSizeRow& a, const HdbSizeRow& b) {
    return std::abs(a.share - kQuarter) < std::abs(b.share - kQuarter);
  });
}

// ------------------------------------------------------------------------------------------------------------ plots

figures::Axis shareAxis() {
  return {.label = "edge of the box / longest edge of the model",
          .scale = Scale::logarithmic,
          .from = 1.0 / 20.0,
          .to = 1.0,
          .ticks = fractionTicksAt({1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0})};
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
                 printedSeries("printed: a third, a tenth of all", {kQuarter, kQuarter},
                               {kPrintedShares[0] * all, kPrintedShares[1] * all}, Marker::cross)};
  plot.series.back().stroke = figures::Stroke::none;
  plot.shapes = {verticalLine("1/4, the dissertation's", kQuarter, 100.0, 100000.0)};
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
  plot.shapes = {verticalLine("", kQuarter, 0.05, 2000.0)};
  return plot;
}

std::string speedName(double mm_s) { return fmt::format("{:g} m/s", metresPerSecond(mm_s)); }

Plot puncturesPlot(const HdbMeasurement& found, const std::vector<PunctureRow>& rows, const std::string& title) {
  constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond, Marker::cross};
  Plot plot{.title = title};
  plot.x = {.label = "edge of the box",
            .unit = "mm",
            .scale = Scale::logarithmic,
            .from = 2.0,
            .to = 200.0,
            .ticks = ticksAt({2, 5, 10, 20, 50, 100, 200})};
  plot.y = {.label = "strokes that get through the skin", .unit = "%", .from = 0.0, .to = 100.0};
  std::size_t next = 0;
  for (const double speed : found.plan.speeds_mm_s) {
    Series series = measuredSeries(speedName(speed), {}, {}, kMarkers[next++ % std::size(kMarkers)]);
    for (const PunctureRow& row : rows) {
      if (row.speed_mm_s != speed) continue;
      series.x.push_back(row.edge_mm);
      series.y.push_back(100.0 * row.punctured);
    }
    plot.series.push_back(series);
  }
  plot.shapes = {verticalLine("1/10", kTenth * found.longest_edge, 0.0, 100.0),
                 verticalLine("1/4 of the model", kQuarter * found.longest_edge, 0.0, 100.0)};
  plot.shapes.front().stroke = figures::Stroke::dashed;
  return plot;
}

Plot leadPlot(const HdbMeasurement& found) {
  constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle};
  Plot plot{.title = "All speeds and delays"};
  plot.x = {.label = "half the edge / (speed x delay)",
            .scale = Scale::logarithmic,
            .from = 0.25,
            .to = 4.0,
            .ticks = {{0.25, "0.25"}, {0.5, "0.5"}, {1.0, "1"}, {2.0, "2"}, {4.0, "4"}}};
  plot.y = {.label = "strokes that get through the skin", .unit = "%", .from = 0.0, .to = 100.0};
  std::size_t next = 0;
  for (const int delay : found.plan.delays_ticks) {
    Series series =
        measuredSeries(fmt::format("box follows every {} ms", delay), {}, {}, kMarkers[next++ % std::size(kMarkers)]);
    series.stroke = figures::Stroke::none;
    for (const PunctureRow& row : found.leads) {
      if (row.delay_ticks != delay) continue;
      series.x.push_back(row.lead());
      series.y.push_back(100.0 * row.punctured);
    }
    plot.series.push_back(series);
  }
  plot.shapes = {verticalLine("half the edge = way of the finger", 1.0, 0.0, 100.0)};
  return plot;
}

Plot recommendedPlot(const HdbMeasurement& found) {
  constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle};
  Plot plot{.title = "Triangles in the box that the rule asks for"};
  plot.x = {.label = "speed of the finger", .unit = "m/s", .scale = Scale::logarithmic, .from = 0.1, .to = 2.0};
  plot.y = {.label = "triangles", .scale = Scale::logarithmic, .from = 100.0, .to = 50000.0};
  std::size_t next = 0;
  for (const int delay : found.plan.delays_ticks) {
    Series series = measuredSeries(fmt::format("rule, {} ms", delay), {}, {}, kMarkers[next++ % std::size(kMarkers)]);
    for (const PunctureRow& row : found.recommended) {
      if (row.delay_ticks != delay) continue;
      series.x.push_back(metresPerSecond(row.speed_mm_s));
      series.y.push_back(row.triangles);
    }
    plot.series.push_back(series);
  }
  const HdbSizeRow& quarter = quarterRow(found);
  const std::vector<double> ends{metresPerSecond(found.plan.speeds_mm_s.front()),
                                 metresPerSecond(found.plan.speeds_mm_s.back())};
  const auto level = [&](const std::string& name, double triangles) {
    Series series = printedSeries(name, ends, {triangles, triangles}, Marker::none);
    plot.series.push_back(series);
  };
  level("1/4, leaves of the BSP tree", quarter.bsp_triangles);
  level("1/4, triangles of the box", quarter.exact_triangles);
  return plot;
}

std::vector<StudyFigure> figuresOf(const HdbMeasurement& found) {
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
          {"hdb_rule", "What the rule in place of 1/4 renders, against 1/4 itself.",
           Figure{.panels = {recommendedPlot(found)}}}};
}

// ----------------------------------------------------------------------------------------------------------- tables

TextTable sizeTable(const HdbMeasurement& found) {
  TextTable table{
      {"edge / model", "edge (mm)", "BSP leaves", "octree leaves", "box", "BSP (us)", "octree (us)", "our list (us)"},
      {}};
  for (const HdbSizeRow& row : found.sizes) {
    table.rows.push_back({fractionTicksAt({row.share}).front().text, rounded(row.edge_mm, 3),
                          counted(row.bsp_triangles), counted(row.octree_triangles), counted(row.exact_triangles),
                          rounded(row.bsp_us), rounded(row.octree_us), rounded(row.exact_us)});
  }
  return table;
}

TextTable punctureTable(const std::vector<PunctureRow>& rows) {
  TextTable table{
      {"speed (m/s)", "delay (ms)", "edge (mm)", "half edge / way", "found by", "triangles", "punctured (%)"}, {}};
  for (const PunctureRow& row : rows) {
    table.rows.push_back({rounded(metresPerSecond(row.speed_mm_s)), counted(row.delay_ticks), rounded(row.edge_mm, 3),
                          rounded(row.lead()), row.leaves ? "leaves" : "box", counted(row.triangles),
                          rounded(100.0 * row.punctured, 3)});
  }
  return table;
}

TextTable ruleTable(const HdbMeasurement& found) {
  TextTable table{{"speed (m/s)", "delay (ms)", "edge (mm)", "triangles", "of 1/4 with BSP leaves", "punctured (%)"},
                  {}};
  for (const PunctureRow& row : found.recommended) {
    table.rows.push_back({rounded(metresPerSecond(row.speed_mm_s)), counted(row.delay_ticks), rounded(row.edge_mm, 3),
                          counted(row.triangles), percent(row.triangles / quarterRow(found).bsp_triangles),
                          rounded(100.0 * row.punctured, 3)});
  }
  return table;
}

std::vector<StudyTable> tablesOf(const HdbMeasurement& found) {
  std::vector<PunctureRow> all = found.punctures;
  all.insert(all.end(), found.leaf_punctures.begin(), found.leaf_punctures.end());
  all.insert(all.end(), found.leads.begin(), found.leads.end());
  return {{"hdb_rule_table", "The rule, on strokes that no other part of this study used.", ruleTable(found)},
          {"hdb_size_table", "Size of the box: triangles rendered, and time of a frame, touched, without drawing.",
           sizeTable(found)},
          {"hdb_punctures_table", "Every run of strokes.", punctureTable(all), false}};
}

// --------------------------------------------------------------------------------------------------------- findings

/// The printed times of a touched frame with a BSP tree, s.
struct PrintedDelays {
  double shortest = 0.0;
  double longest = 0.0;
};

PrintedDelays printedDelays() {
  const auto rows = printedNumbers().table_3_2.touched;
  return {1e-3 * parsePrinted(rows.front().ms).value, 1e-3 * parsePrinted(rows.back().ms).value};
}

double mostPunctured(const std::vector<PunctureRow>& rows, double from_lead, double to_lead) {
  double most = 0.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() >= from_lead && row.lead() <= to_lead) most = std::max(most, row.punctured);
  }
  return most;
}

double leastPunctured(const std::vector<PunctureRow>& rows, double to_lead) {
  double least = 1.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() <= to_lead) least = std::min(least, row.punctured);
  }
  return least;
}

const PunctureRow& rowAt(const std::vector<PunctureRow>& rows, double speed, int delay) {
  return *std::min_element(rows.begin(), rows.end(), [&](const PunctureRow& a, const PunctureRow& b) {
    const auto distance = [&](const PunctureRow& row) {
      return std::abs(row.speed_mm_s - speed) + 1e3 * std::abs(row.delay_ticks - delay);
    };
    return distance(a) < distance(b);
  });
}

std::string strokesOf(double share) {
  if (share == 0.0) return "none of the strokes";
  return share == 1.0 ? "all strokes" : percent(share) + " of the strokes";
}

std::string atLeast(double share) { return share == 1.0 ? strokesOf(share) : "at least " + strokesOf(share); }

std::string ruleFinding(const HdbMeasurement& found) {
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  return fmt::format(
      "What replaces the guess: **edge = 2 (speed x delay + depth + longest triangle edge)**, with the speed of the "
      "finger now, the longest time until the box follows, and the depth that is allowed. On {} strokes of each speed "
      "and delay that were not used before, {} got through. For {} m/s and {} ms the box is {} mm wide and holds {} "
      "triangles, {} of what the leaves of a BSP tree render for 1/4.",
      found.plan.strokes, strokesOf(mostPunctured(found.recommended, 0.0, 1e9)),
      rounded(metresPerSecond(usual.speed_mm_s)), usual.delay_ticks, rounded(usual.edge_mm), counted(usual.triangles),
      percent(usual.triangles / quarterRow(found).bsp_triangles));
}

std::string leadFinding(const HdbMeasurement& found) {
  return fmt::format(
      "One number decides: half the edge over the way that the finger makes until the box follows. Up to 0.5, {} get "
      "through; from 1.25 on {} at most, whatever the speed and the delay. That it is not exactly 1 comes from the "
      "proxy: where the body curves outwards it is faster than the tip below it, and behind a ridge it snaps forward. "
      "Both are ways of about the depth, hence that term.",
      atLeast(leastPunctured(found.leads, 0.5)), strokesOf(mostPunctured(found.leads, 1.25, 1e9)));
}

std::string quarterFinding(const HdbMeasurement& found) {
  const PrintedDelays printed = printedDelays();
  const auto safe = [&](double share, double delay) {
    return rounded(metresPerSecond(safeSpeed(share * found.longest_edge, delay, found.depth_mm, found.triangle_edge)));
  };
  return fmt::format(
      "Is 1/4 right? For the computer of 2008 it was: its touched frames took {} to {} ms (Table 3.2), and by the rule "
      "a quarter of this model, {} mm, is then safe up to {} and {} m/s, while 1/10 is safe up to {} and {} m/s only - "
      "\"the proxy might get through the model surface frequently\". It is no property of the model: with a collision "
      "thread of 100 Hz, 1/4 is safe up to {} m/s, more than any finger needs, and on a model twice as long 1/4 would "
      "be twice as wide for nothing.",
      rounded(1e3 * printed.shortest, 3), rounded(1e3 * printed.longest, 3), rounded(kQuarter * found.longest_edge, 3),
      safe(kQuarter, printed.shortest), safe(kQuarter, printed.longest), safe(kTenth, printed.shortest),
      safe(kTenth, printed.longest), safe(kQuarter, 0.01));
}

std::string costFinding(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const auto all = static_cast<double>(found.plan.triangles);
  return fmt::format(
      "What 1/4 costs on {} triangles: the box meets {} of them on average ({}), the leaves that it meets hold {} "
      "(BSP, {}) and {} (octree, {}); the text says a third in one place and a tenth in another. A frame that tests "
      "them all takes {} us (BSP) and {} us (octree) here, our exact list {} us, and the default finger, which needs "
      "no box, {} us.",
      counted(all), counted(quarter.exact_triangles), percent(quarter.exact_triangles / all),
      counted(quarter.bsp_triangles), percent(quarter.bsp_triangles / all), counted(quarter.octree_triangles),
      percent(quarter.octree_triangles / all), rounded(quarter.bsp_us), rounded(quarter.octree_us),
      rounded(quarter.exact_us), rounded(found.tick_us));
}

std::string leavesFinding(const HdbMeasurement& found) {
  double hidden = 0.0;  // strokes that only the leaves' overhang saved, in the worst case
  for (std::size_t i = 0; i < found.punctures.size(); ++i) {
    hidden = std::max(hidden, found.punctures[i].punctured - found.leaf_punctures[i].punctured);
  }
  return fmt::format(
      "Leaves hide a small box: they reach beyond it, so that up to {} of the strokes more are held than by the box's "
      "own triangles. This is luck and not a margin, because a leaf may end right behind the box.",
      percent(hidden));
}

std::string elseIfFinding(const HdbMeasurement& found) {
  return fmt::format(
      "The printed traversal, ELSEIF for the second child (E4), lets {} through although the box follows at every "
      "tick, with 1/16, 1/4 and the whole model alike: no size of box mends that.",
      strokesOf(found.else_if_punctured));
}

std::vector<std::string> methodOf(const HdbMeasurement& found) {
  return {
      fmt::format(
          "Model: the benchmark's back with {} triangles, 350 x 400 mm; box shares are of its longest edge, {} mm. "
          "Partitions: case C, threshold 1024.",
          counted(static_cast<double>(found.plan.triangles)), rounded(found.longest_edge, 3)),
      fmt::format("Strokes: {} for each speed, the same ways at every speed. A finger comes down through 20 mm of "
                  "air at up to 45 degree, presses {} mm deep and slides 160 mm in any direction, at one speed "
                  "throughout, at 1 kHz. It sees only the triangles that the box found "
                  "(`src/palpate/contact/hdb_finger.h`); the box is put round the proxy every 10, 20 or 50 ticks. A "
                  "stroke gets through when its tip is under the skin and nothing holds it.",
                  found.plan.strokes, rounded(found.depth_mm)),
      fmt::format("Times: at {} places, tip 5 mm deep, the fastest of {} runs at each. The dissertation's way tests "
                  "every triangle of the leaves against the tip's way and for its nearest point "
                  "(`study/literal_process.h`).",
                  found.plan.places, found.plan.runs)};
}

std::vector<std::pair<std::string, double>> numbersOf(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  return {{"quarter_edge_mm", quarter.edge_mm},
          {"quarter_bsp_triangles", quarter.bsp_triangles},
          {"quarter_octree_triangles", quarter.octree_triangles},
          {"quarter_exact_triangles", quarter.exact_triangles},
          {"quarter_bsp_us", quarter.bsp_us},
          {"quarter_octree_us", quarter.octree_us},
          {"quarter_exact_us", quarter.exact_us},
          {"tick_us", found.tick_us},
          {"least_punctured_up_to_lead_0_5", leastPunctured(found.leads, 0.5)},
          {"most_punctured_from_lead_1_25", mostPunctured(found.leads, 1.25, 1e9)},
          {"rule_most_punctured", mostPunctured(found.recommended, 0.0, 1e9)},
          {"rule_edge_mm_at_0_5_mps_10_ms", usual.edge_mm},
          {"rule_triangles_at_0_5_mps_10_ms", usual.triangles},
          {"rule_share_of_quarter_at_0_5_mps_10_ms", usual.triangles / quarter.bsp_triangles},
          {"else_if_punctured", found.else_if_punctured}};
}

}  // namespace

StudyPage studyHdb(const StudySettings& settings) {
  const HdbMeasurement found = measureHdbSizes(hdbPlan(settings.quick), settings.progress);
  StudyPage page;
  page.title = "The size of the haptic detecting box";
  page.question =
      "The haptic process sees only triangles near the proxy: those that a box around it meets. Too small a box lets a "
      "fast finger through the skin, because the box follows late; too large a box costs time. The dissertation "
      "settles on a quarter of the model \"after several experiments\" (3.3.3). Is that right, and what should replace "
      "the guess (E12)?";
  page.findings = {ruleFinding(found), leadFinding(found),   quarterFinding(found),
                   costFinding(found), leavesFinding(found), elseIfFinding(found)};
  page.method = methodOf(found);
  page.tables = tablesOf(found);
  page.figures = figuresOf(found);
  page.numbers = numbersOf(found);
  return page;
}

}  // namespace palpate::study
