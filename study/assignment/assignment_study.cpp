// The study of cases A, B and C: plots, tables and findings out of one measurement.
#include "study/studies.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/scene/words.h"
#include "study/assignment/assignment_measurement.h"
#include "study/measured/haptic_frames.h"
#include "study/page/plot_parts.h"

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

std::vector<StudyFigure> figuresOf(const AssignmentMeasurement& found) {
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

// --------------------------------------------------------------------------------------------------------- findings

const AssignmentRow& at(const AssignmentMeasurement& found, TreeKind tree, Assignment assignment, Index threshold) {
  return *std::find_if(found.rows.begin(), found.rows.end(), [&](const AssignmentRow& row) {
    return row.tree == tree && row.assignment == assignment && row.threshold == threshold;
  });
}

/// Of a case's value over C's at the same tree and threshold.
Extent againstMajority(const AssignmentMeasurement& found, Assignment assignment, double AssignmentRow::*value) {
  Extent extent;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment != assignment) continue;
    extent.add(row.*value / (at(found, row.tree, Assignment::Majority, row.threshold).*value));
  }
  return extent;
}

std::string times(const Extent& extent) {
  return fmt::format("{} to {} times", rounded(extent.least), rounded(extent.most));
}

std::string bestFinding(const AssignmentMeasurement& found) {
  return fmt::format(
      "Case C, the dissertation's choice, is the best in every respect but one. A stores a triangle up to {} times and "
      "renders {} what C renders, B up to {} times and {}. Frames follow: A takes {} and B {} as long as C, over all "
      "thresholds and both trees.",
      rounded(againstMajority(found, Assignment::Cut, &AssignmentRow::stored).most),
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::rendered)),
      rounded(againstMajority(found, Assignment::BothSides, &AssignmentRow::stored).most),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::rendered)),
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::frame_us)),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::frame_us)));
}

std::string overlapFinding(const AssignmentMeasurement& found) {
  const AssignmentRow& c = at(found, TreeKind::Octree, Assignment::Majority, found.plan.thresholds.front());
  const AssignmentRow& b = at(found, TreeKind::Octree, Assignment::BothSides, found.plan.thresholds.front());
  return fmt::format(
      "The one: leaves of A do not overlap at all, those of C do where triangles stick out, {} leaf boxes round a "
      "point of the skin at threshold {} (octree; B has {}). With tight boxes that costs less than what A stores more.",
      rounded(c.overlap, 3), c.threshold, rounded(b.overlap, 3));
}

std::string smallLeavesFinding(const AssignmentMeasurement& found) {
  const Index small = found.plan.thresholds.front();
  const auto change = [&](Assignment assignment) {
    return at(found, TreeKind::Octree, assignment, small).rendered /
           at(found, TreeKind::Octree, assignment, kPrintedThreshold).rendered;
  };
  return fmt::format(
      "Small leaves pay with C only: from a threshold of {} down to {} the triangles rendered (octree) change by a "
      "factor of {} with C, {} with B and {} with A, because every plane cuts or copies more of them.",
      kPrintedThreshold, small, rounded(change(Assignment::Majority)), rounded(change(Assignment::BothSides)),
      rounded(change(Assignment::Cut)));
}

double worst(const AssignmentMeasurement& found, double AssignmentRow::*value) {
  double most = 0.0;
  for (const AssignmentRow& row : found.rows) most = std::max(most, row.*value);
  return most;
}

std::string missFinding(const AssignmentMeasurement& found) {
  const double lost = *std::max_element(found.lost_two_of_three.begin(), found.lost_two_of_three.end());
  return fmt::format(
      "Our search misses {} of the box's triangles, judged by brute force, with every case, tree and threshold. The "
      "printed forms: ELSEIF up to {} (E4); the half-space, or the box of the node's space, up to {} with C, whose "
      "triangles stick out of it (E5); the octree's two-of-three rule loses up to {} of the model before any search "
      "(E6).",
      worst(found, &AssignmentRow::missed) == 0.0 ? "none" : percent(worst(found, &AssignmentRow::missed)),
      percent(worst(found, &AssignmentRow::missed_else_if)), percent(worst(found, &AssignmentRow::missed_cell_box)),
      percent(lost));
}

std::string buildFinding(const AssignmentMeasurement& found) {
  const AssignmentRow& c = at(found, TreeKind::Octree, Assignment::Majority, kPrintedThreshold);
  return fmt::format(
      "Building takes {} ns and {} bytes a triangle with C (octree, {}); A takes {} the time, B {}. Cutting is exact "
      "to rounding: the pieces' area differs from the model's by {:.1g} of it.",
      rounded(c.build_ns), rounded(c.bytes), kPrintedThreshold,
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::build_ns)),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::build_ns)), found.cut_area_error);
}

std::vector<std::string> methodOf(const AssignmentPlan& plan) {
  return {fmt::format("Model: the benchmark's back with {} triangles. The box is a cube of a quarter of the longest "
                      "edge round {} places of the skin, the tip 5 mm deep; means of the places, at each the fastest "
                      "of {} runs. A triangle is missed when its box meets the detecting box (brute force over the "
                      "mesh) and no leaf found holds it.",
                      counted(static_cast<double>(plan.triangles)), plan.places, plan.runs),
          "The frame finds the leaves by tight boxes and tests every entry of them as a whole triangle "
          "(`study/measured/literal_process.h`), without drawing. Overlap is the mean number of leaf boxes round the "
          "middle of an entry."};
}

std::vector<std::pair<std::string, double>> numbersOf(const AssignmentMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers;
  constexpr const char* kNames[] = {"a", "b", "c"};
  for (const TreeKind tree : kTrees) {
    for (std::size_t i = 0; i < kAssignments.size(); ++i) {
      const AssignmentRow& row = at(found, tree, kAssignments[i], kPrintedThreshold);
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
      .findings = {bestFinding(found), smallLeavesFinding(found), missFinding(found), overlapFinding(found),
                   buildFinding(found)},
      .method = methodOf(found.plan),
      .tables = {{"assignment_1024_table", "At the dissertation's threshold of 1024.", rowTable(printedRows(found))},
                 {"assignment_table", "Every threshold.", rowTable(found.rows), false}},
      .figures = figuresOf(found),
      .numbers = numbersOf(found)};
}

}  // namespace palpate::study
