// The keys of the table [view] of a scene file.
#pragma once

#include "palpate/scene/key_table.h"
#include "palpate/scene/view_settings.h"

namespace palpate::scene {

std::vector<Key<ViewSettings>> viewKeys();

}  // namespace palpate::scene
