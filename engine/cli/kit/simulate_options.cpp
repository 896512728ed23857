#include "cli/kit/simulate_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/kit/choice_option.h"
#include "cli/kit/mesh_arguments.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/words.h"

namespace palpate::app {

namespace {

constexpr const char* kAverageBuild = "average";

/// A mesh in place of a scene is palpated directly, as in the window.
SimulateOptions withMeshApart(SimulateOptions options) {
  if (options.scene.empty() || !mesh::isMeshFile(pathOf(options.scene))) return options;
  if (!options.mesh.empty())
    throw Error(fmt::format("{} and --mesh {}: only one body can be given", options.scene, options.mesh));
  options.mesh = std::exchange(options.scene, {});
  return options;
}

scene::Scene startingScene(const SimulateOptions& options) {
  if (!options.preset.empty()) {
    if (!options.scene.empty())
      throw Error(fmt::format("{} and --preset {}: only one scene can be given", options.scene, options.preset));
    return scene::presetScene(options.preset);
  }
  if (!options.scene.empty()) {
    scene::Scene scene = scene::load(pathOf(options.scene));
    if (options.trajectories.empty() && options.needs_fingers) scene::requireFingers(scene);
    return scene;
  }
  if (options.mesh.empty() && options.trajectories.empty()) return scene::standardScene();
  return {};
}

void useMesh(const SimulateOptions& options, scene::Scene& scene) {
  if (options.mesh.empty()) return;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = pathOf(options.mesh);
  scene.body.scale = options.mesh_scale;
  useUnit(options.mesh_unit_mm, scene.body);
  scene.body.group = options.mesh_group;
  scene.body.fit.clear();  // belongs to another mesh
  if (options.scene.empty() && options.preset.empty()) scene.title = scene.body.file.filename().string();
}

/// Average, or the shape of an example of that name; the posture stays.
void useBuild(const std::string& build, body::TrunkShape& shape) {
  const body::Posture posture = shape.posture;
  shape = build == kAverageBuild ? body::TrunkShape{} : scene::presetScene(build).body.shape;
  shape.posture = posture;
}

void useShape(const SimulateOptions& options, scene::BodySettings& body) {
  if (options.build.empty() && options.posture.empty()) return;
  if (body.kind != scene::BodyKind::trunk) {
    throw Error(fmt::format("--build and --posture need the trunk; this body is of kind {}", wordFor(body.kind)));
  }
  if (!options.build.empty()) useBuild(options.build, body.shape);
  if (!options.posture.empty()) body.shape.posture = *valueNamed<body::Posture>(options.posture);
}

void useTrajectories(const SimulateOptions& options, scene::Scene& scene) {
  for (std::size_t i = 0; i < options.trajectories.size(); ++i) {
    if (i == scene.fingers.size()) {
      scene.fingers.emplace_back();
      scene.fingers.back().name = fmt::format("finger_{}", i + 1);
    }
    scene.fingers[i].trajectory = pathOf(options.trajectories[i]);
    scene.fingers[i].steps.clear();
  }
}

/// A body without fingers gets one with an automatic path (device::pathsOf).
void addDefaultFinger(scene::Scene& scene) {
  if (!scene.fingers.empty()) return;
  scene.fingers.emplace_back();
  scene.fingers.back().name = "automatic";
}

}  // namespace

void addInputOptions(Command& command, SimulateOptions& options) {
  command.add_option(
      "SCENE", options.scene,
      "Scene file (TOML, docs/reference/scene-files.md), or a mesh as with --mesh (default: ten seconds on the trunk)");
  addPresetOption(command, options.preset);
  command.add_option("--mesh", options.mesh,
                     "Palpate this mesh (OBJ, STL, PLY, OFF, glTF, GLB) instead of the scene's body");
  addUnit(command, options.mesh_unit_mm);
  addSetting(command, "--mesh-scale", options.mesh_scale, above(0.0, 1e6),
             "Scale factor of the mesh, applied after the unit");
  command.add_option("--group", options.mesh_group, "Use only this group or object of an OBJ file");
  command.add_option("--trajectory", options.trajectories,
                     "Path of a finger: rows of t_s,x_mm,y_mm,z_mm in body coordinates; repeat for each finger");
  addNumber(command, "--radius-mm", options.radius_mm, between(0.0, 1000.0, "mm"),
            "Radius of every finger; 0 is a point, 8 a fingertip");
}

void addShapeOptions(Command& command, SimulateOptions& options) {
  restrictTo({kAverageBuild, "thin", "heavy"},
             command.add_option(
                 "--build", options.build,
                 "Build of the trunk, as in examples/scenes/thin.toml and heavy.toml (default: from the scene)"));
  restrictTo(wordList<body::Posture>(),
             command.add_option("--posture", options.posture,
                                "Posture of the trunk: standing, prone or sitting (default: from the scene)"));
}

void addSecondsOption(Command& command, SimulateOptions& options) {
  addNumber(command, "--seconds", options.seconds, above(0.0, kLongestRunS, "s"),
            "Duration of the run (default: until the last finger has finished)");
}

scene::Scene sceneFor(const SimulateOptions& given) {
  const SimulateOptions options = withMeshApart(given);
  scene::Scene scene = startingScene(options);
  useMesh(options, scene);
  useShape(options, scene.body);
  useTrajectories(options, scene);
  if (options.needs_fingers) addDefaultFinger(scene);
  if (options.seconds > 0.0) scene.seconds = options.seconds;
  scene.safety.unsafe_stiffness = options.unsafe_stiffness;
  if (options.radius_given) {
    for (scene::Finger& finger : scene.fingers) finger.radius_mm = options.radius_mm;
  }
  return scene;
}

}  // namespace palpate::app
