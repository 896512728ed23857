// Facts about a file before it is opened: a small picture, its size, and its probable unit. Any thread; files may be
// hostile, so their length and the time for them are bounded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/scene.h"
#include "palpate/view/image.h"

namespace palpate::viewer {

struct PreviewLimits {
  std::uint64_t max_bytes = std::uint64_t{64} << 20;  ///< longer files have no preview
  double max_seconds = 2.0;                           ///< for reading, then again for drawing
  int width = 168;                                    ///< pixels
  int height = 168;
};

struct FilePreview {
  std::string words;                    ///< "59164 triangles, 430 x 720 x 240 mm", or why the picture is missing
  std::optional<view::Image> picture;   ///< for a mesh, or for the mesh that a scene names
  std::optional<double> longest_units;  ///< for a mesh file without a unit: its longest edge, in units of the file
  std::vector<std::string> notes = {};  ///< for a mesh: lines on what was passed over or guessed while it was read
};

/// Never throws: `words` describes a fault of the file.
FilePreview previewFile(const std::filesystem::path& file, const PreviewLimits& limits = {});

/// Matte, seen from behind and a little from the right and above. Stops at the time limit.
view::Image smallPicture(const mesh::TriangleMesh& mesh, const PreviewLimits& limits = {});

/// Whether the file's extension names a format without units.
bool hasNoUnit(const std::filesystem::path& file);

struct UnitGuess {
  scene::Unit unit;
  std::string words;   ///< "This body is 1.8 across: metres? It would be 1.8 m long."
  std::string answer;  ///< "Metres"
};
/// Empty where millimetres make it a body, or no unit does.
std::optional<UnitGuess> unitGuess(double longest_units);

}  // namespace palpate::viewer
