// `palpate study measuring --family NAME`: presses of one family outside the fitted forms, and whether the stated
// uncertainty holds there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measure/study/judged_pair.h"
#include "report/page/study_page.h"

namespace palpate::study {

/// Default number of pairs of a family.
inline constexpr std::size_t kOutsideCases = 24;

struct OutsideNumbers {
  std::size_t pairs = 0;
  std::size_t accepted = 0;
  std::size_t peaks = 0;             ///< accepted pairs with a stated peak
  double axes_within_2sd = 0.0;      ///< share of accepted pairs: both half axes of 2 mm
  double axes4_within_2sd = 0.0;     ///< and of 4 mm
  double peak_within_2sd = 0.0;      ///< share of the stated peaks; 1 where none is stated
  double warned_share = 0.0;         ///< accepted pairs with a warning about the form, or without peak
  double missed_warned_share = 0.0;  ///< accepted pairs with an axis beyond 2 sd: share with a warning; 1 of none
  double acceptedShare() const { return pairs > 0 ? static_cast<double>(accepted) / static_cast<double>(pairs) : 0.0; }
};

OutsideNumbers outsideNumbers(const std::vector<JudgedPair>& pairs);

std::vector<std::string> namesOfOutsideFamilies();

StudyPage studyMeasuringOutside(const StudySettings& settings);

}  // namespace palpate::study
