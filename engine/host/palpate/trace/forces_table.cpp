// Columns are taken by their number, so the header must be the writer's word for word: a table of another version is
// refused, not misread.
// Data flow: forces.csv -> here, at load time -> a replay in the window, a plot.
#include "palpate/trace/forces_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::trace {

namespace {

/// An hour of two fingers takes about that much.
constexpr std::size_t kMaxBytes = std::size_t{2} << 30;
// Columns of forcesCsvHeader().
constexpr std::size_t kTime = 0;
constexpr std::size_t kFinger = 1;
constexpr std::size_t kTip = 2;
constexpr std::size_t kAnchor = 8;
constexpr std::size_t kForce = 11;
constexpr std::size_t kDepth = 14;
constexpr std::size_t kState = 15;
constexpr std::size_t kDevice = 17;
constexpr std::size_t kContactStatus = 20;
constexpr std::size_t kSafetyStatus = 21;

/// As far as trajectories reach (device/trajectory.h): places in map coordinates, times since 1970. Larger ones are no
/// record of a touch.
constexpr NumberRange kRecorded{-1e11, 1e11};

Vec3 vectorFrom(const CsvRow& row, std::size_t column, std::string_view name) {
  return {csvNumber(row, column, name, kRecorded), csvNumber(row, column + 1, name, kRecorded),
          csvNumber(row, column + 2, name, kRecorded)};
}

RecordedFinger& fingerNamed(std::vector<RecordedFinger>& fingers, std::string_view name) {
  const auto found = std::find_if(fingers.begin(), fingers.end(), [&](const auto& f) { return f.name == name; });
  if (found != fingers.end()) return *found;
  fingers.push_back({std::string(name), {}, {}, {}});
  return fingers.back();
}

contact::Touch touchFrom(const CsvRow& row) {
  const std::string_view word = row.fields[kState];
  if (word == "free") return contact::Touch::free;
  if (word == "stick") return contact::Touch::stick;
  if (word == "slip") return contact::Touch::slip;
  throw Error::atLine(row.file, row.line,
                      fmt::format("state must be free, stick or slip; got '{}'", word.substr(0, 40)));
}

std::uint32_t bitsFrom(const CsvRow& row, std::size_t column, std::string_view name) {
  constexpr double kMax = 4294967295.0;
  const double bits = csvNumber(row, column, name);
  if (bits >= 0.0 && bits <= kMax && bits == std::floor(bits)) return static_cast<std::uint32_t>(bits);
  throw Error::atLine(row.file, row.line,
                      fmt::format("{} must be a whole number of status bits; got {}", name, row.fields[column]));
}

ForcesRow rowFrom(const CsvRow& row) {
  return {.time_s = csvNumber(row, kTime, "t_s", kRecorded),
          .finger = row.fields[kFinger],
          .tip = vectorFrom(row, kTip, "tip"),
          .anchor = vectorFrom(row, kAnchor, "anchor"),
          .force = vectorFrom(row, kForce, "force"),
          .depth_mm = csvNumber(row, kDepth, "depth_mm", kRecorded),
          .touch = touchFrom(row),
          .device_force = vectorFrom(row, kDevice, "device"),
          .contact_status = bitsFrom(row, kContactStatus, "contact_status"),
          .safety_status = bitsFrom(row, kSafetyStatus, "safety_status")};
}

/// Explains why a first row is not the header of such a table.
[[noreturn]] void failForHeader(const CsvRow& row, std::span<const std::string_view> header) {
  const auto different = std::ranges::mismatch(row.fields, header);
  if (different.in1 == row.fields.begin() || different.in1 == row.fields.end()) {
    throw Error::atLine(row.file, row.line, "must be a table of forces; its columns differ");
  }
  const auto column = different.in1 - row.fields.begin();
  const std::string_view wanted = different.in2 == header.end() ? "nothing" : *different.in2;
  throw Error::atLine(row.file, row.line,
                      fmt::format("must be a table of forces: column {} is '{}'; expected {}", column + 1,
                                  different.in1->substr(0, 40), wanted));
}

/// A table that was cut off ends in the middle of its last row.
void requireWholeRow(const CsvRow& row, std::size_t columns, std::string_view text) {
  if (row.fields.size() == columns) return;
  const auto behind = static_cast<std::size_t>(row.fields.back().end() - text.begin());
  if (row.fields.size() < columns && text.find('\n', behind) == std::string_view::npos) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("the table ends in this row, after {} of {} fields", row.fields.size(), columns));
  }
  throw Error::atLine(row.file, row.line, fmt::format("expected {} fields, found {}", columns, row.fields.size()));
}

void addRow(const ForcesRow& row, std::vector<RecordedFinger>& fingers) {
  RecordedFinger& finger = fingerNamed(fingers, row.finger);
  finger.time_s.push_back(row.time_s);
  finger.tip.push_back(row.tip);
  finger.force.push_back(row.force);
}

}  // namespace

void forEachForcesRow(std::string_view text, std::string_view name,
                      const std::function<void(const ForcesRow&)>& visit) {
  const std::vector<std::string_view> header = split(forcesCsvHeader(), ',');
  std::vector<std::pair<std::string, double>> newest;  // time of each finger
  bool first = true;
  forEachCsvRow(text, name, [&](const CsvRow& fields) {
    if (std::exchange(first, false)) {
      if (!std::ranges::equal(fields.fields, header)) failForHeader(fields, header);
      return;
    }
    requireWholeRow(fields, header.size(), text);
    const ForcesRow row = rowFrom(fields);
    auto of_finger = std::ranges::find(newest, row.finger, &std::pair<std::string, double>::first);
    if (of_finger == newest.end()) {
      newest.emplace_back(row.finger, row.time_s);
    } else if (row.time_s <= of_finger->second) {
      throw Error::atLine(fields.file, fields.line,
                          fmt::format("t_s must increase, but {} s follows {} s", row.time_s, of_finger->second));
    } else {
      of_finger->second = row.time_s;
    }
    visit(row);
  });
  if (newest.empty()) throw Error::inFile(name, "has no rows");
}

void forEachForcesRow(const std::filesystem::path& file, const std::function<void(const ForcesRow&)>& visit) {
  std::string text = readFile(file, kMaxBytes);
  // The last row of an unfinished table may be torn.
  if (isUnfinished(file)) text.resize(text.rfind('\n') + 1);
  forEachForcesRow(text, file.string(), visit);
}

std::vector<RecordedFinger> parseForcesTable(std::string_view text, std::string_view name) {
  std::vector<RecordedFinger> fingers;
  forEachForcesRow(text, name, [&](const ForcesRow& row) { addRow(row, fingers); });
  return fingers;
}

std::vector<RecordedFinger> readForcesTable(const std::filesystem::path& file) {
  std::vector<RecordedFinger> fingers;
  forEachForcesRow(file, [&](const ForcesRow& row) { addRow(row, fingers); });
  return fingers;
}

bool isUnfinished(const std::filesystem::path& file) { return file.extension() == kPartialExtension; }

bool isForcesTable(const std::filesystem::path& file) {
  return file.extension() == ".csv" || (isUnfinished(file) && file.string().find(".csv.") != std::string::npos);
}

}  // namespace palpate::trace
