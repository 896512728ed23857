// Data flow: Scene -> rows of scene_keys.h -> lines (key_lines.h), file names made relative -> OutputFile. Cold path.
// Own.
#include "palpate/scene/scene_writer.h"

#include "palpate/base/output_file.h"
#include "palpate/scene/key_lines.h"
#include "palpate/scene/scene_keys.h"

namespace palpate::scene {

namespace fs = std::filesystem;

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
