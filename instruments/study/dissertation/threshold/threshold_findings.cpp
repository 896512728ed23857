// Fills in the sentences of threshold_findings.txt and the verdicts that the numbers decide.
#include "dissertation/threshold/threshold_measurement.h"

#include <algorithm>

#include "dissertation_findings_texts.h"
#include "lab/measured/haptic_frames.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

constexpr double kNearlyAsGood = 1.25;
// A touching finger that renders this share of all is hardly helped by a partition; the text itself names a third.
constexpr double kHardlyAPartition = 1.0 / 3.0;
// Cost of drawing a triangle here, about (`palpate study tables`), us.
constexpr double kDrawingMicroseconds = 0.1;

/// Extent of a value over all models and trees.
template <class Function>
Extent overallExtent(const ThresholdMeasurement& found, Function&& value) {
  Extent extent;
  for (const std::size_t size : found.plan.sizes) {
    for (const TreeKind tree : kTrees) extent.add(value(rowsOf(found, size, tree)));
  }
  return extent;
}

double fastestThreshold(const std::vector<ThresholdRow>& rows) { return static_cast<double>(fastest(rows).threshold); }

FindingValues bestThreshold(const ThresholdMeasurement& found) {
  const Extent loss = lossesAtPrinted(found);
  return {{"best", loss.least > 1.0  ? "none"
                   : loss.most > 1.0 ? "some"
                                     : "all"},
          {"fastest", overallExtent(found, fastestThreshold)},
          {"loss", loss}};
}

double lossOfSize(const ThresholdMeasurement& found, std::size_t size) {
  double most = 0.0;
  for (const TreeKind tree : kTrees) most = std::max(most, lossAtPrinted(rowsOf(found, size, tree)));
  return most;
}

FindingValues sizesForPrinted(const ThresholdMeasurement& found) {
  const std::size_t small = found.plan.sizes.front();
  const std::size_t large = found.plan.sizes.back();
  std::vector<std::size_t> models;
  for (const std::size_t size : found.plan.sizes) {
    if (lossOfSize(found, size) <= kNearlyAsGood) models.push_back(size);
  }
  return {{"nearly", kNearlyAsGood - 1.0},          {"models", models},
          {"small_loss", lossOfSize(found, small)}, {"small", small},
          {"large_loss", lossOfSize(found, large)}, {"large", large}};
}

FindingValues findingOfLeaves(const ThresholdMeasurement& found) {
  double most_share = 0.0;
  for (const ThresholdRow& row : found.rows) most_share = std::max(most_share, row.find_us / row.touched_us);
  const auto rows = rowsOf(found, found.plan.sizes.back(), TreeKind::Bsp);
  const ThresholdRow best = fastest(rows);
  const ThresholdRow printed = rowAt(rows, kPrintedThreshold);
  return {{"share", most_share},           {"most", !(most_share < 0.5)}, {"model", best.model},
          {"best_find_us", best.find_us},  {"best_us", best.touched_us},  {"best_threshold", best.threshold},
          {"find_us", printed.find_us},    {"us", printed.touched_us},    {"rendered", printed.rendered},
          {"best_rendered", best.rendered}};
}

FindingValues smallModel(const ThresholdMeasurement& found) {
  const std::size_t size = found.plan.sizes.front();
  const ThresholdRow bsp = rowAt(rowsOf(found, size, TreeKind::Bsp), kPrintedThreshold);
  const ThresholdRow octree = rowAt(rowsOf(found, size, TreeKind::Octree), kPrintedThreshold);
  const auto all = static_cast<double>(size);
  return {{"model", size},
          {"bsp_leaves", bsp.leaves},
          {"octree_leaves", octree.leaves},
          {"bsp", bsp.rendered / all},
          {"octree", octree.rendered / all},
          {"hardly", std::min(bsp.rendered, octree.rendered) > kHardlyAPartition * all}};
}

Extent spread(const std::vector<ThresholdRow>& rows, double ThresholdRow::*value) {
  Extent times;
  for (const ThresholdRow& row : rows) times.add(row.*value);
  return times;
}

FindingValues ownListValues(const ThresholdMeasurement& found) {
  const auto factor = [&](double ThresholdRow::*value) {
    return overallExtent(found,
                         [&](const std::vector<ThresholdRow>& rows) {
                           const Extent times = spread(rows, value);
                           return times.most / times.least;
                         })
        .most;
  };
  const double ours = factor(&ThresholdRow::exact_us);
  const double theirs = factor(&ThresholdRow::touched_us);
  return {{"less", ours < theirs},
          {"ours", ours},
          {"theirs", theirs},
          {"small_us", found.tick_us.front()},
          {"small", found.plan.sizes.front()},
          {"large_us", found.tick_us.back()},
          {"large", found.plan.sizes.back()}};
}

double fastestWithDrawing(std::vector<ThresholdRow> rows) {
  for (ThresholdRow& row : rows) row.touched_us += kDrawingMicroseconds * row.rendered;
  return fastestThreshold(rows);
}

FindingValues thresholdsWithDrawing(const ThresholdMeasurement& found) {
  const Extent without = overallExtent(found, fastestThreshold);
  const Extent with = overallExtent(found, fastestWithDrawing);
  return {{"drawing_us", kDrawingMicroseconds},
          {"fastest", with},
          {"lower", with.least + with.most < without.least + without.most}};
}

}  // namespace

double lossAtPrinted(const std::vector<ThresholdRow>& rows) {
  return rowAt(rows, kPrintedThreshold).touched_us / fastest(rows).touched_us;
}

Extent lossesAtPrinted(const ThresholdMeasurement& found) { return overallExtent(found, lossAtPrinted); }

std::vector<std::string> thresholdFindings(const ThresholdMeasurement& found) {
  return formatFindings(texts::threshold_findings, {{"best", bestThreshold(found)},
                                                    {"size", sizesForPrinted(found)},
                                                    {"reason", findingOfLeaves(found)},
                                                    {"small_model", smallModel(found)},
                                                    {"own", ownListValues(found)},
                                                    {"drawing", thresholdsWithDrawing(found)}});
}

}  // namespace palpate::study
