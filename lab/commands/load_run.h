// From a mesh file to the first force: the numbers of `palpate study bench load`.
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
  double change_ms = 0.0;                   ///< until the world has another dysfunction; the median of some
};

/// Throws Error as scene::build does, and for a body that cannot be felt anywhere.
LoadFigures measureLoad(const std::filesystem::path& file, const Progress& progress);

/// How long assimp alone takes to read the file, not welded, into the same arrays, s. Throws Error where it cannot.
double assimpSeconds(const std::filesystem::path& file);

/// The most memory this process ever had resident, 1e9 bytes; 0 where the system does not say.
double peakMemoryGb();

}  // namespace palpate::app
