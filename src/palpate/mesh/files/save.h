// TriangleMesh -> file: OBJ, binary STL, binary PLY with values and colours per vertex.
//
// A file appears complete or not at all: it is written beside its target and then renamed.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// One number per vertex, e.g. {"strain", ...}. The name is one word: it becomes a PLY property.
struct VertexScalar {
  std::string name;
  std::vector<float> values;
};

/// What PLY files carry besides the surface; OBJ and STL cannot and refuse it.
struct VertexChannels {
  std::vector<VertexScalar> scalars;
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< red, green, blue per vertex; empty = none
};

/// Writes by extension: .obj and .ply keep positions exactly (double), .stl rounds them to float. Millimetres.
/// Throws Error: unknown extension, folder missing, disk full, a channel whose size is not the number of vertices.
void save(const std::filesystem::path& file, const TriangleMesh& mesh, const VertexChannels& channels = {});

}  // namespace palpate::mesh
