#include "apps/palpate/common/mesh_arguments.h"

namespace palpate::app {

void addMeshArguments(CLI::App& command, MeshArguments& arguments) {
  command.add_option("mesh", arguments.file, "Mesh file: obj, stl, ply, off, gltf or glb")->required();
  command
      .add_option("--unit-mm", arguments.options.unit_mm,
                  "Millimetres per unit of the file; 0: 1000 for gltf and glb (metres), 1 for the others")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  command.add_option("--group", arguments.options.group, "Only this group or object of an OBJ file");
  command.add_flag("--foreign", arguments.options.allow_foreign,
                   "Read other formats (3mf, dae, fbx, ...) through assimp; only for files you trust");
}

}  // namespace palpate::app
