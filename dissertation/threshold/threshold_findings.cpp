// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/threshold/threshold_measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lab/measured/haptic_frames.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

constexpr double kNearlyAsGood = 1.25;
// A touching finger that renders so much of all is hardly helped by a partition; the text itself speaks of a third.
constexpr double kHardlyAPartition = 1.0 / 3.0;
// What drawing adds to a triangle here, about (`palpate study tables`), us.
constexpr double kDrawingMicroseconds = 0.1;

/// Of something over all models and trees.
template <class Function>
Extent extentOf(const ThresholdMeasurement& found, Function&& value) {
  Extent extent;
  for (const std::size_t size : found.plan.sizes) {
    for (const TreeKind tree : kTrees) extent.add(value(rowsOf(found, size, tree)));
  }
  return extent;
}

std::string bestVerdict(const Extent& loss) {
  if (loss.least > 1.0) return "1024 is not the best for any of these models.";
  return loss.most > 1.0 ? "1024 is the best for some of these models only."
                         : "1024 is the best for all of these models.";
}

double fastestThreshold(const std::vector<ThresholdRow>& rows) { return static_cast<double>(fastest(rows).threshold); }

std::string bestFinding(const ThresholdMeasurement& found) {
  const Extent best = extentOf(found, fastestThreshold);
  const Extent loss = lossesAtPrinted(found);
  return fmt::format(
      "{} A frame in the dissertation's way is fastest with leaves of at most {} to {} triangles; 1024 takes {} to {} "
      "times as long.",
      bestVerdict(loss), counted(best.least), counted(best.most), rounded(loss.least), rounded(loss.most));
}

double lossOfSize(const ThresholdMeasurement& found, std::size_t size) {
  double most = 0.0;
  for (const TreeKind tree : kTrees) most = std::max(most, lossAtPrinted(rowsOf(found, size, tree)));
  return most;
}

std::string sizeFinding(const ThresholdMeasurement& found) {
  std::vector<std::string> models;
  for (const std::size_t size : found.plan.sizes) {
    if (lossOfSize(found, size) <= kNearlyAsGood) models.push_back(counted(static_cast<double>(size)));
  }
  return fmt::format(
      "For which size would it be right? 1024 is within {} of the fastest for {}. It takes up to {} times as long on "
      "{} "
      "triangles and up to {} times on {}.",
      percent(kNearlyAsGood - 1.0),
      models.empty() ? "none of these models" : fmt::format("models of {} triangles", fmt::join(models, ", ")),
      rounded(lossOfSize(found, found.plan.sizes.front())), counted(static_cast<double>(found.plan.sizes.front())),
      rounded(lossOfSize(found, found.plan.sizes.back())), counted(static_cast<double>(found.plan.sizes.back())));
}

std::string reasonFinding(const ThresholdMeasurement& found) {
  double most_share = 0.0;
  for (const ThresholdRow& row : found.rows) most_share = std::max(most_share, row.find_us / row.touched_us);
  const auto rows = rowsOf(found, found.plan.sizes.back(), TreeKind::Bsp);
  const ThresholdRow best = fastest(rows);
  const ThresholdRow printed = rowAt(rows, kPrintedThreshold);
  return fmt::format(
      "The text fears that small leaves make \"traversing the tree more complex\". Finding the leaves takes at most {} "
      "of a "
      "frame{}: on {} triangles {} us of {} with leaves of {}, and {} us of {} with leaves of 1024, which render {} "
      "triangles against {}.",
      percent(most_share), most_share < 0.5 ? ", so it is never what costs most" : ", so it can be what costs most",
      counted(static_cast<double>(best.model)), rounded(best.find_us), rounded(best.touched_us), best.threshold,
      rounded(printed.find_us), rounded(printed.touched_us), counted(printed.rendered), counted(best.rendered));
}

std::string smallModelFinding(const ThresholdMeasurement& found) {
  const std::size_t size = found.plan.sizes.front();
  const ThresholdRow bsp = rowAt(rowsOf(found, size, TreeKind::Bsp), kPrintedThreshold);
  const ThresholdRow octree = rowAt(rowsOf(found, size, TreeKind::Octree), kPrintedThreshold);
  const auto all = static_cast<double>(size);
  const bool hardly = std::min(bsp.rendered, octree.rendered) > kHardlyAPartition * all;
  return fmt::format(
      "On our back of {} triangles 1024 makes {} leaves (BSP tree) and {} (octree), and a touching finger renders {} "
      "and "
      "{} of all triangles{}.",
      counted(all), bsp.leaves, octree.leaves, percent(bsp.rendered / all), percent(octree.rendered / all),
      hardly ? " (E13): hardly a partition" : "");
}

Extent spread(const std::vector<ThresholdRow>& rows, double ThresholdRow::*value) {
  Extent times;
  for (const ThresholdRow& row : rows) times.add(row.*value);
  return times;
}

std::string ownFinding(const ThresholdMeasurement& found) {
  const auto factor = [&](double ThresholdRow::*value) {
    return extentOf(found,
                    [&](const std::vector<ThresholdRow>& rows) {
                      const Extent times = spread(rows, value);
                      return times.most / times.least;
                    })
        .most;
  };
  const double ours = factor(&ThresholdRow::exact_us);
  const double theirs = factor(&ThresholdRow::touched_us);
  return fmt::format(
      "{}: the exact list goes on below the leaves in blocks of 16 triangles, and its time changes by a factor of at "
      "most "
      "{} over all thresholds, that of a frame in the dissertation's way by {}. The default finger, which has no box, "
      "takes {} us on {} triangles and {} us on {}.",
      ours < theirs ? "Ours depends less on this choice" : "Ours depends on this choice as much", rounded(ours),
      rounded(theirs), rounded(found.tick_us.front()), counted(static_cast<double>(found.plan.sizes.front())),
      rounded(found.tick_us.back()), counted(static_cast<double>(found.plan.sizes.back())));
}

double fastestWithDrawing(std::vector<ThresholdRow> rows) {
  for (ThresholdRow& row : rows) row.touched_us += kDrawingMicroseconds * row.rendered;
  return fastestThreshold(rows);
}

std::string drawingFinding(const ThresholdMeasurement& found) {
  const Extent without = extentOf(found, fastestThreshold);
  const Extent with = extentOf(found, fastestWithDrawing);
  const bool lower = with.least + with.most < without.least + without.most;
  return fmt::format(
      "With {} us more for each triangle in the leaves, about what drawing it costs here (`palpate study tables`), the "
      "fastest thresholds are {} to {}: {}.",
      kDrawingMicroseconds, counted(with.least), counted(with.most),
      lower ? "drawing moves them down" : "drawing does not move them down");
}

}  // namespace

double lossAtPrinted(const std::vector<ThresholdRow>& rows) {
  return rowAt(rows, kPrintedThreshold).touched_us / fastest(rows).touched_us;
}

Extent lossesAtPrinted(const ThresholdMeasurement& found) { return extentOf(found, lossAtPrinted); }

std::vector<std::string> thresholdFindings(const ThresholdMeasurement& found) {
  return {bestFinding(found),       sizeFinding(found), reasonFinding(found),
          smallModelFinding(found), ownFinding(found),  drawingFinding(found)};
}

}  // namespace palpate::study
