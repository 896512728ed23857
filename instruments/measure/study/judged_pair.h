// Errors of a measurement of a synthetic pair against the truth.
//
//   SyntheticTruth, Measurement ─ judgePair ─► JudgedPair ─► shares and percentiles (measuring_numbers.h)
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

/// A half axis against the true one.
struct AxisError {
  double percent = 0.0;         ///< signed
  double stated_percent = 0.0;  ///< the sd that the measurement states
  double inSds() const;
};

/// Half axes of one level.
struct LevelErrors {
  AxisError major;
  AxisError minor;
  double worsePercent() const;  ///< the larger of the two, without sign
  double worseInSds() const;
};

struct JudgedPair {
  std::uint64_t seed = 0;
  measure::TailFamily family = measure::TailFamily::compact;
  double true_ratio = 1.0;
  double true_half_major_mm = 0.0;
  bool accepted = false;
  std::vector<std::string> refusals;  ///< codes
  std::vector<std::string> warnings;  ///< codes
  std::string reason;                 ///< text of the first refusal
  double seconds = 0.0;

  // Dots.
  double found_before = 0.0;  ///< share of the true marks, also in no order
  double found_after = 0.0;   ///< share of the visible ones
  double in_order = 0.0;      ///< share of the true dots that are in the grid
  std::size_t strays_in_order = 0;
  std::size_t matched = 0;
  std::size_t wrong_matches = 0;

  // Where there is a fit.
  bool fitted = false;
  LevelErrors at_2_mm;
  LevelErrors at_4_mm;
  double ratio_error = 0.0;
  double direction_error_deg = 0.0;
  double direction_sd_deg = 0.0;
  double contact_error_mm = 0.0;
  double contact_sd_mm = 0.0;
  double drag_error_deg = 0.0;
  std::string form;  ///< likeliest of the fitted ones
  double form_share = 1.0;
  AxisError peak;
  bool peak_stated = false;
  double displacement_rms_mm = 0.0;  ///< measured less true, drift taken off, over all rightly matched dots
  double residual_rms_mm = 0.0;
  double residual_pattern = 0.0;
  double drift_in_sd = 0.0;

  // The dissertation's reading.
  bool has_contour = false;
  double chord_percent = 0.0;        ///< half the longest chord against the half major axis
  double chord_direction_deg = 0.0;  ///< error
};

/// `truth` also has the marks; `case_family`: of the pair.
JudgedPair judgePair(const measure::SyntheticCase& made, const measure::SyntheticTruth& truth,
                     const measure::Measurement& measured);

}  // namespace palpate::study
