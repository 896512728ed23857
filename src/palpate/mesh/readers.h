// One reader a file format, behind `load`. Each takes the whole file in memory and returns units of the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/mesh/load.h"

namespace palpate::mesh {

struct MeshFile {
  std::string_view bytes;
  std::string_view name;  ///< for messages
  const LoadOptions& options;
  const Progress& progress;
  std::filesystem::path folder;  ///< where files lie that this one refers to; empty: there are none
};

TriangleMesh readObj(const MeshFile& file);
TriangleMesh readStl(const MeshFile& file);
TriangleMesh readPly(const MeshFile& file);
TriangleMesh readOff(const MeshFile& file);
TriangleMesh readGltf(const MeshFile& file);
/// `extension` without its dot tells the format.
TriangleMesh readForeign(const MeshFile& file, const std::string& extension);

/// Throws Error when one more triangle would not be nameable: adjacency numbers 3 half-edges a triangle in 32 bits.
void checkTriangleCount(std::size_t triangles, std::string_view name);

}  // namespace palpate::mesh
