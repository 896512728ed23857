// Findings of the rivals' measurement: sentences made of nothing but its numbers, and the sums behind these and the
// tables.
#pragma once

#include <string>
#include <vector>

#include "dissertation/rivals/layered_truth.h"
#include "dissertation/rivals/rivals_measurement.h"
#include "report/page/study_page.h"

namespace palpate::study {

inline constexpr const char* kFittedTissue = "back_mid";  ///< fits the default circle of FSMD (E21)

/// Calls `function` for the rows of a method at the common size, every tissue and depth; free form with the plan's
/// lattice.
template <class Function>
void forEachCommon(const RivalsMeasurement& found, Rival rival, const Function& function) {
  for (const LayeredPress& press : layeredPresses()) {
    function(findRivalRow(found, rival, press.tissue, press.depth_mm, found.plan.common_cells));
  }
}

Extent errorExtent(const RivalsMeasurement& found, Rival rival);
double meanError(const RivalsMeasurement& found, Rival rival);
double slowestUs(const RivalsMeasurement& found, Rival rival);

/// Paragraphs, most important first.
std::vector<std::string> rivalFindings(const RivalsMeasurement& found);

// The pictures of the study of rivals: sections through the pressed skin, error against time, skins coloured by error.

std::vector<StudyFigure> rivalFigures(const RivalsMeasurement& found);

/// A time as people read it: "2.1 us", "35 ms", "1.2 s".
std::string readableTime(double microseconds);
/// "12 kB", "3.4 MB".
std::string readableBytes(double bytes);

}  // namespace palpate::study
