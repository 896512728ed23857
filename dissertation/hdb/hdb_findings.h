// What the strokes and the costs say of the detecting box: sentences made of nothing but the measurement.
#pragma once

#include <string>
#include <vector>

#include "dissertation/hdb/hdb_measurement.h"

namespace palpate::study {

/// A paragraph each, most important first.
std::vector<std::string> hdbFindings(const HdbMeasurement& found);

/// The largest and the smallest share of punctured strokes among the rows of these leads; 0 and 1 where there is none.
double mostPunctured(const std::vector<PunctureRow>& rows, double from_lead = 0.0, double to_lead = 1e9);
double leastPunctured(const std::vector<PunctureRow>& rows, double to_lead);

/// The row of that speed and delay, or of the nearest one.
const PunctureRow& rowAt(const std::vector<PunctureRow>& rows, double speed_mm_s, int delay_ticks);

/// The smallest margin over depth that held all strokes of every depth; infinite where none did.
double safeMargin(const HdbMeasurement& found);

}  // namespace palpate::study
