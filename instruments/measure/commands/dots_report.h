// A measurement for people and for machines: what `palpate measure dots` prints and writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/measure/measurement.h"

namespace palpate::app {

/// Facts about a measurement that Measurement does not hold.
struct MeasuredPair {
  std::string name = "P1";
  std::vector<std::string> files = {};         ///< pictures before and after, or the table of dots
  std::optional<Vec2> place_mm = {};           ///< place of the contact on the body
  std::optional<double> null_drift_mm = {};    ///< between two pictures before
  std::vector<std::string> notes = {};         ///< on the pictures
  std::optional<double> seconds_between = {};  ///< the pictures, by the camera's clock
};

/// Lines of text, the last with its end.
std::string reportText(const measure::Measurement& measurement, const MeasuredPair& pair);
Json reportJson(const measure::Measurement& measurement, const MeasuredPair& pair);

/// A table of key points with the one row; the row of a refused measurement is a comment, so that no map reads it.
std::string keyTable(const measure::Measurement& measurement, const MeasuredPair& pair);

}  // namespace palpate::app
