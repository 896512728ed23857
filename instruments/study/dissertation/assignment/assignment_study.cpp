// The study of cases A, B and C: plots, tables and findings out of one measurement.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>

#include "dissertation/assignment/assignment_measurement.h"
#include "lab/measured/haptic_frames.h"
#include "palpate/scene/words.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using hdb::Assignment;
using hdb::TreeKind;

constexpr Marker kAssignmentMarkers[] = {Marker::circle, Marker::square, Marker::triangle};

const char* nameOf(Assignment assignment) {
  switch (assignment) {
    case Assignment::Cut:
      return "A: cut";
    case Assignment::BothSides:
      return "B: both sides";
    case Assignment::Majority:
      return "C: majority";
  }
  return "";
}

// ------------------------------------------------------------------------------------------------------------ plots

Plot casesPlot(const AssignmentMeasurement& found, TreeKind tree, const std::string& title, figures::Axis y,
               double AssignmentRow::*value) {
  Plot plot{.title = title};
  plot.x = thresholdAxis(found.plan.thresholds, {64, 256, 1024, 4096});
  plot.y = std::move(y);
  for (std::size_t i = 0; i < kAssignments.size(); ++i) {
    const auto rows = rowsOf(found, tree, kAssignments[i]);
    plot.series.push_back(measuredSeries(nameOf(kAssignments[i]), column(rows, &AssignmentRow::threshold),
                                         column(rows, value), kAssignmentMarkers[i]));
  }
  return plot;
}

Figure casesFigure(const AssignmentMeasurement& found, TreeKind tree) {
  const figures::Axis share{.label = "entries a triangle", .from = 0.0};
  const figures::Axis boxes{.label = "leaf boxes round a point", .from = 0.0};
  const figures::Axis triangles{.label = "triangles", .from = 0.0};
  const figures::Axis build{.label = "time", .unit = "ns a triangle", .scale = Scale::logarithmic};
  const figures::Axis frame{.label = "time", .unit = "us", .from = 0.0};
  const figures::Axis list{.label = "time", .unit = "us", .from = 0.0};
  Figure figure{.title = fmt::format("Cases A, B, C: {}", titleOf(tree)), .columns = 3};
  figure.panel_width_px = 360.0;
  figure.panel_height_px = 320.0;
  figure.panels = {casesPlot(found, tree, "How often a triangle is stored", share, &AssignmentRow::stored),
                   casesPlot(found, tree, "Overlap of the leaves", boxes, &AssignmentRow::overlap),
                   casesPlot(found, tree, "Rendered for a box of 1/4", triangles, &AssignmentRow::rendered),
                   casesPlot(found, tree, "Building", build, &AssignmentRow::build_ns),
                   casesPlot(found, tree, "Touched frame, dissertation's way", frame, &AssignmentRow::frame_us),
                   casesPlot(found, tree, "Our list of the box's triangles", list, &AssignmentRow::exact_us)};
  return figure;
}

Series missSeries(const std::string& name, const std::vector<AssignmentRow>& rows, double AssignmentRow::*value,
                  Marker marker) {
  Series series = measuredSeries(name, column(rows, &AssignmentRow::threshold), column(rows, value), marker);
  for (double& y : series.y) y *= 100.0;
  return series;
}

Plot missPlot(const AssignmentMeasurement& found) {
  Plot plot{.title = "Case C, searched as printed"};
  plot.x = thresholdAxis(found.plan.thresholds, {64, 256, 1024, 4096});
  plot.y = {
      .label = "missed of the box's triangles", .unit = "%", .scale = Scale::logarithmic, .from = 0.01, .to = 100.0};
  const auto bsp = rowsOf(found, TreeKind::Bsp, Assignment::Majority);
  const auto octree = rowsOf(found, TreeKind::Octree, Assignment::Majority);
  Series lost = measuredSeries("octree: two of three vertices (E6), of the model",
                               column(octree, &AssignmentRow::threshold), found.lost_two_of_three, Marker::diamond);
  for (double& y : lost.y) y *= 100.0;
  plot.series = {
      missSeries("BSP: ELSEIF (E4)", bsp, &AssignmentRow::missed_else_if, Marker::circle),
      missSeries("BSP: half-space (E5, E10)", bsp, &AssignmentRow::missed_half_space, Marker::square),
      missSeries("octree: box of the node's space (E5)", octree, &AssignmentRow::missed_cell_box, Marker::triangle),
      lost};
  plot.shapes = {verticalLine("1024, the dissertation's", kPrintedThreshold, 0.01, 100.0)};
  return plot;
}

