#include "palpate/scene/detail/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"

namespace palpate::scene {

TomlTable::TomlTable(const TomlNode& table, std::string_view file, std::string title,
                     const std::vector<std::string>& keys)
    : table_(table), file_(file), title_(std::move(title)) {
  for (const auto& [key, place, value] : table.entries()) {
    if (std::ranges::find(keys, key) != keys.end()) continue;
    fail(value, unknownName("key", key, title_, keys));
  }
}

void TomlTable::fail(const TomlNode& node, const std::string& cause) const {
  throw Error::atLine(file_, node.line(), cause);
}

void TomlTable::read(const char* key, std::string& value) const {
  const TomlNode* found = table_.get(key);
  if (found == nullptr) return;
  const auto text = found->text();
  if (!text) fail(*found, fmt::format("{} takes text", key));
  value = *text;
}

void TomlTable::read(const char* key, double& value, const NumberRange& range) const {
  const TomlNode* found = table_.get(key);
  if (found == nullptr) return;
  const auto number = found->number();
  if (!number) fail(*found, fmt::format("{} must be a number", key));
  if (!range.holds(*number)) {
    fail(*found, fmt::format("{} = {}", key, outOfRange(fmt::format("{:g}", *number), range)));
  }
  value = *number;
}

void TomlTable::read(const char* key, int& value, const NumberRange& range) const {
  const TomlNode* found = table_.get(key);
  double number = value;
  read(key, number, range);
  if (found != nullptr && found->kind() != TomlNode::Kind::whole)
    fail(*found, fmt::format("{} must be a whole number", key));
  value = static_cast<int>(number);
}

void TomlTable::read(const char* key, bool& value) const {
  const TomlNode* found = table_.get(key);
  if (found == nullptr) return;
  if (found->kind() != TomlNode::Kind::flag) fail(*found, fmt::format("{} must be true or false", key));
  value = found->flag().value_or(value);
}

}  // namespace palpate::scene
