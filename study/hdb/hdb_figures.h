// The figures of the study of the detecting box.
#pragma once

#include <vector>

#include "study/hdb/hdb_measurement.h"

namespace palpate::study {

std::vector<StudyFigure> hdbFigures(const HdbMeasurement& found);

}  // namespace palpate::study
