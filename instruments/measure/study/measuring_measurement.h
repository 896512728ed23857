// Synthetic pairs, measured by the product and checked against their truth: good ones, corrupted ones, ones outside its
// formula.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure/study/outside_fields.h"
#include "palpate/base/progress.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::study {

// Errors of a measurement of a synthetic pair against the truth.
//
//   SyntheticTruth, Measurement ─ judgePair ─► JudgedPair ─► shares and percentiles (measuring_numbers.h)

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

struct MeasuringPlan {
  std::uint64_t seed = 1;
  std::size_t cases = 100;  ///< good pairs, every second one with a long tail
  double megapixels = 2.0;
  std::size_t large_every = 25;    ///< interval of good pairs with 12 megapixels; 0: none
  std::size_t corrupted_each = 4;  ///< number per kind
  std::size_t exact_each = 60;     ///< pairs without pixels, of every kind
  double timed_megapixels = 12.0;
};

MeasuringPlan measuringPlan(bool quick);

struct JudgedCorrupted {
  std::size_t kind = 0;
  JudgedPair judged;
};

/// Pairs without pixels.
struct ExactPairs {
  std::string name;
  std::vector<JudgedPair> pairs;
};

struct MeasuringMeasurement {
  MeasuringPlan plan;
  std::vector<JudgedPair> good;
  std::vector<JudgedCorrupted> corrupted;
  ExactPairs drifted;     ///< moved by 1.5 mm, measured as if the breath had been held
  ExactPairs breathing;   ///< the same, with breathing allowed for
  ExactPairs half_space;  ///< elastic, outside the fitted formula
  ExactPairs windowed;    ///< the same, cut by a window
  ExactPairs lopsided;    ///< 20 % stronger behind the stick
  double large_s = 0.0;   ///< a pair of 12 megapixels from its files' bytes to findings, one core
  double hundred_fits_s = 0.0;
};

/// `count` presses of a family whose skin moves as in no fitted form (outside_fields.h), without pixels.
ExactPairs measureOutside(OutsideFamily family, std::uint64_t seed, std::size_t count, const Progress& progress);

/// The same for any number of threads, but for the times.
MeasuringMeasurement measureMeasuring(const MeasuringPlan& plan, const Progress& progress);

// Faulty pairs of photographs: some that a measurement must refuse, others that it may not be wrong about.

/// Acceptable outcomes for a kind of pair.
enum class Fate : unsigned char {
  refused,           ///< it must be
  refused_or_right,  ///< accepted only where it is right
  not_seen           ///< nothing in the pictures shows it
};

struct CorruptedKind {
  std::string name;
  Fate fate = Fate::refused;
};

const std::vector<CorruptedKind>& corruptedKinds();

struct CorruptedPair {
  measure::SyntheticCase made;
  measure::Photograph before;
  measure::Photograph after;
  measure::SyntheticTruth truth;
  measure::MeasureSettings settings;
};

/// The kind by its place in corruptedKinds(); drawn from the seed.
CorruptedPair corruptedPair(std::size_t kind, std::uint64_t seed, double megapixels);

// Findings of measuring synthetic pairs, in sentences whose verdicts the numbers decide.

std::vector<std::string> measuringFindings(const MeasuringMeasurement& found);

}  // namespace palpate::study
