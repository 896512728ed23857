// A scripted device: where the tip of a finger is over time, read from and written to CSV.
//
// Sits at the very start of a run: the file's rows become one tip position a tick, which contact::step consumes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::device {

/// The header that names columns and units; optional in files that are read, always written.
inline constexpr std::string_view kTrajectoryHeader = "t_s,x_mm,y_mm,z_mm";

/// Largest coordinate in a file, mm: map coordinates reach 2e10 mm (the northing of a map of the world), the last bit
/// of a double is here 0.02 micrometres, and the sixth power still fits.
inline constexpr double kMaxCoordinateMm = 1e11;

/// Largest time in a file, s: clocks that count from 1970, 1900 or the year 1. Only the time since the first row
/// matters; doubles here are 0.02 ms apart.
inline constexpr double kMaxTimeS = 1e11;

/// Longest time from the first row of a file to its last: 14 hours. More is a mistake in the time column.
inline constexpr double kLongestTrajectoryS = 5e4;

struct Trajectory {
  std::vector<double> time_s;  ///< strictly increasing, finite
  std::vector<Vec3> tip_mm;    ///< same size as `time_s`, finite
  std::size_t size() const { return time_s.size(); }
};

/// Reads `t_s,x_mm,y_mm,z_mm` rows. Blank lines and `#` comments are skipped. Throws Error (file:line: cause) for a
/// wrong header, a wrong number of fields, a field that is not a finite number, a coordinate beyond kMaxCoordinateMm, a
/// time beyond kMaxTimeS, time that does not increase or lasts longer than kLongestTrajectoryS, binary content, and a
/// file without rows or larger than 1 GiB.
Trajectory readTrajectory(const std::filesystem::path& file);

/// The same from text; `name` replaces the file in messages.
Trajectory parseTrajectory(std::string_view text, std::string_view name);

/// Rows under the header: whole milliseconds with three decimals, other times with all their digits, positions to a
/// nanometre. Throws Error if it cannot.
void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory);

/// The text that writeTrajectory writes.
std::string formatTrajectory(const Trajectory& trajectory);

/// One sample every `tick_s` seconds from the first to the last row, linear in between. A row that falls on a tick is
/// copied, so a trajectory already at this rate is reproduced bit by bit. Throws Error for tick_s <= 0, for no rows,
/// and for more than 5e7 ticks (14 hours at 1 kHz), which is a mistake in the time column.
Trajectory resampled(const Trajectory& trajectory, double tick_s);

}  // namespace palpate::device
