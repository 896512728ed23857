// All there is in a scene file, in the order of the documentation: the keys before the first table, and the tables.
#pragma once

#include <vector>

#include "palpate/scene/keys/key_section.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

const std::vector<Key<Scene>>& topKeys();
/// Their rows, with the scene's values.
std::vector<KeyRow> topRows(const Scene& scene);

const std::vector<Section>& sections();

}  // namespace palpate::scene
