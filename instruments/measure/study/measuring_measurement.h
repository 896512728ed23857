// Synthetic pairs, measured by the product and checked against their truth: good ones, corrupted ones, ones outside its
// formula.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure/study/judged_pair.h"
#include "measure/study/outside_fields.h"
#include "palpate/base/progress.h"

namespace palpate::study {

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

/// Findings of measuring synthetic pairs, in sentences whose verdicts the numbers decide.
std::vector<std::string> measuringFindings(const MeasuringMeasurement& found);

}  // namespace palpate::study
