#include "cli/kit/mesh_arguments.h"

#include "cli/kit/unit_option.h"

namespace palpate::app {

void addMeshArguments(CLI::App& command, MeshArguments& arguments) {
  command.add_option("mesh", arguments.file, "Mesh file: obj, stl, ply, off, gltf or glb")->required();
  addUnit(command, arguments.options.unit_mm);
  command.add_option("--group", arguments.options.group, "Only this group or object of an OBJ file");
  command.add_flag("--foreign", arguments.options.allow_foreign,
                   "Read other formats (3mf, dae, fbx, ...) through assimp; only for files you trust");
}

}  // namespace palpate::app
