// For each model, tree and threshold: build, then one frame at each place, of the dissertation's way and of ours.
// Based on: Ji, dissertation 2008, 3.3.1, with E7.
#include "dissertation/threshold/threshold_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/measured/haptic_frames.h"
#include "lab/runs/partition_statistics.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

ThresholdRow measured(const HapticModel& model, TreeKind tree, Index threshold, const ThresholdPlan& plan,
                      double& exact_triangles) {
  const auto built = hdb::buildPartition(model.mesh, {.tree = tree, .threshold = threshold});
  const auto statistics = bench::statisticsOf(built);
  const double edge = kPrintedBoxShare * model.longest_edge;
  const FrameTimes frame = meanLiteralFrame(model, &built, edge, plan.runs);
  const ExactFrame exact = meanExactFrame(model, built, edge, plan.runs);
  exact_triangles = exact.triangles;
  return {.model = model.mesh.triangles.size(),
          .tree = tree,
          .threshold = threshold,
          .leaves = statistics.leaves,
          .height = statistics.height,
          .rendered = frame.triangles,
          .find_us = frame.find_us,
          .touched_us = frame.touchedMicroseconds(),
          .exact_us = exact.find_us};
}

}  // namespace

ThresholdPlan thresholdPlan(bool quick) {
  ThresholdPlan plan;
  if (!quick) return plan;
  plan.sizes = {2962, 8163};
  plan.thresholds = {64, 1024, 16384};
  plan.places = 4;
  plan.runs = 1;
  return plan;
}

ThresholdMeasurement measureThresholds(const ThresholdPlan& plan, const Progress& progress) {
  ThresholdMeasurement found{.plan = plan};
  double triangles_done = 0.0;
  double triangles_in_all = 0.0;
  for (const std::size_t size : plan.sizes) triangles_in_all += static_cast<double>(size);
  for (const std::size_t size : plan.sizes) {
    const std::string stage = "threshold: model of " + counted(static_cast<double>(size)) + " triangles";
    report(progress, stage, triangles_done / triangles_in_all);
    const HapticModel model = hapticModel(size, plan.places);
    found.exact_triangles.push_back(0.0);
    for (const TreeKind tree : {TreeKind::Bsp, TreeKind::Octree}) {
      for (const Index threshold : plan.thresholds) {
        found.rows.push_back(measured(model, tree, threshold, plan, found.exact_triangles.back()));
        triangles_done += 0.5 * static_cast<double>(size) / static_cast<double>(plan.thresholds.size());
        report(progress, stage, triangles_done / triangles_in_all);
      }
    }
    found.tick_us.push_back(meanTickMicroseconds(contactSurface(model.mesh), plan.runs));
  }
  return found;
}

std::vector<ThresholdRow> rowsOf(const ThresholdMeasurement& found, std::size_t model, TreeKind tree) {
  std::vector<ThresholdRow> rows;
  std::copy_if(found.rows.begin(), found.rows.end(), std::back_inserter(rows),
               [&](const ThresholdRow& row) { return row.model == model && row.tree == tree; });
  return rows;
}

ThresholdRow fastest(const std::vector<ThresholdRow>& rows) {
  return *std::min_element(rows.begin(), rows.end(),
                           [](const ThresholdRow& a, const ThresholdRow& b) { return a.touched_us < b.touched_us; });
}

ThresholdRow rowAt(const std::vector<ThresholdRow>& rows, Index threshold) {
  const auto distance = [&](const ThresholdRow& row) {
    return std::abs(std::log(static_cast<double>(row.threshold) / static_cast<double>(threshold)));
  };
  return *std::min_element(rows.begin(), rows.end(),
                           [&](const ThresholdRow& a, const ThresholdRow& b) { return distance(a) < distance(b); });
}

}  // namespace palpate::study
