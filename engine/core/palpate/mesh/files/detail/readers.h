// One reader per file format, behind `load`. Each gets the whole file in memory and returns units of the file.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/passed_over.h"
#include "palpate/mesh/files/load.h"

namespace palpate::mesh {

struct MeshFile {
  std::string_view bytes;
  std::string_view name;  ///< for messages
  const LoadOptions& options;
  const Progress& progress;
  std::filesystem::path folder;  ///< folder of the files that it refers to; empty: none
  PassedOver& passed_over;       ///< receives what a reader leaves out
};

/// Given `places`, the readers of formats with texture note a place in the picture for each vertex, or NaN; the mesh
/// then shares no vertex where the texture is discontinuous.
using TexturePlaces = std::vector<TexturePlace>;

TriangleMesh readObj(const MeshFile& file, TexturePlaces* places = nullptr);
TriangleMesh readStl(const MeshFile& file);
/// Asked for `channels`, it notes numbers and colours, a vertex of the mesh each.
TriangleMesh readPly(const MeshFile& file, VertexChannels* channels = nullptr);
TriangleMesh readOff(const MeshFile& file);
/// True for at least every file that the format's reader accepts.
bool beginsAsOff(std::string_view bytes);
bool beginsAsPly(std::string_view bytes);
TriangleMesh readGltf(const MeshFile& file, TexturePlaces* places = nullptr);
/// Reads every other format, by `extension` without its dot. Throws Error where no host has installed a reader.
TriangleMesh readForeign(const MeshFile& file, const std::string& extension);
using ForeignReader = TriangleMesh (*)(const MeshFile& file, const std::string& extension);
/// Before any file is read.
void useForeignReader(ForeignReader reader);

/// No texture here.
inline TexturePlace noTexturePlace() { return TexturePlace::Constant(std::numeric_limits<float>::quiet_NaN()); }

/// The format of a file by its first bytes, else by its extension. Throws Error when it cannot be read.
Format detectFormat(const std::filesystem::path& file, std::string_view bytes, bool allow_foreign);
/// Reads the file and calls use(MeshFile, Format); both live only during the call. Throws Error.
template <class Use>
auto withMeshFile(const std::filesystem::path& file, const LoadOptions& options, const Progress& progress,
                  const Use& use) {
  const std::string bytes = readFile(file, options.max_bytes);
  const std::string name = file.string();
  PassedOver passed_over;
  return use(MeshFile{bytes, name, options, progress, file.parent_path() / ".", passed_over},
             detectFormat(file, bytes, options.allow_foreign));
}
/// Moves a mesh from the units of its file to mm (LoadOptions::unit_mm).
void toMillimetres(TriangleMesh& mesh, Format format, double unit_mm);

/// Throws Error when one more triangle would not be nameable: adjacency numbers 3 half-edges a triangle in 32 bits.
void checkTriangleCount(std::size_t triangles, std::string_view name);

}  // namespace palpate::mesh
