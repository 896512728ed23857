#include "palpate/device/trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

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

/// Hands out lines without their ends and counts them from 1.
struct LineReader {
  std::string_view rest;
  std::string_view name;
  std::size_t line = 0;

  bool next(std::string_view& text) {
    if (rest.empty()) return false;
    const std::size_t end = rest.find('\n');
    text = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    ++line;
    return true;
  }
  Error error(std::string_view cause) const { return Error::atLine(name, line, cause); }
};

double readField(std::string_view field, std::string_view column, const LineReader& lines) {
  const std::optional<double> number = parseNumber(field);
  if (!number) throw lines.error(fmt::format("{} is not a number: '{}'", column, field.substr(0, 40)));
  if (!std::isfinite(*number)) throw lines.error(fmt::format("{} is not finite", column));
  return *number;
}

void appendRow(std::string_view text, const LineReader& lines, Trajectory& trajectory) {
  const std::vector<std::string_view> fields = split(text, ',');
  if (fields.size() != kFields) {
    throw lines.error(fmt::format("expected {} fields ({}), found {}", kFields, kTrajectoryHeader, fields.size()));
  }
  const double time = readField(fields[0], "t_s", lines);
  if (!trajectory.time_s.empty() && time <= trajectory.time_s.back()) {
    throw lines.error(fmt::format("time does not increase: {} s after {} s", time, trajectory.time_s.back()));
  }
  trajectory.time_s.push_back(time);
  trajectory.tip_mm.emplace_back(readField(fields[1], "x_mm", lines), readField(fields[2], "y_mm", lines),
                                 readField(fields[3], "z_mm", lines));
}

/// A first line whose first field is no number is a header; it must name these columns, for it also names the units.
bool isHeader(std::string_view text, const LineReader& lines) {
  const std::vector<std::string_view> fields = split(text, ',');
  if (parseNumber(fields[0])) return false;
  if (fields == split(kTrajectoryHeader, ',')) return true;
  throw lines.error(fmt::format("expected the header {} or numbers", kTrajectoryHeader));
}

/// The position at `time`, between row `before` and the next.
Vec3 interpolated(const Trajectory& trajectory, std::size_t before, double time, double tick_s) {
  const std::vector<double>& t = trajectory.time_s;
  if (std::abs(time - t[before]) <= kOnTick * tick_s || before + 1 == t.size()) return trajectory.tip_mm[before];
  if (std::abs(time - t[before + 1]) <= kOnTick * tick_s) return trajectory.tip_mm[before + 1];
  const double share = (time - t[before]) / (t[before + 1] - t[before]);
  return (1.0 - share) * trajectory.tip_mm[before] + share * trajectory.tip_mm[before + 1];
}

}  // namespace

Trajectory readTrajectory(const std::filesystem::path& file) {
  return parseTrajectory(readFile(file, kMaxFileBytes), file.string());
}

Trajectory parseTrajectory(std::string_view text, std::string_view name) {
  LineReader lines{text, name};
  Trajectory trajectory;
  bool first = true;
  for (std::string_view line; lines.next(line);) {
    if (line.empty()) continue;
    if (!first || !isHeader(line, lines)) appendRow(line, lines, trajectory);
    first = false;
  }
  if (trajectory.time_s.empty()) throw Error::inFile(name, "empty trajectory: no rows");
  return trajectory;
}

std::string formatTrajectory(const Trajectory& trajectory) {
  std::string text = fmt::format("{}\n", kTrajectoryHeader);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Vec3& tip = trajectory.tip_mm[i];
    fmt::format_to(std::back_inserter(text), "{:.3f},{:.6f},{:.6f},{:.6f}\n", trajectory.time_s[i], tip.x(), tip.y(),
                   tip.z());
  }
  return text;
}

void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  std::ofstream out(file, std::ios::binary);
  out << formatTrajectory(trajectory);
  out.close();
  if (!out) throw Error::inFile(file.string(), "cannot be written");
}

Trajectory resampled(const Trajectory& trajectory, double tick_s) {
  if (!(tick_s > 0.0)) throw Error("the tick must be longer than 0 s");
  if (trajectory.time_s.empty()) throw Error("a trajectory without rows cannot be resampled");
  const double start = trajectory.time_s.front();
  const double ticks = std::floor((trajectory.time_s.back() - start) / tick_s + kOnTick);
  if (!(ticks < kMaxTicks)) throw Error(fmt::format("a trajectory of {:.3g} ticks is too long", ticks));

  Trajectory result;
  std::size_t before = 0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(ticks); ++k) {
    const double time = start + static_cast<double>(k) * tick_s;
    while (before + 1 < trajectory.size() && trajectory.time_s[before + 1] <= time) ++before;
    result.time_s.push_back(time);
    result.tip_mm.push_back(interpolated(trajectory, before, time, tick_s));
  }
  return result;
}

}  // namespace palpate::device