std::vector<StudyFigure> makeFigures(const AssignmentMeasurement& found) {
  Figure misses{.panels = {missPlot(found)}, .panel_width_px = 620.0};
  misses.note =
      "Ours, the tight box of each node's triangles, misses none in any of the runs, which this axis cannot show.";
  return {
      {"assignment_bsp", "Cases A, B and C with a BSP tree, over the threshold.", casesFigure(found, TreeKind::Bsp)},
      {"assignment_octree", "Cases A, B and C with an octree, over the threshold.",
       casesFigure(found, TreeKind::Octree)},
      {"assignment_missed", "Triangles that the box meets and that the printed forms of search and tree do not find.",
       misses}};
}

// ----------------------------------------------------------------------------------------------------------- tables

TextTable rowTable(const std::vector<AssignmentRow>& rows) {
  TextTable table{
      {"tree", "case", "threshold", "leaves", "stored", "overlap", "bytes a triangle", "build (ns a triangle)",
       "rendered", "in the box", "frame (us)", "our list (us)", "missed, ours (%)", "missed, node's box (%)"},
      {}};
  for (const AssignmentRow& row : rows) {
    table.rows.push_back({titleOf(row.tree), nameOf(row.assignment), fmt::format("{}", row.threshold),
                          counted(static_cast<double>(row.leaves)), rounded(row.stored, 3), rounded(row.overlap, 3),
                          rounded(row.bytes, 3), rounded(row.build_ns), counted(row.rendered), counted(row.wanted),
                          rounded(row.frame_us), rounded(row.exact_us), rounded(100.0 * row.missed),
                          rounded(100.0 * row.missed_cell_box)});
  }
  return table;
}

std::vector<AssignmentRow> printedRows(const AssignmentMeasurement& found) {
  std::vector<AssignmentRow> rows;
  std::copy_if(found.rows.begin(), found.rows.end(), std::back_inserter(rows),
               [](const AssignmentRow& row) { return row.threshold == kPrintedThreshold; });
  return rows;
}

std::vector<std::string> describeMethod(const AssignmentPlan& plan) {
  return {fmt::format("Model: the benchmark's back with {} triangles. The box is a cube of a quarter of the longest "
                      "edge round {} places of the skin, the tip 5 mm deep; means of the places, at each the fastest "
                      "of {} runs. A triangle is missed when its box meets the detecting box (brute force over the "
                      "mesh) and no leaf found holds it.",
                      counted(static_cast<double>(plan.triangles)), plan.places, plan.runs),
          "The frame finds the leaves by tight boxes and tests every entry of them as a whole triangle "
          "(`instruments/study/lab/measured/literal_process.h`), without drawing. Overlap is the mean number of leaf "
          "boxes round the middle of an entry."};
}

std::vector<std::pair<std::string, double>> numbersOf(const AssignmentMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers;
  constexpr const char* kNames[] = {"a", "b", "c"};
  for (const TreeKind tree : kTrees) {
    for (std::size_t i = 0; i < kAssignments.size(); ++i) {
      const AssignmentRow& row = findAssignmentRow(found, tree, kAssignments[i], kPrintedThreshold);
      const std::string stem = fmt::format("{}_{}_1024_", wordFor(tree), kNames[i]);
      numbers.emplace_back(stem + "stored", row.stored);
      numbers.emplace_back(stem + "overlap", row.overlap);
      numbers.emplace_back(stem + "rendered", row.rendered);
      numbers.emplace_back(stem + "build_ns", row.build_ns);
      numbers.emplace_back(stem + "frame_us", row.frame_us);
      numbers.emplace_back(stem + "list_us", row.exact_us);
    }
  }
  numbers.emplace_back("most_missed_ours", worst(found, &AssignmentRow::missed));
  numbers.emplace_back("most_missed_else_if", worst(found, &AssignmentRow::missed_else_if));
  numbers.emplace_back("most_missed_node_box", worst(found, &AssignmentRow::missed_cell_box));
  numbers.emplace_back("cut_area_error", found.cut_area_error);
  return numbers;
}

}  // namespace

StudyPage studyAssignment(const StudySettings& settings) {
  const AssignmentMeasurement found = measureAssignments(assignmentPlan(settings.quick), settings.progress);
  return {
      .title = "Triangles that a splitting plane crosses",
      .question =
          "A plane of the partition crosses triangles. Case A cuts them, case B gives them to both sides, case C to "
          "the side of two of their vertices; the dissertation takes C as \"the most efficient for rendering\" "
          "(3.3.2). How many triangles does each store and render, how far do leaves overlap, what is missed, and what "
          "does it cost?",
      .findings = assignmentFindings(found),
      .method = describeMethod(found.plan),
      .tables = {{"assignment_1024_table", "At the dissertation's threshold of 1024.", rowTable(printedRows(found))},
                 {"assignment_table", "Every threshold.", rowTable(found.rows), false}},
      .figures = makeFigures(found),
      .numbers = numbersOf(found)};
}

}  // namespace palpate::study
