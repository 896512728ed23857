// A table of key points that grows by one row: what stands in its file stays as it is.
//
//   accepted measurement ─ row ─► tableWith ─ writeFile ─► FILE, which [ellipses] key_points reads
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::viewer {

struct KeyTableFile {
  enum class Kind : unsigned char { none, key_points, other };
  Kind kind = Kind::none;
  std::string text = {};
  std::vector<std::string> names = {};  ///< of its key points
  std::string trouble = {};             ///< why it is no such table
  bool has(std::string_view name) const;
};
/// What there is; never throws for what a file holds.
KeyTableFile readKeyTable(const std::filesystem::path& file);

/// Columns by name, and the values of one key point.
struct KeyTableRow {
  std::string header;  ///< without the line's end
  std::string values;
};
/// The text with the row at its end, or in place of the one of that name; in the columns that the text has already.
/// Anything but a table of key points is left out.
std::string tableWith(const KeyTableFile& table, const KeyTableRow& row);

}  // namespace palpate::viewer
