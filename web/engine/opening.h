// Bodies for the page: the built-in torso, or from the bytes of somebody's mesh file. Settings are the scene file's
// defaults; its reader and writer stay out of the page, of which they would be a third.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "palpate/scene/world.h"

namespace palpate::web {

/// More triangles than a page can hold with its maps and trees in 2 GB.
inline constexpr std::size_t kMostTriangles = 2'000'000;

/// The built-in torso of so many triangles, skin and bones together. Throws Error for a number that it cannot have.
std::shared_ptr<const scene::World> openTorso(std::size_t triangles);

/// A mesh of the format that the name's extension says (stl, obj, ply, off, gltf, glb). `unit_mm`: millimetres of its
/// unit, 0: as the format says. Throws Error in one line for whatever is wrong with it.
std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm);

/// The scene file for what was opened, so that it can be looked at again elsewhere: body and dysfunctions. Of a mesh
/// the name and the unit, as they were given to openMesh.
std::string sceneText(const scene::Scene& scene);

}  // namespace palpate::web
