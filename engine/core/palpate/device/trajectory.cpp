// Rows are checked as they are read; resampling walks both time axes once. Times are written in decimals, so a row
// within a millionth of a tick of one counts as on it and is reproduced bit by bit. Cold path.
#include "palpate/device/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::device {
namespace {

constexpr std::size_t kFields = 4;
/// 1 GiB: five hours of rows at 1 kHz. Anything longer is not a trajectory.
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
constexpr double kMaxTicks = 5e7;
/// Rows this close to a tick, in ticks, are on it: times are written in decimal and so are off by rounding.
constexpr double kOnTick = 1e-6;

constexpr NumberRange kTimesS{-kMaxTimeS, kMaxTimeS};
constexpr NumberRange kCoordinatesMm{-kMaxCoordinateMm, kMaxCoordinateMm};

void appendRow(const CsvRow& row, Trajectory& trajectory) {
  const double time = csvNumber(row, 0, "t_s", kTimesS);
  if (!trajectory.time_s.empty() && time <= trajectory.time_s.back()) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("t_s must increase, but {} s follows {} s", time, trajectory.time_s.back()));
  }
  if (!trajectory.time_s.empty() && time - trajectory.time_s.front() > kLongestTrajectoryS) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("t_s = {} is {} s after the first row; a trajectory lasts at most {} s", time,
                                    time - trajectory.time_s.front(), readableNumber(kLongestTrajectoryS)));
  }
  trajectory.time_s.push_back(time);
  trajectory.tip_mm.emplace_back(csvNumber(row, 1, "x_mm", kCoordinatesMm), csvNumber(row, 2, "y_mm", kCoordinatesMm),
                                 csvNumber(row, 3, "z_mm", kCoordinatesMm));
}

void requireFields(const CsvRow& row) {
  if (row.fields.size() == kFields) return;
  throw Error::atLine(row.file, row.line,
                      fmt::format("expected {} fields ({}), found {}", kFields, kTrajectoryHeader, row.fields.size()));
}

/// A header must name these columns, for it also names the units.
void requireHeader(const CsvRow& row) {
  if (std::ranges::equal(row.fields, split(kTrajectoryHeader, ','))) return;
  throw unexpectedHeader(row, fmt::format("{} or numbers", kTrajectoryHeader));
}

/// Times on whole milliseconds are written as such; others need every digit, or rows of a faster device would coincide.
std::string formatTime(double time_s) {
  const bool whole = std::abs(time_s * 1e3 - std::round(time_s * 1e3)) < kOnTick;
  return whole ? fmt::format("{:.3f}", time_s) : fmt::format("{}", time_s);
}

/// Tolerance within which a row counts as on a tick, s: times since 1970 are 0.2 microseconds apart as doubles.
double onTickS(const Trajectory& trajectory, double tick_s) {
  const double latest = std::max(std::abs(trajectory.time_s.front()), std::abs(trajectory.time_s.back()));
  return std::max(kOnTick * tick_s, 2.0 * std::numeric_limits<double>::epsilon() * latest);
}

/// The position at `time`, between row `before` and the next.
Vec3 interpolated(const Trajectory& trajectory, std::size_t before, double time, double on_tick_s) {
  const std::vector<double>& t = trajectory.time_s;
  if (std::abs(time - t[before]) <= on_tick_s || before + 1 == t.size()) return trajectory.tip_mm[before];
  if (std::abs(time - t[before + 1]) <= on_tick_s) return trajectory.tip_mm[before + 1];
  const double share = (time - t[before]) / (t[before + 1] - t[before]);
  return (1.0 - share) * trajectory.tip_mm[before] + share * trajectory.tip_mm[before + 1];
}

}  // namespace

Trajectory readTrajectory(const std::filesystem::path& file) {
  return parseTrajectory(readFile(file, kMaxFileBytes), file.string());
}

Trajectory parseTrajectory(std::string_view text, std::string_view name) {
  Trajectory trajectory;
  bool first = true;
  forEachCsvRow(text, name, [&](const CsvRow& row) {
    const bool is_header = first && looksLikeCsvHeader(row);
    first = false;
    if (is_header) return requireHeader(row);
    requireFields(row);
    appendRow(row, trajectory);
  });
  if (trajectory.time_s.empty()) throw Error::inFile(name, "the trajectory has no rows");
  return trajectory;
}

std::string formatTrajectory(const Trajectory& trajectory) {
  std::string text = fmt::format("{}\n", kTrajectoryHeader);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Vec3& tip = trajectory.tip_mm[i];
    fmt::format_to(std::back_inserter(text), "{},{:.6f},{:.6f},{:.6f}\n", formatTime(trajectory.time_s[i]), tip.x(),
                   tip.y(), tip.z());
  }
  return text;
}

void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  writeFile(file, formatTrajectory(trajectory));
}

Trajectory resampled(const Trajectory& trajectory, double tick_s) {
  if (!(tick_s > 0.0)) throw Error("the tick must be longer than 0 s");
  if (trajectory.time_s.empty()) throw Error("a trajectory without rows cannot be resampled");
  const double start = trajectory.time_s.front();
  const double on_tick_s = onTickS(trajectory, tick_s);
  const double ticks = std::floor((trajectory.time_s.back() - start + on_tick_s) / tick_s);
  if (!(ticks < kMaxTicks))
    throw Error(fmt::format("the trajectory has {} ticks; expected at most {}", readableNumber(ticks),
                            readableNumber(kMaxTicks)));

  Trajectory result;
  std::size_t before = 0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(ticks); ++k) {
    const double time = start + static_cast<double>(k) * tick_s;
    while (before + 1 < trajectory.size() && trajectory.time_s[before + 1] <= time) ++before;
    result.time_s.push_back(time);
    result.tip_mm.push_back(interpolated(trajectory, before, time, on_tick_s));
  }
  return result;
}

}  // namespace palpate::device
