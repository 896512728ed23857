// The options of `palpate simulate`, and the scene that results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/kit/options.h"
#include "palpate/scene/scene.h"

namespace palpate::app {

struct SimulateOptions {
  std::string scene;   ///< or a mesh file; empty: the preset, else the default scene, or none when there is a mesh
  std::string preset;  ///< presets.h
  std::string mesh;
  double mesh_unit_mm = 0.0;  ///< 0: as the format says
  double mesh_scale = 1.0;
  std::string mesh_group;
  std::string build;    ///< a word of addShapeOptions, for the trunk; empty: the scene's
  std::string posture;  ///< the same
  std::vector<std::string> trajectories;
  double radius_mm = 0.0;
  bool radius_given = false;
  double seconds = 0.0;            ///< 0: until the last finger has finished
  std::optional<std::string> out;  ///< empty: results_folder.h finds a free name
  bool overwrite = false;
  std::vector<std::string> devices;  ///< for the first fingers, instead of their paths
  bool unsafe_stiffness = false;     ///< addUnsafeStiffness
  bool realtime = false;
  bool recording = false;
  bool pictures = true;
  bool plot = true;
  bool json = false;
  bool needs_fingers = true;  ///< false: a body without fingers will do
};

/// Adds SCENE and what replaces its parts: mesh, trajectories, radius.
void addInputOptions(Command& command, SimulateOptions& options);

/// Adds --build and --posture, which replace the scene's trunk.
void addShapeOptions(Command& command, SimulateOptions& options);

/// Adds --seconds, how long the scene runs.
void addSecondsOption(Command& command, SimulateOptions& options);

/// The scene file (or the built-in one) with the command line's changes: a mesh replaces the body, trajectories replace
/// the fingers' paths in order, further ones add fingers. Throws Error.
scene::Scene sceneFor(const SimulateOptions& given);

}  // namespace palpate::app
