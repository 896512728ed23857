// Options of every command that reads a mesh file: which file, in which unit, which part of it.
#pragma once

#include <string>

#include "cli/kit/options.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/scene.h"

namespace palpate::app {

struct MeshArguments {
  std::string file;
  mesh::LoadOptions options;
};

/// Adds MESH, --unit, --group and --foreign. `arguments` must outlive the command.
void addMeshArguments(Command& command, MeshArguments& arguments);

// `--unit`: the length of a unit of a mesh file, the same option of every command that reads one.

/// Adds --unit, a word (auto, mm, cm, dm, m, in) or a number of millimetres; 0, which is auto, takes the format's.
/// `unit_mm` must outlive the command.
Option* addUnit(Command& command, double& unit_mm);

/// The unit in a scene's terms: one of its words, or millimetres and a factor.
void useUnit(double unit_mm, scene::BodySettings& body);

/// Adds --preset (scene/presets.h).
void addPresetOption(Command& command, std::string& preset);

}  // namespace palpate::app
