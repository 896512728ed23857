// Shares and percentiles of the pairs' errors, and the bars for them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "measure/study/corrupted_pairs.h"
#include "measure/study/measuring_measurement.h"

namespace palpate::study {

/// Off and stated sd of the major half axis, then of the minor one (%): four cells of a table.
std::vector<std::string> halfAxisCells(const LevelErrors& errors);

struct Percentiles {
  double median = 0.0;
  double p95 = 0.0;
};

/// Below this ratio an ellipse is too round for its direction to be held against a bar.
inline constexpr double kDirectedRatio = 1.15;

/// Numbers of a set of pairs; errors are of the accepted ones, half axes by the worse of the two.
struct SetNumbers {
  std::size_t pairs = 0;
  std::size_t accepted = 0;
  Percentiles axis2_percent;
  Percentiles axis4_percent;
  Percentiles ratio;
  Percentiles direction_deg;  ///< for ratios from kDirectedRatio
  Percentiles contact_mm;
  Percentiles drag_deg;
  Percentiles peak_percent;
  Percentiles displacement_mm;
  Percentiles chord_percent;        ///< as the dissertation reads the contour
  Percentiles chord_direction_deg;  ///< for ratios from kDirectedRatio
  double worst_axis_percent = 0.0;
  double worst_axis_sds = 0.0;  ///< over the sd that is stated
  double within_2_sd = 0.0;     ///< share
  double share() const { return pairs > 0 ? static_cast<double>(accepted) / static_cast<double>(pairs) : 0.0; }
};

SetNumbers numbersOf(const std::vector<JudgedPair>& pairs);
std::vector<JudgedPair> ofFamily(const std::vector<JudgedPair>& pairs, measure::TailFamily family);

/// Outcomes of the pairs of one corrupted kind.
struct CorruptedNumbers {
  CorruptedKind kind;
  std::size_t pairs = 0;
  std::size_t refused = 0;
  std::size_t right = 0;             ///< accepted, and within 8 % or 2 sd
  double worst_percent = 0.0;        ///< largest error of the accepted
  std::vector<std::string> codes{};  ///< codes of the refusals, each once
  std::size_t wrong() const { return pairs - refused - right; }
};

std::vector<CorruptedNumbers> corruptedNumbers(const MeasuringMeasurement& found);

/// Dots over all good pairs.
struct DotNumbers {
  double found_mean = 0.0;
  double found_least = 0.0;  ///< in one picture
  double in_order_mean = 0.0;
  double wrong_per_1000 = 0.0;
  double strays_in_order = 0.0;  ///< per picture
};

DotNumbers dotNumbers(const std::vector<JudgedPair>& pairs);

/// Moved more than allowed, by name, of all.
double refusedAsMoved(const std::vector<JudgedPair>& pairs);

/// One row of what must be reached.
struct Bar {
  std::string what;
  std::string bar;
  double reached = 0.0;
  std::string shown;
  bool met = false;
};

std::vector<Bar> checkBars(const MeasuringMeasurement& found);

/// Results by the names that programs know.
std::vector<std::pair<std::string, double>> measuringPairs(const MeasuringMeasurement& found);

}  // namespace palpate::study
