#include "apps/palpate/common/simulate_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "apps/palpate/common/default_scene.h"
#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/words.h"

namespace palpate::app {

namespace {

scene::Unit unitNamed(const std::string& name) {
  if (const auto unit = valueNamed<scene::Unit>(name)) return *unit;
  throw Error(fmt::format("--mesh-unit {}: must be one of {}", name, fmt::join(allWords<scene::Unit>(), ", ")));
}

scene::Scene startingScene(const SimulateOptions& options) {
  if (!options.scene.empty()) {
    scene::Scene scene = scene::load(options.scene);
    if (options.trajectories.empty()) scene::requireFingers(scene);
    return scene;
  }
  if (options.mesh.empty() && options.trajectories.empty()) return scene::parse(defaultScene(), "default.toml");
  return {};
}

void useMesh(const SimulateOptions& options, scene::Scene& scene) {
  if (options.mesh.empty()) return;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = options.mesh;
  scene.body.unit = unitNamed(options.mesh_unit);
  scene.body.scale = options.mesh_scale;
  scene.body.group = options.mesh_group;
  if (options.scene.empty()) scene.title = scene.body.file.filename().string();
}

void useTrajectories(const SimulateOptions& options, scene::Scene& scene) {
  for (std::size_t i = 0; i < options.trajectories.size(); ++i) {
    if (i == scene.fingers.size()) {
      scene.fingers.emplace_back();
      scene.fingers.back().name = fmt::format("finger_{}", i + 1);
    }
    scene.fingers[i].trajectory = options.trajectories[i];
    scene.fingers[i].steps.clear();
  }
}

/// A body without anybody to touch it gets a finger that finds its own way (device::pathsOf).
void useSomeFinger(scene::Scene& scene) {
  if (!scene.fingers.empty()) return;
  scene.fingers.emplace_back();
  scene.fingers.back().name = "automatic";
}

}  // namespace

void addInputOptions(CLI::App& command, SimulateOptions& options) {
  command.add_option("SCENE", options.scene,
                     "Scene file (TOML, docs/scene-files.md); without one: ten seconds on the torso");
  command.add_option("--mesh", options.mesh,
                     "Palpate this mesh (OBJ, STL, PLY, OFF, glTF, GLB) instead of the scene's body");
  command.add_option("--mesh-unit", options.mesh_unit, "Unit of the mesh file: auto, mm, cm, dm, m, in")
      ->capture_default_str();
  command.add_option("--mesh-scale", options.mesh_scale, "Factor on the mesh's size, after the unit")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--mesh-group", options.mesh_group, "Only this group or object of an OBJ file");
  command.add_option("--trajectory", options.trajectories,
                     "Path of a finger, rows of t_s,x_mm,y_mm,z_mm in the body's coordinates; once for each finger");
  command.add_option("--radius-mm", options.radius_mm, "Radius of every finger, mm; 0 is a point, 8 a fingertip")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seconds", options.seconds, "How long to run, s; default: until the last finger has finished")
      ->check(CLI::PositiveNumber);
}

scene::Scene sceneFor(const SimulateOptions& options) {
  scene::Scene scene = startingScene(options);
  useMesh(options, scene);
  useTrajectories(options, scene);
  useSomeFinger(scene);
  if (options.seconds > 0.0) scene.seconds = options.seconds;
  if (options.radius_given) {
    for (scene::Finger& finger : scene.fingers) finger.radius_mm = options.radius_mm;
  }
  return scene;
}

}  // namespace palpate::app
