// Bodies for the page: from the text of a scene, or from the bytes of somebody's mesh file.
#pragma once

#include <memory>
#include <string_view>

#include "palpate/scene/world.h"

namespace palpate::web {

/// More triangles than a page can hold with its maps and trees in 2 GB.
inline constexpr std::size_t kMostTriangles = 2'000'000;

/// Throws Error as scene::parse and scene::build do; files that the text names are not there.
std::shared_ptr<const scene::World> openScene(std::string_view toml);

/// A mesh of the format that the name's extension says (stl, obj, ply, off, gltf, glb), under the settings of a scene
/// without body. `unit_mm`: millimetres of its unit, 0: as the format says. Throws Error in one line for whatever is
/// wrong with it.
std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm,
                                             std::string_view toml);

}  // namespace palpate::web
