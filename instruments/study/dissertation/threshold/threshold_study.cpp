// The study of the threshold: the fastest one of each model and tree, and the loss of the printed 1024 against it.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>

#include "dissertation/threshold/threshold_measurement.h"
#include "lab/measured/haptic_frames.h"
#include "palpate/scene/words.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

constexpr Marker kThresholdMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond,
                                        Marker::cross};
// Times this near to the fastest are as good.
constexpr double kAsGood = 1.10;

// ------------------------------------------------------------------------------------------------------------ plots

Plot timePlot(const ThresholdMeasurement& found, TreeKind tree) {
  Plot plot{.title = fmt::format("Dissertation's way, {}", titleOf(tree))};
  plot.x = thresholdAxis(found.plan.thresholds, {16, 64, 256, 1024, 4096, 16384});
  plot.x.from = std::min(16.0, *plot.x.from);
  plot.y = {.label = "time of a touched frame", .unit = "us", .scale = Scale::logarithmic, .from = 4.0, .to = 10000.0};
  Series best = measuredSeries("fastest", {}, {}, Marker::circle);
  std::size_t next = 0;
  for (const std::size_t size : found.plan.sizes) {
    const auto rows = rowsOf(found, size, tree);
    plot.series.push_back(measuredSeries(counted(static_cast<double>(size)), column(rows, &ThresholdRow::threshold),
                                         column(rows, &ThresholdRow::touched_us), kThresholdMarkers[next++ % 5]));
    best.x.push_back(fastest(rows).threshold);
    best.y.push_back(fastest(rows).touched_us);
  }
  best.stroke = figures::Stroke::none;
  best.colour = figures::kInk;
  plot.series.push_back(best);
  plot.shapes = {verticalLine("1024, printed", kPrintedThreshold, 4.0, 10000.0)};
  return plot;
}

Plot bestPlot(const ThresholdMeasurement& found) {
  Plot plot{.title = "Fastest threshold"};
  plot.x = {.label = "triangles of the model", .scale = Scale::logarithmic, .from = 2000.0, .to = 2e6};
  plot.y = {.label = "threshold", .scale = Scale::logarithmic, .from = 4.0, .to = 4096.0};
  plot.y.ticks = ticksAt({4, 16, 64, 256, 1024, 4096});
  std::vector<double> sizes;
  for (const std::size_t size : found.plan.sizes) sizes.push_back(static_cast<double>(size));
  for (const TreeKind tree : kTrees) {
    std::vector<double> best;
    for (const std::size_t size : found.plan.sizes) best.push_back(fastest(rowsOf(found, size, tree)).threshold);
    plot.series.push_back(
        measuredSeries(titleOf(tree), sizes, best, tree == TreeKind::Bsp ? Marker::circle : Marker::square));
  }
  plot.series.push_back(
      dissertationSeries("printed: 1024", sizes, std::vector<double>(sizes.size(), kPrintedThreshold), Marker::none));
  plot.series.back().colour = figures::kInk;
  return plot;
}

Plot ownPlot(const ThresholdMeasurement& found) {
  Plot plot{.title = "Ours: list of the box's triangles, octree"};
  plot.x = thresholdAxis(found.plan.thresholds, {16, 64, 256, 1024, 4096, 16384});
  plot.y = {.label = "time", .unit = "us", .scale = Scale::logarithmic, .from = 0.1, .to = 1000.0};
  std::size_t next = 0;
  for (const std::size_t size : found.plan.sizes) {
    const auto rows = rowsOf(found, size, TreeKind::Octree);
    plot.series.push_back(measuredSeries(counted(static_cast<double>(size)), column(rows, &ThresholdRow::threshold),
                                         column(rows, &ThresholdRow::exact_us), kThresholdMarkers[next++ % 5]));
  }
  return plot;
}

std::vector<StudyFigure> makeFigures(const ThresholdMeasurement& found) {
  return {
      {"threshold_time",
       "A frame that tests every triangle of the leaves, for models of five sizes; the box is a quarter of the model.",
       Figure{.panels = {timePlot(found, TreeKind::Bsp), timePlot(found, TreeKind::Octree)}, .columns = 2}},
      {"threshold_best",
       "Left: the threshold that makes the dissertation's way fastest. Right: our list of the triangles that the box "
       "meets does not care.",
       Figure{.panels = {bestPlot(found), ownPlot(found)}, .columns = 2}}};
}

// ----------------------------------------------------------------------------------------------------------- tables

