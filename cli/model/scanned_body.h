// What `palpate body fit` is given: a scan in millimetres whatever its unit, and landmarks that somebody named on it.
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
  mesh::VertexChannels channels;   ///< of its vertices
  double unit_mm = 0;              ///< of the file, as it was read; 0: as its format says
  double mm_per_unit = 1;          ///< the same as a factor
  std::vector<std::string> notes;  ///< a unit that was guessed, what was passed over in its file
};

/// Where `options` says no unit and the size is nobody's, a unit that makes it somebody's is taken, and noted. Throws
/// Error naming the file.
ScannedBody readScan(const std::filesystem::path& file, mesh::LoadOptions options, const Progress& progress);

/// "T6=12,-40,95" in the file's own unit. Throws UsageError for `option`.
body::NamedPoint namedPointFrom(const std::string& option, const std::string& word);

/// Rows name,x,y,z, in the file's own unit; a header is allowed. Throws Error naming file and line.
std::vector<body::NamedPoint> readNamedPoints(const std::filesystem::path& file);

}  // namespace palpate::app
