// The inputs of `palpate body fit`: a scan in millimetres whatever its unit, and landmarks that the user named on it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/body/fitting/body_fit.h"
#include "palpate/mesh/files/load.h"

namespace palpate::app {

struct ScannedBody {
  mesh::TriangleMesh mesh;         ///< mended, mm
  mesh::VertexChannels channels;   ///< for the mesh's vertices
  double unit_mm = 0;              ///< the file's unit as read; 0: the format's
  double mm_per_unit = 1;          ///< the same as a factor
  std::vector<std::string> notes;  ///< a guessed unit, parts of the file that were passed over
};

/// Without a unit in `options`, and with a size that no body has, a unit that makes it a body's is used, and noted.
/// Throws Error naming the file.
ScannedBody readScan(const std::filesystem::path& file, mesh::LoadOptions options, const Progress& progress);

/// "T6=12,-40,95" in the file's own unit. Throws UsageError for `option`.
body::NamedPoint namedPointFrom(const std::string& option, const std::string& word);

/// Rows name,x,y,z, in the file's own unit; a header is allowed. Throws Error naming file and line.
std::vector<body::NamedPoint> readNamedPoints(const std::filesystem::path& file);

}  // namespace palpate::app
