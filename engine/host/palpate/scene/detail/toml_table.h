// One table of a TOML file that a person writes, read key by key: keys that are unknown, of the wrong kind or out of
// range are reported with their line. For small files of their own (protocols); scene files have key_table.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/number_range.h"
#include "palpate/scene/detail/toml_node.h"

namespace palpate::scene {

/// The table and the file's name must outlive it.
class TomlTable {
 public:
  /// Throws Error for a key that is not among these.
  TomlTable(const TomlNode& table, std::string_view file, std::string title, const std::vector<std::string>& keys);

  [[noreturn]] void fail(const TomlNode& node, const std::string& cause) const;
  [[noreturn]] void fail(const std::string& cause) const { fail(table_, cause); }

  // Each leaves the value alone where the key is missing, and throws Error with the line.
  void read(const char* key, std::string& value) const;
  void read(const char* key, double& value, const NumberRange& range) const;
  void read(const char* key, int& value, const NumberRange& range) const;
  void read(const char* key, bool& value) const;
  const TomlNode* node(const char* key) const { return table_.get(key); }

 private:
  const TomlNode& table_;
  std::string_view file_;
  std::string title_;
};

}  // namespace palpate::scene
