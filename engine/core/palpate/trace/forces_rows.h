// A row of forces.csv: one finger in one tick, as text.
//
// Numbers are the shortest decimals that read back to the same bits, so two files are equal exactly when two runs were.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/trace/sample.h"

namespace palpate::trace {

/// The header, without a line end. `triangle` is -1 in free air; `state` is free, stick or slip; `device_*` is the
/// force after the safety limits; the status columns hold the bits of contact and servo.
std::string_view forcesCsvHeader();

struct ForcesCsvSettings {
  std::vector<std::string> finger_names;
  double start_s = 0.0;         ///< time of tick 0
  double ticks_per_s = 1000.0;  ///< time of tick k is start_s + k / ticks_per_s: dividing keeps 0.009 printed as 0.009
};

/// Appends one row with its line end.
void appendForcesRow(std::string& text, const ForcesCsvSettings& settings, const Sample& sample);

}  // namespace palpate::trace
