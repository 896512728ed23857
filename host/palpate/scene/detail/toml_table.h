// One table of a TOML file that a person writes, read key by key: what is unknown, of the wrong kind or out of range is
// said with its line. For small files of their own (protocols); scene files have key_table.h.
#pragma once

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"

namespace palpate::scene {

/// What a parser says at most: its message may quote the file, with its ends of line.
inline constexpr std::size_t kLongestParseMessage = 300;

/// `file` is how the text is called in errors. Throws Error with the line where it is no TOML.
inline toml::table parsedToml(std::string_view text, std::string_view file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw Error::atLine(file, error.source().begin.line, oneLine(error.description(), kLongestParseMessage));
  }
}

/// The table and the file's name must outlive it.
class TomlTable {
 public:
  /// Throws Error for a key that is not among these.
  TomlTable(const toml::table& table, std::string_view file, std::string title, const std::vector<std::string>& keys)
      : table_(table), file_(file), title_(std::move(title)) {
    for (const auto& [key, value] : table) {
      if (std::ranges::find(keys, key.str()) != keys.end()) continue;
      fail(value, unknownName("key", key.str(), title_, keys));
    }
  }

  [[noreturn]] void fail(const toml::node& node, const std::string& cause) const {
    throw Error::atLine(file_, node.source().begin.line, cause);
  }
  [[noreturn]] void fail(const std::string& cause) const { fail(table_, cause); }

  // Each leaves the value alone where the key is missing, and throws Error with the line.
  void read(const char* key, std::string& value) const {
    const toml::node* found = table_.get(key);
    if (found == nullptr) return;
    const auto text = found->value_exact<std::string>();
    if (!text) fail(*found, fmt::format("{} takes text", key));
    value = *text;
  }
  void read(const char* key, double& value, const NumberRange& range) const {
    const toml::node* found = table_.get(key);
    if (found == nullptr) return;
    const auto number = found->value<double>();
    if (!found->is_number() || !number) fail(*found, fmt::format("{} takes a number", key));
    if (!range.holds(*number)) {
      fail(*found, fmt::format("{} = {}", key, outOfRange(fmt::format("{:g}", *number), range)));
    }
    value = *number;
  }
  void read(const char* key, int& value, const NumberRange& range) const {
    const toml::node* found = table_.get(key);
    double number = value;
    read(key, number, range);
    if (found != nullptr && !found->is_integer()) fail(*found, fmt::format("{} takes a whole number", key));
    value = static_cast<int>(number);
  }
  void read(const char* key, bool& value) const {
    const toml::node* found = table_.get(key);
    if (found == nullptr) return;
    if (!found->is_boolean()) fail(*found, fmt::format("{} takes true or false", key));
    value = found->value_or(value);
  }
  const toml::node* node(const char* key) const { return table_.get(key); }

 private:
  const toml::table& table_;
  std::string_view file_;
  std::string title_;
};

}  // namespace palpate::scene
