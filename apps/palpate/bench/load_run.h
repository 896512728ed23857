// From a mesh file to the first force: the numbers of `palpate bench load`.
//
// file -> scene::build (read and weld, repair, order, contact surface, deformation) -> one finger that presses.
// Exactly what a user waits for between naming a file and feeling it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/progress.h"

namespace palpate::app {

// A mesh file for a command that must start from one: the file itself, or a benchmark mesh written for the occasion.

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

struct LoadStep {
  std::string name;             ///< as the progress line calls it
  double seconds = 0.0;         ///< all stretches of that name together
  double peak_memory_gb = 0.0;  ///< of the process since its start, when the step ended
};

struct LoadFigures {
  double seconds = 0.0;         ///< file to force
  double peak_memory_gb = 0.0;  ///< of the process, 1e9 bytes; what was loaded before counts too
  std::vector<LoadStep> steps;
  std::size_t triangles = 0;  ///< of the skin that is felt, after repair
  std::size_t vertices = 0;
  double first_force_n = 0.0;
  double tree_bytes_per_triangle = 0.0;     ///< tree and walk records
  double tree_build_ns_per_triangle = 0.0;  ///< the same, built once more by itself
  std::uint64_t hash = 0;                   ///< of skin and first force
};

/// Throws Error as scene::build does, and for a body that cannot be felt anywhere.
LoadFigures measureLoad(const std::filesystem::path& file, const Progress& progress);

/// How long assimp alone takes to read the file, not welded, into the same arrays, s. Throws Error where it cannot.
double assimpSeconds(const std::filesystem::path& file);

/// The most memory this process ever had resident, 1e9 bytes; 0 where the system does not say.
double peakMemoryGb();

}  // namespace palpate::app
