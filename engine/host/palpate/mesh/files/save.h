// TriangleMesh -> file: OBJ, binary STL, binary PLY with values and colours per vertex.
//
// A file appears complete or not at all: it is written next to its target and then renamed.
#pragma once

#include <filesystem>

#include "palpate/mesh/files/vertex_channels.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Writes by extension: .obj and .ply keep positions exactly (double), .stl rounds them to float. Millimetres. Only
/// .ply has room for channels. Throws Error: unknown extension, an .stl of places farther than a kilometre from the
/// origin, folder missing, disk full, a channel whose size is not the number of vertices.
void save(const std::filesystem::path& file, const TriangleMesh& mesh, const VertexChannels& channels = {});

}  // namespace palpate::mesh
