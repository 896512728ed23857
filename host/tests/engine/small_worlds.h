// Worlds that are built in milliseconds, for tests of the engine.
#pragma once

#include <memory>
#include <string>

#include "palpate/mesh/files/save.h"
#include "palpate/scene/world.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::engine {

/// A flat sheet z = 0, 200 mm wide, facing +z, of one stiffness; what else the scene says is the caller's.
inline std::shared_ptr<const scene::World> sheet(double stiffness_n_per_mm, scene::Scene scene = {}, int cells = 20) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "sheet.ply", zoo::grid(cells, 200.0));
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = folder / "sheet.ply";
  scene.stiffness.constant_n_per_mm = stiffness_n_per_mm;
  return scene::build(scene);
}

/// The middle of the sheet, so deep below it.
inline Vec3 under(double depth_mm) { return {103.0, 101.0, -depth_mm}; }

}  // namespace palpate::engine
