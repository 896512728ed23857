// Reads a scene file (TOML). docs/reference/scene-files.md explains it; `palpate simulate --keys` lists every key.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Bytes of the largest scene file that is read.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20;

/// Throws Error: file:line for text that is not TOML, an unknown key (naming the nearest known one), a value of the
/// wrong type or out of range, a missing value; the file's name for one that cannot be read. Files that the scene names
/// are relative to its folder and are not opened yet.
Scene load(const std::filesystem::path& file);

/// The same from text; messages call the file `name`, and its folder is that of relative names.
Scene parse(std::string_view toml, std::string_view name);

/// Throws Error for a scene without fingers: a world can be built from it, a run needs one.
void requireFingers(const Scene& scene);

/// Type and range of a key, for programs that offer it to be changed.
struct KeyForm {
  enum class Kind : std::uint8_t { other, number, whole, flag, choice, text, file };
  Kind kind = Kind::other;
  double low = -std::numeric_limits<double>::infinity();  ///< number, whole
  double high = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};
};

/// One key of the format, as a row of the documentation.
struct KeyRow {
  std::string table;  ///< "" for keys before the first table, else its header, e.g. "[body]"
  std::string key;
  std::string takes;     ///< type and range in words
  std::string fallback;  ///< the value when it is left out; empty = none
  std::string meaning;
  KeyForm form = {};
};
std::vector<KeyRow> describeKeys();

/// describeKeys as Markdown tables: `palpate simulate --keys`.
std::string keysAsMarkdown();

}  // namespace palpate::scene
