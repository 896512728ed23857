// A body described for the page: its name, its repairs, and the names of its places.
//
// Written by hand: a page of JSON does not warrant a library.
#pragma once

#include <string>
#include <vector>

#include "palpate/scene/world.h"

namespace palpate::web {

/// JSON: [{name, at: [x, y, z], normal: [x, y, z]}], in an examiner's terms.
std::string landmarksJson(const std::vector<body::SkinLandmark>& landmarks);

/// JSON: name, closed, bones (their number), notes, landmarks.
std::string bodyJson(const scene::World& world);

}  // namespace palpate::web
