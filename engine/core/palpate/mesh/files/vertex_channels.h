// Optional data of a mesh file for each vertex besides its place: numbers and a colour. Only PLY files have them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::mesh {

/// One number per vertex, e.g. {"strain", ...}. The name is one word: it is a PLY property.
struct VertexScalar {
  std::string name;
  std::vector<float> values;
};

/// One number per polygon of a file. Surfaces have numbers per vertex only: just its range is kept.
struct FaceScalar {
  std::string name;
  double least = 0.0;
  double most = 0.0;
};

struct VertexChannels {
  std::vector<VertexScalar> scalars;
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< red, green, blue per vertex (sRGB); empty = none
  std::vector<FaceScalar> of_faces = {};             ///< reported, not used

  bool empty() const { return scalars.empty() && colours.empty(); }
};

/// The channels of a mesh whose vertex v was `source_vertex[v]` before: repaired, welded, reordered.
VertexChannels followed(const VertexChannels& channels, const std::vector<Index>& source_vertex);

}  // namespace palpate::mesh
