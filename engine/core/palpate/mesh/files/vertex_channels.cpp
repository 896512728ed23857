#include "palpate/mesh/files/vertex_channels.h"

#include "palpate/mesh/weld.h"

namespace palpate::mesh {

VertexChannels followed(const VertexChannels& channels, const std::vector<Index>& source_vertex) {
  VertexChannels result;
  for (const VertexScalar& scalar : channels.scalars) {
    result.scalars.push_back({scalar.name, picked(scalar.values, source_vertex)});
  }
  if (!channels.colours.empty()) result.colours = picked(channels.colours, source_vertex);
  return result;
}

}  // namespace palpate::mesh
