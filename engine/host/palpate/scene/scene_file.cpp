// Text -> TOML tree -> the keys before the first table -> each table by its own reader (scene_keys.h) -> Scene. Faults
// across tables, two fingers or lumps of one name, are checked last. The documentation is made of the same tables.
#include "palpate/scene/scene_file.h"

#include <algorithm>
#include <set>

#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

std::vector<std::string> sectionNames() {
  std::vector<std::string> names;
  for (const Section& section : sections()) names.push_back(section.name);
  return names;
}

void readSections(const TomlNode& root, std::string_view file, Scene& scene) {
  for (const Section& section : sections()) {
    if (const TomlNode* node = root.get(section.name)) section.read(scene, {*node, file, section.title});
  }
}

/// Names unnamed fingers like a hand's, as far as these are free.
void nameFingers(Scene& scene) {
  constexpr std::string_view kOfAHand[] = {"index", "middle", "ring", "little", "thumb"};
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(scene.fingers, [&](const Finger& finger) { return finger.name == name; });
  };
  for (Finger& finger : scene.fingers) {
    for (std::size_t i = 0; finger.name.empty(); ++i) {
      std::string name = i < std::size(kOfAHand) ? std::string(kOfAHand[i]) : fmt::format("finger{}", i + 1);
      if (!is_taken(name)) finger.name = std::move(name);
    }
  }
}

void requireNamesApart(const Scene& scene, std::string_view name) {
  std::set<std::string> names;
  for (const Finger& finger : scene.fingers) {
    if (!names.insert(finger.name).second) {
      throw Error::atLine(name, finger.line,
                          fmt::format("a [[finger]] named '{}' already exists; names must be unique", finger.name));
    }
  }
  names.clear();
  for (const LumpSettings& lump : scene.lumps) {
    if (!lump.name.empty() && !names.insert(lump.name).second) {
      throw Error::atLine(name, lump.line,
                          fmt::format("a [[lump]] named '{}' already exists; names must be unique", lump.name));
    }
  }
}

}  // namespace

Scene parse(std::string_view toml_text, std::string_view name) {
  const TomlNode root = parseToml(toml_text, name);
  Scene scene;
  scene.file = pathOf(name);
  readTable(root, "", name, topKeys(), scene, sectionNames());
  readSections(root, name, scene);
  nameFingers(scene);
  requireNamesApart(scene, name);
  return scene;
}

void requireFingers(const Scene& scene) {
  if (!scene.fingers.empty()) return;
  throw Error::inFile(scene.file.string(), "has no [[finger]]; add at least one");
}

Scene load(const std::filesystem::path& file) {
  if (mesh::isMeshFile(file)) {
    throw Error::inFile(file.string(), "is a mesh, not a scene; name it in a scene with file = \"...\" in [body]");
  }
  return parse(readFile(file, kMaxSceneBytes), file.string());
}

std::vector<KeyRow> describeKeys() {
  std::vector<KeyRow> rows = topRows({});
  for (const Section& section : sections()) {
    for (KeyRow& row : section.describe()) rows.push_back(std::move(row));
  }
  return rows;
}

std::string keysAsMarkdown() {
  std::string text;
  std::string table = "?";
  for (const KeyRow& row : describeKeys()) {
    if (row.table != table) {
      const auto section =
          std::find_if(sections().begin(), sections().end(), [&](const Section& s) { return s.title == row.table; });
      text += fmt::format("\n### {}\n\n", row.table.empty() ? "Before the first table" : "`" + row.table + "`");
      if (section != sections().end()) text += section->about + "\n\n";
      text += "| key | takes | default | meaning |\n|---|---|---|---|\n";
      table = row.table;
    }
    text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.takes,
                        row.fallback.empty() ? "" : "`" + row.fallback + "`", row.meaning);
  }
  return text;
}

}  // namespace palpate::scene
