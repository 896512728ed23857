// The tables of a scene file: which keys each holds. Everything there is to say about a key is said in scene_keys.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/scene/key_table.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// One table of the file.
struct Section {
  std::string name;   ///< "body"
  std::string title;  ///< "[body]", or "[[finger]]" for one that may stand several times
  std::string about;  ///< one sentence for the documentation
  std::function<void(Scene&, const Entry&)> read;
  std::function<std::vector<KeyRow>()> describe;
  /// The keys with the scene's values as they would stand in a file, once for each time the table stands there.
  std::function<std::vector<std::vector<KeyRow>>(const Scene&)> values;
};

/// Keys before the first table.
const std::vector<Key<Scene>>& topKeys();

/// In the order of the documentation.
const std::vector<Section>& sections();

}  // namespace palpate::scene
