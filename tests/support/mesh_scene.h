// A scene of a mesh that a test makes.
#pragma once

#include <filesystem>

#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene.h"

namespace palpate::support {

/// The body is this mesh, saved as `file`; everything else is the caller's.
inline scene::Scene meshScene(const std::filesystem::path& file, const mesh::TriangleMesh& mesh,
                              scene::Scene scene = {}) {
  mesh::save(file, mesh);
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = file;
  return scene;
}

}  // namespace palpate::support
