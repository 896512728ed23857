#include "study/hdb_measurement.h"

#include <algorithm>

#include "study/finger_strokes.h"
#include "study/haptic_frames.h"
#include "study/late_box.h"

namespace palpate::study {

namespace {

using contact::HdbQuery;
using partition::TreeKind;
using SharedPartition = std::shared_ptr<const partition::Partition>;

// Half the edge over the finger's way until the box follows: around 1, where it must turn out.
constexpr double kLeads[] = {0.25, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0};
// Strokes that no other part of the study saw.
constexpr std::uint64_t kUnseenSeed = 77;
constexpr double kSlideMm = 160.0;

SharedPartition treeOf(const mesh::TriangleMesh& mesh, TreeKind tree) {
  return std::make_shared<const partition::Partition>(
      partition::buildPartition(mesh, {.tree = tree, .threshold = 1024}));
}

/// What all runs of strokes share.
struct Strokes {
  const HdbPlan& plan;
  const contact::Surface& surface;
  SharedPartition octree;

  std::vector<std::vector<Vec3>> at(double speed, std::uint64_t seed = 1) const {
    return fingerStrokes({.count = plan.strokes, .speed_mm_s = speed, .slide_mm = kSlideMm, .seed = seed});
  }
  PunctureRow run(const std::vector<std::vector<Vec3>>& strokes, PunctureRow row) const {
    contact::HdbSettings box;
    box.edges_mm = Vec3::Constant(row.edge_mm);
    box.query = row.leaves ? HdbQuery::leaves : HdbQuery::triangles;
    box.ticks_per_refresh = static_cast<std::uint32_t>(row.delay_ticks);
    const LateBoxResult result = strokeWithLateBox(surface, contact::makeHdbSurface(surface, octree, box), strokes);
    row.punctured = result.puncturedShare();
    row.triangles = result.mean_listed;
    return row;
  }
};

std::vector<HdbSizeRow> sizeRows(const HdbPlan& plan, const HapticModel& model, const SharedPartition& octree,
                                 const Progress& progress) {
  const SharedPartition bsp = treeOf(model.mesh, TreeKind::Bsp);
  std::vector<HdbSizeRow> rows;
  for (const double share : plan.shares) {
    report(progress, "hdb: sizes of the box", 0.15 * static_cast<double>(rows.size()) / plan.shares.size());
    HdbSizeRow row{.share = share, .edge_mm = share * model.longest_edge};
    const FrameTimes in_bsp = meanLiteralFrame(model, bsp.get(), row.edge_mm, plan.runs);
    const FrameTimes in_octree = meanLiteralFrame(model, octree.get(), row.edge_mm, plan.runs);
    const ExactFrame exact = meanExactFrame(model, *octree, row.edge_mm, plan.runs);
    row.bsp_triangles = in_bsp.triangles;
    row.bsp_us = in_bsp.touchedMicroseconds();
    row.octree_triangles = in_octree.triangles;
    row.octree_us = in_octree.touchedMicroseconds();
    row.exact_triangles = exact.triangles;
    row.exact_us = exact.find_us;
    rows.push_back(row);
  }
  return rows;
}

std::vector<PunctureRow> edgeRows(const Strokes& strokes, bool leaves, const Progress& progress, double done) {
  std::vector<PunctureRow> rows;
  const HdbPlan& plan = strokes.plan;
  for (const double speed : plan.speeds_mm_s) {
    const auto ways = strokes.at(speed);
    for (const double edge : plan.edges_mm) {
      report(progress, "hdb: punctures",
             done + 0.25 * static_cast<double>(rows.size()) / (plan.speeds_mm_s.size() * plan.edges_mm.size()));
      rows.push_back(strokes.run(
          ways, {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = plan.delays_ticks.front(), .leaves = leaves}));
    }
  }
  return rows;
}

std::vector<PunctureRow> leadRows(const Strokes& strokes, const Progress& progress) {
  std::vector<PunctureRow> rows;
  for (const int delay : strokes.plan.delays_ticks) {
    for (const double speed : strokes.plan.speeds_mm_s) {
      report(progress, "hdb: punctures against the way of the finger", 0.7);
      const auto ways = strokes.at(speed);
      for (const double lead : kLeads) {
        const double edge = 2.0 * lead * speed * 1e-3 * delay;
        rows.push_back(strokes.run(ways, {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = delay}));
      }
    }
  }
  return rows;
}

std::vector<PunctureRow> recommendedRows(const Strokes& strokes, const HdbMeasurement& found,
                                         const Progress& progress) {
  std::vector<PunctureRow> rows;
  for (const int delay : strokes.plan.delays_ticks) {
    for (const double speed : strokes.plan.speeds_mm_s) {
      report(progress, "hdb: the recommended box", 0.9);
      const double edge = recommendedEdge(speed, 1e-3 * delay, found.depth_mm, found.triangle_edge);
      rows.push_back(
          strokes.run(strokes.at(speed, kUnseenSeed), {.edge_mm = edge, .speed_mm_s = speed, .delay_ticks = delay}));
    }
  }
  return rows;
}

// The pseudocode of 3.3.3 with a box that follows at every tick.
double elseIfPunctures(const Strokes& strokes, const HapticModel& model) {
  const SharedPartition bsp = treeOf(model.mesh, TreeKind::Bsp);
  const auto ways = strokes.at(200.0);
  double least = 1.0;
  for (const double share : kElseIfShares) {
    contact::HdbSettings box;
    box.edges_mm = Vec3::Constant(share * model.longest_edge);
    box.literal = partition::LiteralTraversal::ElseIf;
    const auto shared = contact::makeHdbSurface(strokes.surface, bsp, box);
    least = std::min(least, strokeWithLateBox(strokes.surface, shared, ways).puncturedShare());
  }
  return least;
}

}  // namespace

HdbPlan hdbPlan(bool quick) {
  HdbPlan plan;
  if (!quick) return plan;
  plan.triangles = 8163;
  plan.places = 6;
  plan.runs = 1;
  plan.strokes = 8;
  plan.shares = {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0};
  plan.edges_mm = {4, 16, 50, 100};
  plan.speeds_mm_s = {500, 2000};
  plan.delays_ticks = {10, 20};
  return plan;
}

double recommendedEdge(double speed_mm_s, double delay_s, double depth_mm, double triangle_edge_mm) {
  return partition::leastHdbEdge(speed_mm_s, delay_s, triangle_edge_mm) + 2.0 * depth_mm;
}

double safeSpeed(double edge_mm, double delay_s, double depth_mm, double triangle_edge_mm) {
  return std::max(0.0, 0.5 * edge_mm - depth_mm - triangle_edge_mm) / delay_s;
}

HdbMeasurement measureHdbSizes(const HdbPlan& plan, const Progress& progress) {
  report(progress, "hdb: building the model", 0.0);
  const HapticModel model = hapticModel(plan.triangles, plan.places);
  const contact::Surface surface = contactSurface(model.mesh);
  const SharedPartition octree = treeOf(model.mesh, TreeKind::Octree);
  const Strokes strokes{plan, surface, octree};
  HdbMeasurement found{.plan = plan};
  found.longest_edge = model.longest_edge;
  found.triangle_edge = longestTriangleEdge(model.mesh);
  found.depth_mm = StrokeSettings{}.depth_mm;
  found.tick_us = meanTickMicroseconds(surface, plan.runs);
  found.sizes = sizeRows(plan, model, octree, progress);
  found.punctures = edgeRows(strokes, false, progress, 0.15);
  found.leaf_punctures = edgeRows(strokes, true, progress, 0.4);
  found.leads = leadRows(strokes, progress);
  found.recommended = recommendedRows(strokes, found, progress);
  found.else_if_punctured = elseIfPunctures(strokes, model);
  return found;
}

}  // namespace palpate::study
