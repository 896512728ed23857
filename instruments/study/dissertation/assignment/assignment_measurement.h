// The study of cases A, B and C: where a partition puts the triangles that a plane crosses, and the cost.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "palpate/hdb/partition.h"
#include "report/page/study_page.h"

namespace palpate::study {

struct AssignmentPlan {
  std::size_t triangles = 41582;
  std::vector<Index> thresholds{64, 128, 256, 512, 1024, 2048, 4096};
  int places = 24;
  int runs = 3;
};

AssignmentPlan assignmentPlan(bool quick);

inline constexpr std::array kAssignments{hdb::Assignment::Cut, hdb::Assignment::BothSides, hdb::Assignment::Majority};

/// One tree, case and threshold; means over the places.
struct AssignmentRow {
  hdb::TreeKind tree = hdb::TreeKind::Bsp;
  hdb::Assignment assignment = hdb::Assignment::Majority;
  Index threshold = 0;
  std::size_t leaves = 0;
  double stored = 0.0;    ///< entries a triangle
  double overlap = 0.0;   ///< leaf boxes round a point of the skin; 1: no two overlap
  double bytes = 0.0;     ///< a triangle
  double build_ns = 0.0;  ///< a triangle
  double rendered = 0.0;  ///< entries of the leaves that a box of 1/4 meets
  double wanted = 0.0;    ///< triangles that the box meets
  double frame_us = 0.0;  ///< time of the dissertation's haptic process, touched, without drawing
  double exact_us = 0.0;  ///< our list of the box's triangles
  // Shares of the wanted triangles that are in no leaf found.
  double missed = 0.0;             ///< by our test of tight boxes
  double missed_cell_box = 0.0;    ///< by the box of the node's space (E5)
  double missed_half_space = 0.0;  ///< BSP: by half-spaces, as printed (E5, E10)
  double missed_else_if = 0.0;     ///< BSP: by the printed traversal (E4)
};

struct AssignmentMeasurement {
  AssignmentPlan plan;
  std::vector<AssignmentRow> rows{};        ///< by tree, then case, then threshold
  std::vector<double> lost_two_of_three{};  ///< share of the model, of each threshold: the printed octant rule (E6)
  double cut_area_error = 0.0;  ///< largest relative difference of the pieces' area to the model's, of case A
};

AssignmentMeasurement measureAssignments(const AssignmentPlan& plan, const Progress& progress);

std::vector<AssignmentRow> rowsOf(const AssignmentMeasurement& found, hdb::TreeKind tree, hdb::Assignment assignment);

// Findings from the counts and times of cases A, B and C: sentences made of nothing but the measurement.

/// Paragraphs, most important first. The printed threshold must have been measured.
std::vector<std::string> assignmentFindings(const AssignmentMeasurement& found);

/// The row of that tree, case and threshold, which must have been measured.
const AssignmentRow& findAssignmentRow(const AssignmentMeasurement& found, hdb::TreeKind tree,
                                       hdb::Assignment assignment, Index threshold);

/// The largest of all rows.
double worst(const AssignmentMeasurement& found, double AssignmentRow::*value);

}  // namespace palpate::study
