#include "palpate/deform/skin.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/deform/block_bounds.h"
#include "palpate/deform/normals.h"

namespace palpate::deform {

namespace {

void requireVerticesOfTriangles(const mesh::TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) {
      if (v >= mesh.positions.size()) throw Error(fmt::format("triangle {} names vertex {}, which is not there", t, v));
    }
  }
}

void storeRestPositions(const mesh::TriangleMesh& mesh, Skin& skin) {
  skin.rest = FloatStreams(6, std::size_t{skin.blocks} * kBlockVertices, 0);
  for (Index v = 0; v < skin.vertices; ++v) {
    for (int axis = 0; axis < 3; ++axis) skin.rest[axis][v] = static_cast<float>(mesh.positions[v][axis]);
  }
}

void storeRestNormals(Skin& skin) {
  const PositionStreams positions{skin.rest[0], skin.rest[1], skin.rest[2]};
  for (Index v = 0; v < skin.vertices; ++v) {
    const Vec3f normal = areaWeightedNormal(skin, positions, v);
    for (int axis = 0; axis < 3; ++axis) skin.rest[3 + axis][v] = normal[axis];
  }
}

/// Blocks whose vertices can all be reached from one of them without leaving the block.
std::vector<std::uint64_t> connectedBlocks(const GroupGraph& vertices) {
  std::vector<std::uint64_t> tiles(blocksFor(vertices.groups), 0);
  for (Index block = 0; block < vertices.groups; ++block) {
    const std::uint64_t all = vertices.members[block];
    if (grownWithin(vertices, block, 1, all) == all) tiles[blockOf(block)] |= bitOf(block);
  }
  return tiles;
}

void joinBlocks(Skin& skin) {
  skin.vertex_graph = groupGraph(skin.neighbours);
  skin.block_graph = groupGraph(neighboursOfGroups(skin.vertex_graph));
  skin.connected_blocks = connectedBlocks(skin.vertex_graph);
}

}  // namespace

Skin buildSkin(const mesh::TriangleMesh& mesh) {
  requireVerticesOfTriangles(mesh);
  Skin skin;
  skin.vertices = static_cast<Index>(mesh.positions.size());
  skin.blocks = blocksFor(skin.vertices);
  skin.triangles = mesh.triangles;
  skin.triangles_of_vertex = mesh::trianglesOfVertices(mesh);
  skin.neighbours = mesh::neighboursOfVertices(mesh, skin.triangles_of_vertex);
  storeRestPositions(mesh, skin);
  storeRestNormals(skin);
  joinBlocks(skin);
  skin.bounds = boundsOfBlocks(skin);
  return skin;
}

}  // namespace palpate::deform
