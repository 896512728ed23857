// A value becomes a file of one key and is read by the file's own reader, into a copy of the scene that takes its place
// when all went well. A parse and a copy a change: cold path.
#include "palpate/scene/scene_edit.h"

#include <algorithm>

#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

constexpr std::string_view kHere = "value";

const Section* findSection(std::string_view table) {
  for (const Section& section : sections()) {
    if (section.name == table && !section.title.starts_with("[[")) return &section;
  }
  return nullptr;
}

const Key<Scene>* findTopKey(std::string_view name) {
  const auto found =
      std::find_if(topKeys().begin(), topKeys().end(), [&](const auto& key) { return key.name == name; });
  return found == topKeys().end() ? nullptr : &*found;
}

std::optional<KeyRow> rowNamed(const std::vector<KeyRow>& rows, std::string_view key) {
  for (const KeyRow& row : rows) {
    if (row.key == key) return row;
  }
  return std::nullopt;
}

TomlNode parsed(std::string_view text) {
  try {
    return parseToml(text, kHere);
  } catch (const Error& error) {
    throw Error(oneLine(error.cause()));
  }
}

void addDifferences(const std::string& table, const std::string& which, const std::vector<KeyRow>& was,
                    const std::vector<KeyRow>& is, std::vector<Difference>& found) {
  for (std::size_t i = 0; i < is.size(); ++i) {
    if (was[i].fallback != is[i].fallback) found.push_back({table, which + is[i].key, was[i].fallback, is[i].fallback});
  }
}

}  // namespace

std::vector<Difference> differences(const Scene& was, const Scene& is) {
  std::vector<Difference> found;
  addDifferences("", "", topRows(was), topRows(is), found);
  for (const Section& section : sections()) {
    const auto before = section.values(was);
    const auto now = section.values(is);
    if (before.size() != now.size()) {
      found.push_back({section.name, "", fmt::format("{}", before.size()), fmt::format("{}", now.size())});
      continue;
    }
    const bool repeats = section.title.starts_with("[[");
    for (std::size_t i = 0; i < now.size(); ++i) {
      addDifferences(section.name, repeats ? fmt::format("{} ", i + 1) : "", before[i], now[i], found);
    }
  }
  return found;
}

std::optional<KeyRow> keyOf(const Scene& scene, std::string_view table, std::string_view key) {
  if (table.empty()) return rowNamed(topRows(scene), key);
  const Section* section = findSection(table);
  return section == nullptr ? std::nullopt : rowNamed(section->values(scene).front(), key);
}

std::vector<KeyRow> keysOf(const Scene& scene, std::string_view table) {
  const Section* section = findSection(table);
  return section == nullptr ? std::vector<KeyRow>{} : section->values(scene).front();
}

std::string defaultOf(std::string_view table, std::string_view key) {
  const auto row = keyOf({}, table, key);
  return row ? row->fallback : std::string();
}

void setKey(Scene& scene, std::string_view table, std::string_view key, std::string_view value) {
  Scene changed = scene;
  if (table.empty()) {
    const Key<Scene>* top = findTopKey(key);
    if (top == nullptr) throw Error(fmt::format("unknown key '{}'", key));
    const TomlNode root = parsed(fmt::format("{} = {}", key, value));
    top->read(changed, {*root.get(key), kHere, top->name});
  } else {
    const Section* section = findSection(table);
    if (section == nullptr) throw Error(fmt::format("unknown table [{}]", table));
    const TomlNode root = parsed(fmt::format("[{}]\n{} = {}", table, key, value));
    section->read(changed, {*root.get(table), kHere, section->title});
  }
  scene = std::move(changed);
}

}  // namespace palpate::scene
