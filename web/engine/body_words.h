// A body in words, for the page: its name, what was mended, and what its places are called.
#pragma once

#include <string>

#include "palpate/scene/world.h"

namespace palpate::web {

/// JSON: name, closed, bones (their number), notes, landmarks ({name, at: [x, y, z], normal: [x, y, z]}, as an examiner
/// says them).
std::string bodyInWords(const scene::World& world);

}  // namespace palpate::web
