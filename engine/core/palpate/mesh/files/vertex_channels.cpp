#include "palpate/mesh/files/vertex_channels.h"

namespace palpate::mesh {

namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& values, const std::vector<Index>& from) {
  std::vector<T> result;
  result.reserve(from.size());
  for (const Index v : from) result.push_back(values[v]);
  return result;
}

}  // namespace

VertexChannels followed(const VertexChannels& channels, const std::vector<Index>& source_vertex) {
  VertexChannels result;
  for (const VertexScalar& scalar : channels.scalars) {
    result.scalars.push_back({scalar.name, picked(scalar.values, source_vertex)});
  }
  if (!channels.colours.empty()) result.colours = picked(channels.colours, source_vertex);
  return result;
}

}  // namespace palpate::mesh
