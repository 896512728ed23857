// toml++ parses; its tree is copied into ours.
#include "palpate/scene/detail/toml_node.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/scene/detail/toml_limits.h"

namespace palpate::scene {

namespace {

TomlPlace placeFrom(const toml::source_position& place) {
  return {static_cast<std::uint32_t>(place.line), static_cast<std::uint32_t>(place.column)};
}

TomlNode::Kind kindFrom(toml::node_type type) {
  switch (type) {
    case toml::node_type::string:
      return TomlNode::Kind::text;
    case toml::node_type::boolean:
      return TomlNode::Kind::flag;
    case toml::node_type::integer:
      return TomlNode::Kind::whole;
    case toml::node_type::floating_point:
      return TomlNode::Kind::fraction;
    case toml::node_type::array:
      return TomlNode::Kind::list;
    case toml::node_type::table:
      return TomlNode::Kind::table;
    default:
      return TomlNode::Kind::date;
  }
}

}  // namespace

struct TomlReader {
  static TomlNode node(const toml::node& from) {
    TomlNode made(kindFrom(from.type()), placeFrom(from.source().begin), placeFrom(from.source().end));
    if (const toml::table* table = from.as_table()) {
      made.is_inline_ = table->is_inline();
      made.entries_.reserve(table->size());
      for (const auto& [key, value] : *table) {
        made.entries_.push_back({std::string(key.str()), placeFrom(key.source().begin), node(value)});
      }
    } else if (const toml::array* list = from.as_array()) {
      made.items_.reserve(list->size());
      for (const toml::node& value : *list) made.items_.push_back(node(value));
    } else if (const auto* text = from.as_string()) {
      made.value_ = text->get();
    } else if (const auto* flag = from.as_boolean()) {
      made.value_ = flag->get();
    } else if (const auto* whole = from.as_integer()) {
      made.value_ = whole->get();
    } else if (const auto* fraction = from.as_floating_point()) {
      made.value_ = fraction->get();
    }
    return made;
  }
};

bool TomlNode::isListOfTables() const {
  return kind_ == Kind::list && !items_.empty() && std::ranges::all_of(items_, &TomlNode::isTable);
}

std::optional<std::string> TomlNode::text() const {
  const auto* text = std::get_if<std::string>(&value_);
  return text == nullptr ? std::nullopt : std::optional(*text);
}

std::optional<double> TomlNode::number() const {
  if (const auto* fraction = std::get_if<double>(&value_)) return *fraction;
  const auto* whole = std::get_if<std::int64_t>(&value_);
  constexpr std::int64_t kExact = std::int64_t{1} << std::numeric_limits<double>::digits;
  if (whole == nullptr || *whole < -kExact || *whole > kExact) return std::nullopt;
  return static_cast<double>(*whole);
}

std::optional<std::int64_t> TomlNode::whole() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return *whole;
  if (const auto* flag = std::get_if<bool>(&value_)) return *flag ? 1 : 0;
  constexpr double kBeyond = 9223372036854775808.0;  // 2^63
  const auto* fraction = std::get_if<double>(&value_);
  const bool fits =
      fraction != nullptr && *fraction >= -kBeyond && *fraction < kBeyond && std::trunc(*fraction) == *fraction;
  return fits ? std::optional(static_cast<std::int64_t>(*fraction)) : std::nullopt;
}

std::optional<bool> TomlNode::flag() const {
  if (const auto* flag = std::get_if<bool>(&value_)) return *flag;
  const auto* whole = std::get_if<std::int64_t>(&value_);
  return whole == nullptr ? std::nullopt : std::optional(*whole != 0);
}

const TomlNode* TomlNode::get(std::string_view key) const {
  const auto found =
      std::ranges::lower_bound(entries_, key, {}, [](const TomlEntry& entry) -> std::string_view { return entry.key; });
  return found == entries_.end() || found->key != key ? nullptr : &found->node;
}

TomlNode parseToml(std::string_view text, std::string_view file) {
  requireBoundedToml(text, file);
  try {
    return TomlReader::node(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw Error::atLine(file, error.source().begin.line, oneLine(error.description(), kMaxParseMessage));
  }
}

}  // namespace palpate::scene
