// The pictures of the study of rivals: sections through the pressed skin, error against time, skins coloured by error.
#pragma once

#include <vector>

#include "dissertation/rivals/rivals_measurement.h"
#include "report/page/study_page.h"

namespace palpate::study {

std::vector<StudyFigure> rivalFigures(const RivalsMeasurement& found);

/// A time as people read it: "2.1 us", "35 ms", "1.2 s".
std::string readableTime(double microseconds);
/// "12 kB", "3.4 MB".
std::string readableBytes(double bytes);

}  // namespace palpate::study
