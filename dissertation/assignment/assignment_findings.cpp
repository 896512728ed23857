// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/assignment/assignment_measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lab/measured/haptic_frames.h"

namespace palpate::study {

namespace {

using hdb::Assignment;
using hdb::TreeKind;

// Times vary from run to run; a case is not worse for so much.
constexpr double kAsGoodAsBest = 1.05;
constexpr double kExactArea = 1e-9;
constexpr double kNoOverlap = 1.0 + 1e-9;

/// What a case can be good in: the least is the best.
struct Respect {
  const char* name;
  double AssignmentRow::*value;
};

constexpr Respect kRespects[] = {
    {"entries stored", &AssignmentRow::stored},       {"memory", &AssignmentRow::bytes},
    {"triangles rendered", &AssignmentRow::rendered}, {"building", &AssignmentRow::build_ns},
    {"the frame", &AssignmentRow::frame_us},          {"our list", &AssignmentRow::exact_us},
    {"overlap of leaves", &AssignmentRow::overlap}};

/// Of a case's value over C's at the same tree and threshold.
Extent againstMajority(const AssignmentMeasurement& found, Assignment assignment, double AssignmentRow::*value) {
  Extent extent;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment != assignment) continue;
    extent.add(row.*value / (rowOf(found, row.tree, Assignment::Majority, row.threshold).*value));
  }
  return extent;
}

std::string times(const Extent& extent) {
  return fmt::format("{} to {} times", rounded(extent.least), rounded(extent.most));
}

/// True when neither A nor B is better than C in this at any threshold of either tree.
bool isBestIn(const AssignmentMeasurement& found, const Respect& respect) {
  return againstMajority(found, Assignment::Cut, respect.value).least * kAsGoodAsBest >= 1.0 &&
         againstMajority(found, Assignment::BothSides, respect.value).least * kAsGoodAsBest >= 1.0;
}

std::string bestFinding(const AssignmentMeasurement& found) {
  std::vector<std::string> best;
  std::vector<std::string> not_best;
  for (const Respect& respect : kRespects) (isBestIn(found, respect) ? best : not_best).emplace_back(respect.name);
  const std::string where = best.empty() ? "is the best throughout in nothing"
                            : not_best.empty()
                                ? "is the best in every respect measured"
                                : fmt::format("is the best at every threshold of both trees in {}; not in {}",
                                              fmt::join(best, ", "), fmt::join(not_best, ", "));
  return fmt::format(
      "Case C, the dissertation's choice, {}. A stores a triangle up to {} times and renders {} what C renders, B up "
      "to "
      "{} times and {}. Frames follow: A takes {} and B {} as long as C, over all thresholds and both trees.",
      where, rounded(againstMajority(found, Assignment::Cut, &AssignmentRow::stored).most),
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::rendered)),
      rounded(againstMajority(found, Assignment::BothSides, &AssignmentRow::stored).most),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::rendered)),
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::frame_us)),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::frame_us)));
}

std::string overlapFinding(const AssignmentMeasurement& found) {
  const Index small = found.plan.thresholds.front();
  const AssignmentRow& a = rowOf(found, TreeKind::Octree, Assignment::Cut, small);
  const AssignmentRow& b = rowOf(found, TreeKind::Octree, Assignment::BothSides, small);
  const AssignmentRow& c = rowOf(found, TreeKind::Octree, Assignment::Majority, small);
  double overlap_of_a = 0.0;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment == Assignment::Cut) overlap_of_a = std::max(overlap_of_a, row.overlap);
  }
  const double frame = a.frame_us / c.frame_us;
  return fmt::format(
      "Leaves of A {}; those of C have {} leaf boxes round a point of the skin at threshold {} (octree; B has {}), "
      "because "
      "triangles stick out. {}: there a frame of A takes {} times as long as one of C.",
      overlap_of_a <= kNoOverlap
          ? "do not overlap at all"
          : fmt::format("overlap by up to {} leaf boxes round a point", rounded(overlap_of_a, 3)),
      rounded(c.overlap, 3), small, rounded(b.overlap, 3),
      frame > 1.0 ? "With tight boxes that costs less than what A stores more"
                  : "That costs more than what A stores more",
      rounded(frame));
}

