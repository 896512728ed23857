// A failing path as a folder: what someone needs to see the fault, and what a test replays for ever after.
//
//   body.ply    the mesh, as it was before repair or reduced, in mm
//   path.csv    the tips, every digit
//   scene.toml  `palpate simulate scene.toml` shows it
//   note.txt    what was seen, and the numbers that a replay needs
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lab/judges/hunt_judge.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

struct KeptCase {
  std::string body;  ///< see FailingPath
  std::uint64_t seed = 0;
  double radius_mm = 0.0;  ///< before the scale
  double scale = 1.0;      ///< of mesh and tips
  Fault fault = Fault::fall;
  Finding finding;  ///< only its numbers are read back
  std::vector<Vec3> tips;
  mesh::TriangleMesh mesh;
};

/// "fall_pocket_r0.5_s123": letters, digits, dots and underscores.
std::string folderNameOf(const KeptCase& kept);

/// Makes the folder. Throws Error naming the file that cannot be written.
void writeCase(const std::filesystem::path& folder, const KeptCase& kept);

/// Where there is no note, the scene's own body and its first finger's radius and trajectory, as somebody else wrote
/// them. Throws Error naming the file that cannot be read or understood.
KeptCase readCase(const std::filesystem::path& folder);

/// A new finger along the case.
HuntReport replay(const KeptCase& kept);

}  // namespace palpate::lab
