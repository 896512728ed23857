#include "study/numbers_study.h"

#include "study/numbers_chapters.h"

namespace palpate::study {

std::vector<NumberRow> studyNumbers(const PrintedNumbers& printed) {
  Rows rows;
  addHaptics(printed, rows);
  addPartitionComplexity(printed, rows);
  addMeasuredRates(printed, rows);
  addProfile(printed, rows);
  addInterpolation(printed, rows);
  addMeasuredEllipses(printed, rows);
  addStatements(printed, rows);
  return rows;
}

}  // namespace palpate::study
