// For each tree, case and threshold: build, count, time a frame, and see which wanted triangles each search misses.
// Based on: Ji, dissertation 2008, 3.3.2 (cases A, B, C), with E4 to E6 and E10.
#include "dissertation/assignment/assignment_measurement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lab/measured/haptic_frames.h"
#include "lab/measured/stopwatch.h"
#include "lab/runs/partition_statistics.h"
#include "palpate/hdb/literal_octree.h"
#include "palpate/hdb/literal_traversal.h"

namespace palpate::study {

namespace {

using hdb::Assignment;
using hdb::LiteralTraversal;
using hdb::Partition;
using hdb::TreeKind;

Box3 boxAt(const HapticModel& model, const SkinPlace& place) {
  return hdb::hapticBox(place.point, kPrintedBoxShare * model.longest_edge);
}

// By brute force, so that no partition checks itself.
std::vector<Index> trianglesMeeting(const mesh::TriangleMesh& mesh, const Box3& box) {
  std::vector<Index> found;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    Box3 own;
    for (const Index v : mesh.triangles[t]) own.extend(mesh.positions[v]);
    if (own.intersects(box)) found.push_back(t);
  }
  return found;
}

std::vector<std::vector<Index>> wantedAt(const HapticModel& model) {
  std::vector<std::vector<Index>> wanted;
  for (const SkinPlace& place : model.places) wanted.push_back(trianglesMeeting(model.mesh, boxAt(model, place)));
  return wanted;
}

std::size_t countMissing(const Partition& tree, const std::vector<Index>& leaves, const std::vector<Index>& wanted) {
  std::vector<bool> found(tree.triangle_count, false);
  for (const Index leaf : leaves) {
    for (const Index t : hdb::trianglesOf(tree, tree.nodes[leaf])) found[t] = true;
  }
  return static_cast<std::size_t>(std::count_if(wanted.begin(), wanted.end(), [&](Index t) { return !found[t]; }));
}

// Share of all wanted triangles of all places; without a traversal by our own test.
double missedShare(const HapticModel& model, const Partition& tree, const std::vector<std::vector<Index>>& wanted,
                   std::optional<LiteralTraversal> traversal) {
  hdb::LeafHits hits;
  hits.prepareFor(tree);
  std::size_t missing = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < model.places.size(); ++i) {
    const Box3 box = boxAt(model, model.places[i]);
    if (traversal) {
      hdb::findLeavesLiterally(tree, *traversal, box, hits);
    } else {
      hdb::findLeaves(tree, box, hits);
    }
    missing += countMissing(tree, hits.leaves, wanted[i]);
    all += wanted[i].size();
  }
  return static_cast<double>(missing) / static_cast<double>(std::max<std::size_t>(all, 1));
}

double areaOf(const mesh::TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * mesh::areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).norm();
  }
  return area;
}

double areaOf(const std::vector<hdb::Piece>& pieces) {
  double area = 0.0;
  for (const auto& [a, b, c] : pieces) area += 0.5 * mesh::areaVector2(a, b, c).norm();
  return area;
}

void addMisses(const HapticModel& model, const Partition& tree, const std::vector<std::vector<Index>>& wanted,
               AssignmentRow& row) {
  row.missed = missedShare(model, tree, wanted, std::nullopt);
  row.missed_cell_box = missedShare(model, tree, wanted, LiteralTraversal::CellBox);
  if (tree.tree != TreeKind::Bsp) return;
  row.missed_half_space = missedShare(model, tree, wanted, LiteralTraversal::HalfSpace);
  row.missed_else_if = missedShare(model, tree, wanted, LiteralTraversal::ElseIf);
}

AssignmentRow measured(const HapticModel& model, const std::vector<std::vector<Index>>& wanted,
                       const hdb::BuildSettings& settings, int runs, double& area_error) {
  Partition tree;
  const double build_us = shortestMicroseconds(runs, [&] { tree = hdb::buildPartition(model.mesh, settings); });
  const auto statistics = bench::statisticsOf(tree);
  const auto triangles = static_cast<double>(model.mesh.triangles.size());
  const double edge = kPrintedBoxShare * model.longest_edge;
  const FrameTimes frame = meanLiteralFrame(model, &tree, edge, runs);
  const ExactFrame exact = meanExactFrame(model, tree, edge, runs);
  AssignmentRow row{.tree = settings.tree, .assignment = settings.assignment, .threshold = settings.threshold};
  row.leaves = statistics.leaves;
  row.stored = statistics.entries_per_triangle;
  row.overlap = statistics.leaves_per_point;
  row.bytes = static_cast<double>(statistics.bytes) / triangles;
  row.build_ns = 1e3 * build_us / triangles;
  row.rendered = frame.triangles;
  row.wanted = exact.triangles;
  row.frame_us = frame.touchedMicroseconds();
  row.exact_us = exact.find_us;
  addMisses(model, tree, wanted, row);
  if (settings.assignment == Assignment::Cut) {
    const double whole = areaOf(model.mesh);
    area_error = std::max(area_error, std::abs(areaOf(tree.pieces) - whole) / whole);
  }
  return row;
}

}  // namespace

AssignmentPlan assignmentPlan(bool quick) {
  AssignmentPlan plan;
  if (!quick) return plan;
  plan.triangles = 2962;
  plan.thresholds = {64, 1024};
  plan.places = 5;
  plan.runs = 1;
  return plan;
}

AssignmentMeasurement measureAssignments(const AssignmentPlan& plan, const Progress& progress) {
  AssignmentMeasurement found{.plan = plan};
  report(progress, "assignment: building the model", 0.0);
  const HapticModel model = hapticModel(plan.triangles, plan.places);
  const auto wanted = wantedAt(model);
  const double all = 6.0 * static_cast<double>(plan.thresholds.size());
  for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
    for (const Assignment assignment : kAssignments) {
      for (const Index threshold : plan.thresholds) {
        report(progress, "assignment: cases A, B, C", static_cast<double>(found.rows.size()) / all);
        found.rows.push_back(measured(model, wanted, {.tree = tree, .assignment = assignment, .threshold = threshold},
                                      plan.runs, found.cut_area_error));
      }
    }
  }
  for (const Index threshold : plan.thresholds) {
    const auto literal = hdb::buildLiteralOctree(model.mesh, {.threshold = threshold});
    found.lost_two_of_three.push_back(static_cast<double>(literal.lost.size()) /
                                      static_cast<double>(model.mesh.triangles.size()));
  }
  return found;
}

std::vector<AssignmentRow> rowsOf(const AssignmentMeasurement& found, TreeKind tree, Assignment assignment) {
  std::vector<AssignmentRow> rows;
  std::copy_if(found.rows.begin(), found.rows.end(), std::back_inserter(rows),
               [&](const AssignmentRow& row) { return row.tree == tree && row.assignment == assignment; });
  return rows;
}

}  // namespace palpate::study
