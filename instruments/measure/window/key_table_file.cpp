// Edits line by line, so that comments and order of a user's table stay.
#include "measure/window/key_table_file.h"

#include <algorithm>
#include <map>

#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTableBytes = std::size_t{64} << 20;
/// Columns of a table that does not name them.
constexpr std::string_view kPlainColumns = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg";
constexpr std::size_t kPlainCount = 6;

std::vector<std::string> splitFields(std::string_view line) {
  std::vector<std::string> fields;
  for (const std::string_view field : split(line.substr(0, line.find('#')), ',')) fields.emplace_back(trimmed(field));
  return fields;
}

bool holdsSomething(std::string_view line) { return !trimmed(line.substr(0, line.find('#'))).empty(); }

/// Writes the row in other columns; unknown values stay empty.
std::string inColumns(const KeyTableRow& row, const std::vector<std::string>& columns) {
  const std::vector<std::string> names = splitFields(row.header);
  const std::vector<std::string> values = splitFields(row.values);
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), columns[i]) - names.begin());
    line += (i == 0 ? "" : ",") + (at < values.size() ? values[at] : std::string());
  }
  return line;
}

/// Columns of the first non-empty line.
std::vector<std::string> columnsOfTable(const std::vector<std::string>& lines) {
  const auto first = std::find_if(lines.begin(), lines.end(), holdsSomething);
  if (first == lines.end()) return {};
  std::vector<std::string> columns = splitFields(*first);
  if (columns.front() == "name") return columns;
  std::vector<std::string> plain = splitFields(kPlainColumns);
  if (columns.size() > kPlainCount) plain.emplace_back("stiffness_n_per_mm");
  return plain;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  for (const std::string_view line : split(text, '\n')) lines.emplace_back(line);
  while (!lines.empty() && trimmed(lines.back()).empty()) lines.pop_back();
  return lines;
}

}  // namespace

bool KeyTableFile::has(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

KeyTableFile readKeyTable(const fs::path& file) {
  KeyTableFile table;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return table;
  try {
    table.kind = KeyTableFile::Kind::other;
    table.text = readFile(file, kMaxTableBytes);
    for (const maps::KeyPoint& key : maps::parseKeyPoints(table.text, file.string())) table.names.push_back(key.name);
    table.kind = KeyTableFile::Kind::key_points;
  } catch (const std::exception& error) {
    table.trouble = error.what();
  }
  return table;
}

std::string tableWith(const KeyTableFile& table, const KeyTableRow& row) {
  std::vector<std::string> lines;
  if (table.kind == KeyTableFile::Kind::key_points) lines = linesOf(table.text);
  const std::vector<std::string> columns = columnsOfTable(lines);
  if (columns.empty()) {
    lines.push_back(row.header);
    lines.push_back(row.values);
  } else {
    const std::string name = splitFields(row.values).front();
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
      return holdsSomething(line) && splitFields(line).front() == name;
    });
    if (same == lines.end()) {
      lines.push_back(inColumns(row, columns));
    } else {
      *same = inColumns(row, columns);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace palpate::viewer