std::string asGood(const std::vector<ThresholdRow>& rows) {
  Index least = rows.back().threshold;
  Index most = rows.front().threshold;
  for (const ThresholdRow& row : rows) {
    if (row.touched_us > kAsGood * fastest(rows).touched_us) continue;
    least = std::min(least, row.threshold);
    most = std::max(most, row.threshold);
  }
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

TextTable bestTable(const ThresholdMeasurement& found) {
  TextTable table{
      {"model", "tree", "fastest", "within 10 %", "time (us)", "time at 1024 (us)", "1024 costs", "leaves at 1024",
       "triangles at fastest", "triangles at 1024", "in the box", "our list (us)", "our tick (us)"},
      {}};
  for (std::size_t i = 0; i < found.plan.sizes.size(); ++i) {
    for (const TreeKind tree : kTrees) {
      const auto rows = rowsOf(found, found.plan.sizes[i], tree);
      const ThresholdRow best = fastest(rows);
      const ThresholdRow printed = rowAt(rows, kPrintedThreshold);
      table.rows.push_back({counted(static_cast<double>(best.model)), titleOf(tree), fmt::format("{}", best.threshold),
                            asGood(rows), rounded(best.touched_us), rounded(printed.touched_us),
                            "x " + rounded(lossAtPrinted(rows)), counted(static_cast<double>(printed.leaves)),
                            counted(best.rendered), counted(printed.rendered), counted(found.exact_triangles[i]),
                            rounded(printed.exact_us), rounded(found.tick_us[i])});
    }
  }
  return table;
}

TextTable allTable(const ThresholdMeasurement& found) {
  TextTable table{{"model", "tree", "threshold", "leaves", "height", "triangles", "find leaves (us)", "frame (us)",
                   "our list (us)"},
                  {}};
  for (const ThresholdRow& row : found.rows) {
    table.rows.push_back({fmt::format("{}", row.model), titleOf(row.tree), fmt::format("{}", row.threshold),
                          fmt::format("{}", row.leaves), fmt::format("{}", row.height),
                          fmt::format("{:.0f}", row.rendered), fmt::format("{:.3f}", row.find_us),
                          fmt::format("{:.2f}", row.touched_us), fmt::format("{:.2f}", row.exact_us)});
  }
  return table;
}

std::vector<std::string> describeMethod(const ThresholdPlan& plan) {
  return {
      fmt::format(
          "Models: the benchmark's back. Case C; the box is a cube of a quarter of the longest edge round {} places of "
          "the skin, the tip 5 mm deep; at each place the fastest of {} runs counts, and the mean of the places is "
          "shown. Points of the largest model wait for memory and vary with what else the machine does.",
          plan.places, plan.runs),
      "The dissertation's way: find the leaves by their tight boxes, test every triangle of them against the tip's way "
      "and for its nearest point (`instruments/study/lab/measured/literal_process.h`), without drawing. Ours: the "
      "triangles whose own boxes meet the detecting box, written out one by one; and the default finger on strokes at "
      "0.2 m/s."};
}

std::vector<std::pair<std::string, double>> numbersOf(const ThresholdMeasurement& found) {
  const Extent loss = lossesAtPrinted(found);
  std::vector<std::pair<std::string, double>> numbers{{"least_cost_of_1024", loss.least},
                                                      {"most_cost_of_1024", loss.most}};
  for (const std::size_t size : found.plan.sizes) {
    for (const TreeKind tree : kTrees) {
      numbers.emplace_back(fmt::format("fastest_threshold_{}_{}", wordFor(tree), size),
                           fastest(rowsOf(found, size, tree)).threshold);
    }
  }
  return numbers;
}

}  // namespace

StudyPage studyThreshold(const StudySettings& settings) {
  const ThresholdMeasurement found = measureThresholds(thresholdPlan(settings.quick), settings.progress);
  return {.title = "The threshold of the partition",
          .question =
              "A node of the partition with at most t triangles is a leaf. \"Smaller t leads to larger tree height and "
              "traversing the tree becomes more complex. Larger t causes less partition benefits. Finally, 1024 was "
              "proved as the best value\" (3.3.1). Is it, and for which size of model?",
          .findings = thresholdFindings(found),
          .method = describeMethod(found.plan),
          .tables = {{"threshold_best_table", "The fastest threshold of every model.", bestTable(found)},
                     {"threshold_table", "Every threshold.", allTable(found), false}},
          .figures = makeFigures(found),
          .numbers = numbersOf(found)};
}

}  // namespace palpate::study
