// Users' mesh files -> TriangleMesh: OBJ, STL (binary and text), PLY, OFF, glTF and GLB.
//
// First step of the load path: load -> validate / repair -> contact, deform. Every reader bounds its memory by the size
// of the file and refuses a malformed one with a single Error that names the file and the place in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/files/vertex_channels.h"
#include "palpate/mesh/textured_mesh.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// `foreign`: any other format of assimp, see LoadOptions::allow_foreign.
enum class Format : std::uint8_t { obj, stl, ply, off, gltf, glb, foreign };

/// Judges by the extension, for formats that are read without assimp: scan.obj, scan.STL, ...
bool isMeshFile(const std::filesystem::path& file);

struct LoadOptions {
  /// Millimetres per unit of the file. 0 = the format's: glTF and GLB are in metres (1000), the others in millimetres
  /// (1).
  double unit_mm = 0.0;
  /// Only the faces of this OBJ group or object (`g`, `o`); empty = all. Unused vertices are left out.
  std::string group = std::string();
  /// Vertices at equal coordinates become one. Unset = what the format needs: OBJ, PLY and OFF share vertices by
  /// themselves and are left alone, all others are welded.
  std::optional<bool> weld = std::nullopt;
  /// Keep triangles that name vertices which do not exist, as they are, instead of refusing the file. For `validate`
  /// and `repair` only: everything else expects indices within range.
  bool keep_wrong_indices = false;
  /// Hand files of other extensions (3mf, dae, fbx, ...) to assimp. Only for files you trust: a hostile one may crash
  /// it.
  bool allow_foreign = false;
  /// Longer files are refused before they are read.
  std::uint64_t max_bytes = std::uint64_t{8} << 30;
};

/// The mesh of a file, polygons cut into triangles, units in millimetre. The format follows the first bytes where they
/// are unmistakable (ply, OFF, glTF), otherwise the extension. Coordinates may be non-finite: `validate` reports them.
/// Throws Error.
TriangleMesh load(const std::filesystem::path& file, const LoadOptions& options = {}, const Progress& progress = {});

/// The same for bytes in memory. `name` replaces the file in messages (and its extension names a foreign format); glTF
/// that refers to other files is refused.
TriangleMesh loadFromMemory(std::string_view bytes, Format format, std::string_view name,
                            const LoadOptions& options = {}, const Progress& progress = {});

/// A surface and the file's further data per vertex.
struct MeshWithChannels {
  TriangleMesh mesh;
  VertexChannels channels;
  /// Sentences on what was passed over or guessed while it was read, each with its place in the file.
  std::vector<std::string> notes = {};
};

/// `load`, with the numbers and colours that a PLY file has for its vertices: colours from red, green, blue (with or
/// without diffuse_ before them), numbers from every other property but places and normals, at most
/// kMaxVertexScalars. Other formats have none. Throws Error.
MeshWithChannels loadWithChannels(const std::filesystem::path& file, const LoadOptions& options = {},
                                  const Progress& progress = {});
MeshWithChannels loadWithChannelsFromMemory(std::string_view bytes, Format format, std::string_view name,
                                            const LoadOptions& options = {}, const Progress& progress = {});

inline constexpr std::size_t kMaxVertexScalars = 64;

// The picture on a surface: a second reading of the same file, for those who draw.

/// The textured triangles of an OBJ (`vt`), glTF or GLB file (TEXCOORD of the base colour); of other files, or of one
/// without any, an empty mesh. Triangles without texture or with unusable corners are left out. `options` as for
/// `load`. Throws Error for a file that is malformed.
TexturedMesh loadTextured(const std::filesystem::path& file, const LoadOptions& options = {},
                          const Progress& progress = {});

/// The same for bytes in memory, as loadFromMemory.
TexturedMesh loadTexturedFromMemory(std::string_view bytes, Format format, std::string_view name,
                                    const LoadOptions& options = {}, const Progress& progress = {});

/// The picture (the bytes of a PNG or JPEG file) of the first triangles with a base colour in a glTF or GLB file; empty
/// when it has none. Throws Error.
std::string basePictureOf(const std::filesystem::path& file);

/// Files next to it or in folders below that a glTF or GLB file needs: buffers and pictures; none for other formats.
/// Throws Error.
std::vector<std::filesystem::path> filesBeside(const std::filesystem::path& file);

}  // namespace palpate::mesh