std::string smallLeavesFinding(const AssignmentMeasurement& found) {
  const Index small = found.plan.thresholds.front();
  std::vector<std::string> changes;
  std::vector<std::string> paying;
  for (const auto& [assignment, name] :
       {std::pair{Assignment::Majority, "C"}, std::pair{Assignment::BothSides, "B"}, std::pair{Assignment::Cut, "A"}}) {
    const double change = rowOf(found, TreeKind::Octree, assignment, small).rendered /
                          rowOf(found, TreeKind::Octree, assignment, kPrintedThreshold).rendered;
    changes.push_back(fmt::format("{} with {}", rounded(change), name));
    if (change < 1.0) paying.emplace_back(name);
  }
  const std::string verdict = paying.empty()       ? "Small leaves pay with no case"
                              : paying.size() == 1 ? "Small leaves pay with " + paying.front() + " only"
                              : paying.size() == 3 ? "Small leaves pay with every case"
                                                   : "Small leaves pay with " + paying[0] + " and " + paying[1];
  return fmt::format(
      "{}: from a threshold of {} down to {} the triangles rendered (octree) change by a factor of {}. Every plane "
      "more "
      "is one where A cuts and B copies triangles.",
      verdict, kPrintedThreshold, small, fmt::join(changes, ", "));
}

/// The most that the printed searches by half-spaces or by the box of the node's space miss with C.
double missedByNodeBox(const AssignmentMeasurement& found) {
  double most = 0.0;
  for (const AssignmentRow& row : found.rows) {
    if (row.assignment == Assignment::Majority) most = std::max({most, row.missed_cell_box, row.missed_half_space});
  }
  return most;
}

std::string missFinding(const AssignmentMeasurement& found) {
  const double lost = *std::max_element(found.lost_two_of_three.begin(), found.lost_two_of_three.end());
  const double ours = worst(found, &AssignmentRow::missed);
  return fmt::format(
      "Our search misses {} of the box's triangles, judged by brute force, with every case, tree and threshold. The "
      "printed forms: ELSEIF up to {} (E4); the half-space, or the box of the node's space, up to {} with C, whose "
      "triangles stick out of it (E5); the octree's two-of-three rule loses up to {} of the model before any search "
      "(E6).",
      ours == 0.0 ? "none" : "up to " + percent(ours), percent(worst(found, &AssignmentRow::missed_else_if)),
      percent(missedByNodeBox(found)), percent(lost));
}

std::string buildFinding(const AssignmentMeasurement& found) {
  const AssignmentRow& c = rowOf(found, TreeKind::Octree, Assignment::Majority, kPrintedThreshold);
  return fmt::format(
      "Building takes {} ns and {} bytes a triangle with C (octree, {}); A takes {} the time, B {}. {}: the pieces' "
      "area "
      "differs from the model's by {:.1g} of it.",
      rounded(c.build_ns), rounded(c.bytes), kPrintedThreshold,
      times(againstMajority(found, Assignment::Cut, &AssignmentRow::build_ns)),
      times(againstMajority(found, Assignment::BothSides, &AssignmentRow::build_ns)),
      found.cut_area_error < kExactArea ? "Cutting is exact to rounding" : "Cutting is NOT exact",
      found.cut_area_error);
}

}  // namespace

const AssignmentRow& rowOf(const AssignmentMeasurement& found, TreeKind tree, Assignment assignment, Index threshold) {
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
  return {bestFinding(found), smallLeavesFinding(found), missFinding(found), overlapFinding(found),
          buildFinding(found)};
}

}  // namespace palpate::study
