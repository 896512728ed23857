// The study of the threshold: frames of the haptic process for every size of leaf and of model.
#pragma once

#include <string>
#include <vector>

#include "palpate/hdb/partition.h"
#include "report/page/study_page.h"

namespace palpate::study {

struct ThresholdPlan {
  std::vector<std::size_t> sizes{2962, 8163, 41582, 200000, 1000000};
  std::vector<Index> thresholds{8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384};
  int places = 16;
  int runs = 3;
};

ThresholdPlan thresholdPlan(bool quick);

/// One model, tree and threshold; means over the places.
struct ThresholdRow {
  std::size_t model = 0;  ///< triangles
  hdb::TreeKind tree = hdb::TreeKind::Bsp;
  Index threshold = 0;
  std::size_t leaves = 0;
  int height = 0;
  double rendered = 0.0;    ///< triangles in the leaves that the box meets
  double find_us = 0.0;     ///< to find these leaves
  double touched_us = 0.0;  ///< the whole frame in the dissertation's way, without drawing
  double exact_us = 0.0;    ///< our list of the triangles that the box meets
};

struct ThresholdMeasurement {
  ThresholdPlan plan;
  std::vector<ThresholdRow> rows{};       ///< by model, then tree, then threshold
  std::vector<double> exact_triangles{};  ///< in the box, one number a model
  std::vector<double> tick_us{};          ///< tick of the default finger, one a model
};

ThresholdMeasurement measureThresholds(const ThresholdPlan& plan, const Progress& progress);

/// The rows of one model and tree, by threshold.
std::vector<ThresholdRow> rowsOf(const ThresholdMeasurement& found, std::size_t model, hdb::TreeKind tree);
/// The row with the shortest frame; rows must not be empty.
ThresholdRow fastest(const std::vector<ThresholdRow>& rows);
/// The row of that threshold, or of the nearest one.
ThresholdRow rowAt(const std::vector<ThresholdRow>& rows, Index threshold);

// Findings from the frames about the threshold: sentences made of nothing but the measurement.

/// Paragraphs, most important first.
std::vector<std::string> thresholdFindings(const ThresholdMeasurement& found);

/// The time of a frame at the printed threshold over that at the fastest, of one model and tree.
double lossAtPrinted(const std::vector<ThresholdRow>& rows);
/// The same over all models and trees.
Extent lossesAtPrinted(const ThresholdMeasurement& found);

}  // namespace palpate::study
