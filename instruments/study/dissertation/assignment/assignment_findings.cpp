// Fills in the sentences of assignment_findings.txt and the verdicts that the numbers decide.
#include "dissertation/assignment/assignment_measurement.h"

#include <algorithm>

#include "dissertation_findings_texts.h"
#include "lab/measured/haptic_frames.h"

namespace palpate::study {

namespace {

using hdb::Assignment;
using hdb::TreeKind;

// Times vary from run to run; a case is not worse by this much.
constexpr double kAsGoodAsBest = 1.05;
constexpr double kExactArea = 1e-9;
constexpr double kNoOverlap = 1.0 + 1e-9;

/// A respect in which cases compare: the least is the best.
struct Respect {
  const char* name;
  double AssignmentRow::*value;
};

constexpr Respect kRespects[] = {
    {"entries stored", &AssignmentRow::stored},       {"memory", &AssignmentRow::bytes},
    {"triangles rendered", &AssignmentRow::rendered}, {"building", &AssignmentRow::build_ns},
    {"the frame", &AssignmentRow::frame_us},          {"our list", &AssignmentRow::exact_us},
    {"overlap of leaves", &AssignmentRow::overlap}};

/// A case's value over C's at the same tree and threshold.
Extent againstMajority(const AssignmentMeasurement& found, Assignment assignment, double AssignmentRow::*value) {
  Extent extent;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment != assignment) continue;
    extent.add(row.*value / (findAssignmentRow(found, row.tree, Assignment::Majority, row.threshold).*value));
  }
  return extent;
}

/// True when neither A nor B is better than C in this at any threshold of either tree.
bool isBestIn(const AssignmentMeasurement& found, const Respect& respect) {
  return againstMajority(found, Assignment::Cut, respect.value).least * kAsGoodAsBest >= 1.0 &&
         againstMajority(found, Assignment::BothSides, respect.value).least * kAsGoodAsBest >= 1.0;
}

FindingValues bestCase(const AssignmentMeasurement& found) {
  std::vector<std::string> best;
  std::vector<std::string> not_best;
  for (const Respect& respect : kRespects) (isBestIn(found, respect) ? best : not_best).emplace_back(respect.name);
  return {{"c", best.empty()       ? "nothing"
                : not_best.empty() ? "all"
                                   : "some"},
          {"best", best},
          {"not_best", not_best},
          {"a_stored", againstMajority(found, Assignment::Cut, &AssignmentRow::stored).most},
          {"a_rendered", againstMajority(found, Assignment::Cut, &AssignmentRow::rendered)},
          {"a_frame", againstMajority(found, Assignment::Cut, &AssignmentRow::frame_us)},
          {"b_stored", againstMajority(found, Assignment::BothSides, &AssignmentRow::stored).most},
          {"b_rendered", againstMajority(found, Assignment::BothSides, &AssignmentRow::rendered)},
          {"b_frame", againstMajority(found, Assignment::BothSides, &AssignmentRow::frame_us)}};
}

FindingValues overlapOfLeaves(const AssignmentMeasurement& found) {
  const Index small = found.plan.thresholds.front();
  const AssignmentRow& a = findAssignmentRow(found, TreeKind::Octree, Assignment::Cut, small);
  const AssignmentRow& b = findAssignmentRow(found, TreeKind::Octree, Assignment::BothSides, small);
  const AssignmentRow& c = findAssignmentRow(found, TreeKind::Octree, Assignment::Majority, small);
  double overlap_of_a = 0.0;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment == Assignment::Cut) overlap_of_a = std::max(overlap_of_a, row.overlap);
  }
  const double frame = a.frame_us / c.frame_us;
  return {{"tight", overlap_of_a <= kNoOverlap},
          {"a", overlap_of_a},
          {"b", b.overlap},
          {"c", c.overlap},
          {"threshold", small},
          {"slower", frame > 1.0},
          {"frame", frame}};
}

FindingValues smallLeaves(const AssignmentMeasurement& found) {
  const Index small = found.plan.thresholds.front();
  FindingValues changes = FindingValues::array();
  std::vector<std::string> paying;
  for (const auto& [assignment, name] :
       {std::pair{Assignment::Majority, "C"}, std::pair{Assignment::BothSides, "B"}, std::pair{Assignment::Cut, "A"}}) {
    const double change = findAssignmentRow(found, TreeKind::Octree, assignment, small).rendered /
                          findAssignmentRow(found, TreeKind::Octree, assignment, kPrintedThreshold).rendered;
    changes.push_back({{"factor", change}, {"case", name}});
    if (change < 1.0) paying.emplace_back(name);
  }
  constexpr const char* kHowMany[] = {"none", "one", "two", "all"};
  return {{"paying", kHowMany[paying.size()]},
          {"cases", paying},
          {"from", kPrintedThreshold},
          {"to", small},
          {"changes", changes}};
}

/// The most that the printed searches by half-spaces or by the box of the node's space miss with C.
double missedByNodeBox(const AssignmentMeasurement& found) {
  double most = 0.0;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment == Assignment::Majority) most = std::max({most, row.missed_cell_box, row.missed_half_space});
  }
  return most;
}

FindingValues missedTriangles(const AssignmentMeasurement& found) {
  return {{"ours", worst(found, &AssignmentRow::missed)},
          {"else_if", worst(found, &AssignmentRow::missed_else_if)},
          {"node_box", missedByNodeBox(found)},
          {"two_of_three", *std::max_element(found.lost_two_of_three.begin(), found.lost_two_of_three.end())}};
}

FindingValues buildingOfCases(const AssignmentMeasurement& found) {
  const AssignmentRow& c = findAssignmentRow(found, TreeKind::Octree, Assignment::Majority, kPrintedThreshold);
  return {{"ns", c.build_ns},
          {"bytes", c.bytes},
          {"threshold", kPrintedThreshold},
          {"a", againstMajority(found, Assignment::Cut, &AssignmentRow::build_ns)},
          {"b", againstMajority(found, Assignment::BothSides, &AssignmentRow::build_ns)},
          {"exact", found.cut_area_error < kExactArea},
          {"area_error", found.cut_area_error}};
}

}  // namespace

const AssignmentRow& findAssignmentRow(const AssignmentMeasurement& found, TreeKind tree, Assignment assignment,
                                       Index threshold) {
  return *std::find_if(found.rows.begin(), found.rows.end(), [&](const AssignmentRow& row) {
    return row.tree == tree && row.assignment == assignment && row.threshold == threshold;
  });
}

double worst(const AssignmentMeasurement& found, double AssignmentRow::*value) {
  double most = 0.0;
  for (const AssignmentRow& row : found.rows) most = std::max(most, row.*value);
  return most;
}

std::vector<std::string> assignmentFindings(const AssignmentMeasurement& found) {
  return formatFindings(texts::assignment_findings, {{"best", bestCase(found)},
                                                     {"small_leaves", smallLeaves(found)},
                                                     {"miss", missedTriangles(found)},
                                                     {"overlap", overlapOfLeaves(found)},
                                                     {"build", buildingOfCases(found)}});
}

}  // namespace palpate::study
