// Data flow: Scene -> rows of scene_keys.h -> lines, what reads like the default left out, file names made relative ->
// OutputFile. Cold path.
#include "palpate/scene/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

namespace fs = std::filesystem;

/// A shown file name without its quotes; names with escapes stay as they are, which is right too.
std::string nearTo(const fs::path& folder, const std::string& shown) {
  if (folder.empty() || shown.find('\\') != std::string::npos) return shown;
  const fs::path file = pathOf(std::string_view(shown).substr(1, shown.size() - 2));
  const fs::path relative = file.lexically_relative(fs::absolute(folder).lexically_normal());
  const std::string name = relative.generic_string();
  return name.empty() || name.starts_with("..") ? shown : inQuotes(name);
}

bool isDefault(const KeyRow& row, const std::vector<KeyRow>& defaults) {
  const auto same = [&](const KeyRow& other) { return other.table == row.table && other.key == row.key; };
  const auto found = std::find_if(defaults.begin(), defaults.end(), same);
  return found != defaults.end() && found->fallback == row.fallback;
}

}  // namespace

std::string valueIn(const fs::path& folder, const KeyRow& row) {
  return row.takes == kTakesFile && !row.fallback.empty() ? nearTo(folder, row.fallback) : row.fallback;
}

std::string linesOf(const std::vector<KeyRow>& rows, const std::vector<KeyRow>& defaults, const fs::path& folder) {
  std::string lines;
  for (const KeyRow& row : rows) {
    if (row.fallback.empty() || isDefault(row, defaults)) continue;
    lines += fmt::format("{} = {}\n", row.key, valueIn(folder, row));
  }
  return lines;
}

std::string sceneAsToml(const Scene& scene, const fs::path& folder) {
  std::string text = linesOf(topRows(scene), topRows({}), folder);
  for (const Section& section : sections()) {
    const bool repeats = section.title.starts_with("[[");
    for (const std::vector<KeyRow>& rows : section.values(scene)) {
      const std::string lines = linesOf(rows, section.describe(), folder);
      if (repeats || !lines.empty()) text += fmt::format("\n{}\n{}", section.title, lines);
    }
  }
  return text;
}

void save(const Scene& scene, const fs::path& file) {
  OutputFile out(file);
  out.write(sceneAsToml(scene, fs::absolute(file).parent_path()));
  out.commit();
}

}  // namespace palpate::scene
