// The keys of the table [view] of a scene file.
#pragma once

#include "palpate/scene/key_table.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/view_settings.h"

namespace palpate::scene {

// The keys of the tables [deformation] and [strain] of a scene file; scene_keys.cpp puts them among the others.

std::vector<Key<DeformationSettings>> deformationKeys();

/// Throws Error for keys that do not go together: a file without the profile that reads it, or the other way round.
void checkDeformation(const DeformationSettings& settings, const Entry& entry);

std::vector<Key<StrainSettings>> strainKeys();

// The key `fidelity` of a scene file: a word for all errata, or a table with one entry each.

/// fidelity = "literal", or fidelity.E14 = "literal" for single ones; fidelity.all comes before the single ones.
Key<Scene> fidelityKey();

std::vector<Key<ViewSettings>> viewKeys();

}  // namespace palpate::scene
