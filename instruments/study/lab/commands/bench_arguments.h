// Common arguments of benchmark commands: a mesh or a trajectory by file or by name, for any surface, also without a
// file at hand; and the kind of partition.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/kit/choice_option.h"
#include "cli/kit/options.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/progress.h"
#include "palpate/device/trajectory.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/words.h"

namespace palpate::app {

/// For help texts: what `meshFrom` takes.
inline constexpr const char* kMeshNamesHelp =
    "Mesh file (obj, stl, ply, off, gltf, glb), torso or torso_N for the built-in body of N triangles, or the name of "
    "a benchmark mesh (palpate study bench list)";

/// A file of that name exists, or the name has a dot in it.
bool isMeshFile(const std::string& name);

/// The file; else the built-in body or a benchmark mesh. Throws Error.
mesh::TriangleMesh meshFrom(const std::string& name, const mesh::LoadOptions& options = {},
                            const Progress& progress = {});

/// A mesh file for a command that must start from one: the file itself, or a benchmark mesh written for the occasion.
class WrittenMesh {
 public:
  /// For a name (see meshFrom) the mesh is made and written as binary STL into a temporary folder of its own, by a
  /// child process: neither its time nor its memory are this process's. It goes with the object. Throws Error.
  explicit WrittenMesh(const std::string& file_or_name);

  const std::filesystem::path& file() const { return file_; }

 private:
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path file_;
};

/// A CSV file if one of that name exists or the name ends in .csv; else a benchmark's trajectory. Throws Error.
device::Trajectory trajectoryFrom(const std::string& name);

/// Adds --tree, --assign, --threshold and --leaf-rule. `settings` must outlive the command.
void addPartitionSettings(Command& command, hdb::BuildSettings& settings);

}  // namespace palpate::app
