// Single keys of a scene, read and changed by name: how a panel or a tool edits a scene without knowing its structs.
//
// Values are text as in a file, so a key's type, range and words are those of the scene file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// A key with its present value as `fallback` and its range; nothing if unknown. `table` is a table's name
/// ("friction"), "" for the keys before the first table; repeatable tables are not searched.
std::optional<KeyRow> keyOf(const Scene& scene, std::string_view table, std::string_view key);

/// All keys of a table with their present values; empty if unknown.
std::vector<KeyRow> keysOf(const Scene& scene, std::string_view table);

/// The value when it is left out, as text.
std::string defaultOf(std::string_view table, std::string_view key);

/// Sets it to a value as in a file ("0.5", "\"depth\"", "true"). Throws Error, the scene unchanged, for a value that
/// the file would not be allowed either.
void setKey(Scene& scene, std::string_view table, std::string_view key, std::string_view value);

/// One key, or a repeatable table, in which two scenes differ.
struct Difference {
  std::string table;  ///< its name: "friction"; "" before the first table
  std::string key;    ///< in repeatable tables: "2 x_mm", counted from 1; "" if there are more or fewer
  std::string was;    ///< value as in a file
  std::string is;
};
std::vector<Difference> differences(const Scene& was, const Scene& is);

}  // namespace palpate::scene
