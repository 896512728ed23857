// All there is in a scene file, in the order of the documentation: the keys before the first table, and the tables.
//
// A table is made of its keys: how it is read, described and written again. The tables themselves are in body_keys.cpp,
// touch_keys.cpp, deformation_keys.cpp, view_keys.cpp and finger_keys.cpp; scene_keys.cpp puts them in order.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/scene/detail/key_table.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// One table of the file.
struct Section {
  std::string name;   ///< "body"
  std::string title;  ///< "[body]", or "[[finger]]" for one that may be repeated
  std::string about;  ///< one sentence for the documentation
  std::function<void(Scene&, const Entry&)> read;
  std::function<std::vector<KeyRow>()> describe;
  /// The keys with the scene's values as in a file, once per table.
  std::function<std::vector<std::vector<KeyRow>>(const Scene&)> values;
};

/// Keys of all tables together. A test holds it to describeKeys(); tools/mass.py reads it here.
inline constexpr std::size_t kSceneKeys = 219;

/// A length that is longer than any body, and short enough that its square keeps all its digits.
inline constexpr double kLongestMm = 1e5;

/// The keys as rows, with the values of `settings`.
template <class S>
std::vector<KeyRow> describe(const std::string& title, const std::vector<Key<S>>& keys, const S& settings = {}) {
  std::vector<KeyRow> rows;
  rows.reserve(keys.size());
  for (const Key<S>& key : keys) {
    rows.push_back({title, key.name, key.takes, key.show(settings), key.meaning, key.form});
  }
  return rows;
}

inline const TomlNode& tableOf(const Entry& entry) {
  if (entry.node.isTable()) return entry.node;
  entry.fail("must be a table");
}

/// A table that occurs once. `check` throws Error for keys that do not go together.
template <class S>
Section section(const std::string& name, const std::string& about, Access<Scene, S> at, std::vector<Key<S>> keys,
                std::function<void(const S&, const Entry&)> check = {}) {
  const std::string title = "[" + name + "]";
  const auto read = [=](Scene& scene, const Entry& entry) {
    readTable(tableOf({entry.node, entry.file, title}), title, entry.file, keys, at(scene));
    if (check) check(at(scene), {entry.node, entry.file, title});
  };
  const auto rows = [=](const Scene& scene) { return describe(title, keys, valueOf<Scene, S>(at, scene)); };
  return {name,
          title,
          about,
          read,
          [=] { return rows({}); },
          [=](const Scene& scene) { return std::vector<std::vector<KeyRow>>{rows(scene)}; }};
}

/// A table that may be repeated.
template <class S>
Section listSection(const std::string& name, const std::string& about, Access<Scene, std::vector<S>> at,
                    std::function<S(const TomlNode&, const Entry&)> read_one, const std::vector<Key<S>>& keys,
                    std::function<std::vector<KeyRow>()> describe_rows) {
  const std::string title = "[[" + name + "]]";
  const auto read = [=](Scene& scene, const Entry& entry) {
    const TomlList* list = entry.node.list();
    if (list == nullptr) Entry{entry.node, entry.file, title}.fail("must be written with two brackets");
    for (const TomlNode& node : *list) {
      const Entry one{node, entry.file, title};
      at(scene).push_back(read_one(tableOf(one), one));
    }
  };
  const auto values = [=](const Scene& scene) {
    std::vector<std::vector<KeyRow>> rows;
    for (const S& one : valueOf<Scene, std::vector<S>>(at, scene)) rows.push_back(describe(title, keys, one));
    return rows;
  };
  return {name, title, about, read, std::move(describe_rows), values};
}

// The tables that a scene file may hold, one function each; a key is completely described there.

// The touched body: body_keys.cpp.
Section bodySection();
Section breathingSection();
Section stiffnessSection();
Section dysfunctionSection();
Section lumpSection();  // lump_keys.cpp
Section ellipsesSection();

// Feel of the body: touch_keys.cpp.
Section frictionSection();
Section contactSection();
Section partitionSection();
Section tissueSection();
Section safetySection();

// Deformation: deformation_keys.cpp.
Section deformationSection();
Section profileSection();
Section strainSection();

// Look of pictures: view_keys.cpp.
Section viewSection();

// Fingers: finger_keys.cpp.
Section fingerSection();
Section deviceSection();

/// `fidelity = "literal"`, or `fidelity.E14 = "literal"` for single errata; fidelity.all comes before the single ones.
/// fidelity_key.cpp.
Key<Scene> fidelityKey();

const std::vector<Key<Scene>>& topKeys();
/// Their rows, with the scene's values.
std::vector<KeyRow> topRows(const Scene& scene);

const std::vector<Section>& sections();

}  // namespace palpate::scene
