// The key `fidelity` of a scene file: a word for all errata, or a table with one entry each.
#pragma once

#include "palpate/scene/key_table.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// fidelity = "literal", or fidelity.E14 = "literal" for single ones; fidelity.all comes before the single ones.
Key<Scene> fidelityKey();

}  // namespace palpate::scene
