// A table of key points that grows by one row: the rest of its file stays unchanged.
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
  std::vector<std::string> names = {};  ///< names of its key points
  std::string trouble = {};             ///< why it cannot be read as a table
  bool has(std::string_view name) const;
};
/// Reads what it can; never throws because of the file's contents.
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
