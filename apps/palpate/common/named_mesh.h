// A mesh or a trajectory by file or by name: what a command takes that works on any surface, also without a file at
// hand.
#pragma once

#include <filesystem>
#include <string>

#include "palpate/base/progress.h"
#include "palpate/device/trajectory.h"
#include "palpate/mesh/files/load.h"

namespace palpate::app {

/// For help texts: what `meshFrom` takes.
inline constexpr const char* kMeshNamesHelp =
    "Mesh file (obj, stl, ply, off, gltf, glb), torso or torso_N for the built-in body of N triangles, or the name of "
    "a benchmark mesh (palpate bench list)";

/// A file of that name exists, or the name has a dot in it.
bool isMeshFile(const std::string& name);

/// The file; else the built-in body or a benchmark mesh. Throws Error.
mesh::TriangleMesh meshFrom(const std::string& name, const mesh::LoadOptions& options = {},
                            const Progress& progress = {});

/// A mesh file for a command that must start from one: the file itself, or a benchmark mesh written for the occasion.
class WrittenMesh {
 public:
  /// For a name (see meshFrom) the mesh is made and written as binary STL into the folder for temporary files, by a
  /// child process: neither its time nor its memory are this process's. Throws Error.
  explicit WrittenMesh(const std::string& file_or_name);
  /// Removes what was written.
  ~WrittenMesh();
  WrittenMesh(const WrittenMesh&) = delete;
  WrittenMesh& operator=(const WrittenMesh&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  bool written_ = false;
};

/// A CSV file if one of that name exists or the name ends in .csv; else a benchmark's trajectory. Throws Error.
device::Trajectory trajectoryFrom(const std::string& name);

}  // namespace palpate::app
