// Bodies for the page: the trunk that was made ahead (palpate/scene/ready_body.h), or from the bytes of a user's mesh
// file. Settings are the scene file's defaults; its reader and writer stay out of the page, of which they would be a
// third.
//
// A user's file goes through the reader for bytes in memory and through mending, as any scene's does; its length and
// size are bounded here, because a page cannot be made to wait.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "palpate/scene/ready_body.h"
#include "palpate/scene/world.h"

namespace palpate::web {

/// The trunk that was made ahead.
std::shared_ptr<const scene::World> openReady(scene::ReadyBody ready);

/// A mesh in the format of the name's extension (stl, obj, ply, off, gltf, glb). `unit_mm`: millimetres of its unit, 0:
/// the format's. Throws Error in one line for any fault of it.
std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm);

/// The scene file for the opened body, so that it can be viewed again elsewhere: body, dysfunctions and lumps. For a
/// mesh, name and unit as given to openMesh.
std::string sceneText(const scene::Scene& scene);

}  // namespace palpate::web
