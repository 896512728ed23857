// Worlds that are built in milliseconds, for tests of the engine.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "palpate/scene/world.h"
#include "support/mesh_scene.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::engine {

/// A flat sheet z = 0, 200 mm wide, facing +z, of one stiffness; what else the scene says is the caller's.
inline std::shared_ptr<const scene::World> sheet(double stiffness_n_per_mm, const scene::Scene& scene = {},
                                                 int cells = 20) {
  const support::TemporaryFolder folder;
  scene::Scene sheet = support::meshScene(folder / "sheet.ply", zoo::grid(cells, 200.0), scene);
  sheet.stiffness.constant_n_per_mm = stiffness_n_per_mm;
  return scene::build(sheet);
}

/// A file of its own, `sheet.ply` beside it, and two fingers: the left a point, the right a fingertip.
inline scene::Scene sheetOfTwo(const support::TemporaryFolder& folder) {
  scene::Scene scene = support::meshScene(folder / "sheet.ply", zoo::grid(20, 200.0));
  scene.file = folder / "scene.toml";
  scene.fingers.resize(2);
  scene.fingers[0].name = "left";
  scene.fingers[1].name = "right";
  scene.fingers[1].radius_mm = 8.0;
  return scene;
}

/// A path that slides round the middle of the sheet, `middle_mm` over it, and presses now and then.
inline Vec3 slidingTip(double t_s, double middle_mm) {
  return {100.0 + 30.0 * std::sin(3.0 * t_s), 100.0 + 20.0 * std::cos(2.0 * t_s),
          middle_mm + 7.0 * std::sin(9.0 * t_s)};
}

/// The middle of the sheet, so deep below it.
inline Vec3 under(double depth_mm) { return {103.0, 101.0, -depth_mm}; }

}  // namespace palpate::engine
