#include "palpate/deform/skin.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
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

struct EdgeOut {
  Index block;
  CrossEdge edge;
};

/// Splits the neighbours of a block's vertices into those inside and those in other blocks.
std::vector<EdgeOut> sortedEdgesOut(Skin& skin, Index block) {
  std::vector<EdgeOut> out;
  const Index first = block * kBlockVertices;
  const Index end = std::min(first + kBlockVertices, skin.vertices);
  for (Index v = first; v < end; ++v) {
    for (const Index w : skin.neighbours[v]) {
      if (blockOf(w) == block) {
        skin.neighbours_in_block[v] |= bitOf(w);
      } else {
        out.push_back({blockOf(w),
                       {static_cast<std::uint8_t>(v % kBlockVertices), static_cast<std::uint8_t>(w % kBlockVertices)}});
      }
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const EdgeOut& a, const EdgeOut& b) { return a.block < b.block; });
  return out;
}

void appendLinks(const std::vector<EdgeOut>& edges, Skin& skin) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto here = static_cast<Index>(skin.cross_edges.size());
    if (i == 0 || edges[i].block != edges[i - 1].block) skin.links.push_back({edges[i].block, here, here, 0, 0});
    skin.cross_edges.push_back(edges[i].edge);
    BlockLink& link = skin.links.back();
    link.end_edge = here + 1;
    link.from |= std::uint64_t{1} << edges[i].edge.from;
    link.to |= std::uint64_t{1} << edges[i].edge.to;
  }
}

void appendComponents(Index block, Skin& skin) {
  const std::uint64_t* neighbours = skin.neighbours_in_block.data() + std::size_t{block} * kBlockVertices;
  for (std::uint64_t left = skin.block_vertices[block]; left != 0;) {
    skin.components.push_back(grownWithin(neighbours, left & (~left + 1), left));
    left &= ~skin.components.back();
  }
  skin.first_component.push_back(static_cast<Index>(skin.components.size()));
}

void linkBlocks(Skin& skin) {
  skin.neighbours_in_block.assign(std::size_t{skin.blocks} * kBlockVertices, 0);
  skin.first_link.push_back(0);
  skin.first_component.push_back(0);
  for (Index block = 0; block < skin.blocks; ++block) {
    appendLinks(sortedEdgesOut(skin, block), skin);
    skin.first_link.push_back(static_cast<Index>(skin.links.size()));
    const Index count = std::min(kBlockVertices, skin.vertices - block * kBlockVertices);
    skin.block_vertices.push_back(~std::uint64_t{0} >> (kBlockVertices - count));
    appendComponents(block, skin);
  }
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
  linkBlocks(skin);
  return skin;
}

}  // namespace palpate::deform
