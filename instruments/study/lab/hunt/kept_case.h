// A failing path as a folder: all that is needed to see the fault, and for a test to replay it.
//
//   body.ply    the mesh, as it was before repair or reduced, in mm
//   path.csv    the tips, every digit
//   scene.toml  `palpate simulate scene.toml` shows it
//   note.txt    the fault, and the numbers that a replay needs
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/hunt/hunt_world.h"
#include "lab/judges/hunt_judge.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

struct KeptCase {
  std::string body;  ///< see FailingPath
  std::uint64_t seed = 0;
  double radius_mm = 0.0;  ///< before the scale
  double scale = 1.0;      ///< applied to mesh and tips
  std::size_t lumps = 0;   ///< under its skin (putLumps); its scene has none of them
  Fault fault = Fault::fall;
  Finding finding;  ///< only its numbers are read back
  std::vector<Vec3> tips;
  mesh::TriangleMesh mesh;
  std::vector<std::string> notes = {};  ///< what the reader of the mesh passed over; not written
};

/// "fall_pocket_r0.5_s123": letters, digits, dots and underscores.
std::string caseFolderName(const KeptCase& kept);

/// Makes the folder. Throws Error naming the file that cannot be written.
void writeCase(const std::filesystem::path& folder, const KeptCase& kept);

/// Without a note, uses the scene's own body and its first finger's radius and trajectory. Throws Error naming the file
/// that cannot be read or understood.
KeptCase readCase(const std::filesystem::path& folder);

/// A new finger along the case.
HuntReport replay(const KeptCase& kept);

// A failing path made short, and its body small: the same fault in as few ticks and triangles as can be found.

/// The tick at which a path first shows the fault that is looked for, or nothing.
using FirstFault = std::function<std::optional<std::size_t>(std::span<const Vec3>)>;

/// Ends at the fault, begins at the latest tick from which it still comes, loses superfluous ticks in between. At most
/// about `most_ticks` ticks are tried. A path without the fault is returned as it is.
std::vector<Vec3> minimised(std::vector<Vec3> tips, const FirstFault& first_fault, std::size_t most_ticks = 400000);

/// The same for a fault of a new finger along the path. No motion gets longer than the longest was, and a finger that
/// is free and outside at the path's start is so at the new one's.
std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault);

struct SmallCase {
  mesh::TriangleMesh mesh;
  std::vector<Vec3> tips;
};

/// The path made short on the body, or on the body with so few triangles as still show a fault of that kind along the
/// path. `mesh` unrepaired; the returned one may be repaired and reduced.
SmallCase minimised(const mesh::TriangleMesh& mesh, const contact::FingerSettings& finger,
                    const std::vector<Vec3>& tips, Fault fault);

}  // namespace palpate::lab
