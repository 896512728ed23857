// What every command says that reads a mesh file: which file, in which unit, which part of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "palpate/mesh/files/load.h"

namespace palpate::app {

struct MeshArguments {
  std::string file;
  mesh::LoadOptions options;
};

/// Adds MESH, --unit, --group and --foreign. `arguments` must outlive the command.
void addMeshArguments(CLI::App& command, MeshArguments& arguments);

}  // namespace palpate::app
