// Single keys of a scene, read and changed by name: how a panel or a tool edits a scene without knowing its structs.
//
// Values are text as in a file, so what a key accepts, its range and its words are those of the scene file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// A key with its present value as `fallback` and what it takes; nothing if there is no such key. `table` is a table's
/// name ("friction"), "" for the keys before the first table; tables that may stand several times are not looked into.
std::optional<KeyRow> keyOf(const Scene& scene, std::string_view table, std::string_view key);

/// All keys of a table with their present values; empty if there is no such table.
std::vector<KeyRow> keysOf(const Scene& scene, std::string_view table);

/// The value when it is left out, as text.
std::string defaultOf(std::string_view table, std::string_view key);

/// Sets it to a value as it would stand in a file ("0.5", "\"depth\"", "true"). Throws Error, the scene unchanged, for
/// a value that the file would not be allowed either.
void setKey(Scene& scene, std::string_view table, std::string_view key, std::string_view value);

/// One key, or a table of those that stand several times, that two scenes have apart.
struct Difference {
  std::string table;  ///< its name: "friction"; "" before the first table
  std::string key;    ///< of tables that stand several times: "2 x_mm", counted from 1; "" if there are more or fewer
  std::string was;    ///< value as it would stand in a file
  std::string is;
};
std::vector<Difference> differences(const Scene& was, const Scene& is);

}  // namespace palpate::scene
