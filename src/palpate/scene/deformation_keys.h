// The keys of the tables [deformation] and [strain] of a scene file; scene_keys.cpp puts them among the others.
#pragma once

#include "palpate/scene/key_table.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

std::vector<Key<DeformationSettings>> deformationKeys();

/// Throws Error for keys that do not go together: a file without the profile that reads it, or the other way round.
void checkDeformation(const DeformationSettings& settings, const Entry& entry);

std::vector<Key<StrainSettings>> strainKeys();

}  // namespace palpate::scene
