// Required and achieved accuracy of threshold tests, and the main results by the names that programs know.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "teach/study/training_measurement.h"

namespace palpate::study {

/// One row of what must be reached.
struct TrainingBar {
  std::string what;
  std::string bar;
  std::string reached;
  bool met = false;
};

/// Measured values only: the quick form leaves much out.
std::vector<TrainingBar> trainingBars(const TrainingMeasurement& found);

/// Over some cells: the largest without sign, the least and the most.
struct CellExtremes {
  double bias_points = 0.0;
  double sd_ln = 0.0;
  double coverage_least = 1.0;
  double coverage_most = 0.0;
  double mean_trials = 0.0;
};

/// Extremes over cells whose truth is at most `most_truth`: 40 % has bars of its own.
CellExtremes findExtremes(const std::vector<RecoveryCell>& cells, double most_truth = 0.3);

const MethodRow& findMethodRow(const TrainingMeasurement& found, AskedBy method);

/// How far the corrected threshold of this row's trainees is from the truth, percent; naive likewise.
double correctedPercent(const ExplorationRow& row);
double naivePercent(const ExplorationRow& row);

/// Results by the names that programs know.
std::vector<std::pair<std::string, double>> trainingPairs(const TrainingMeasurement& found);

}  // namespace palpate::study
