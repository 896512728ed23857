// The skin at rest, laid out for deformation: immutable, built once, shared by any number of threads.
//
// Holds the rest shape as arrays of floats in blocks of 64 consecutive vertices, and who is joined to whom in three
// forms: per vertex the neighbours within its block (one word), per block the edges to other blocks, and plain
// adjacency for strain and recomputed normals. Sort the mesh spatially before (mesh/reorder.h): any order gives the
// same surface, a bad one makes the blocks wide and the work slow.
#pragma once

#include <span>

#include "palpate/deform/blocks.h"
#include "palpate/deform/float_streams.h"
#include "palpate/mesh/topology.h"

namespace palpate::deform {

/// An edge between two blocks: vertex `from` of this block, vertex `to` of the other (both within their block).
struct CrossEdge {
  std::uint8_t from;
  std::uint8_t to;
};

/// All edges from one block to one other.
struct BlockLink {
  Index block;
  Index first_edge;  ///< in Skin::cross_edges
  Index end_edge;
  std::uint64_t from;  ///< vertices of this block that have such an edge
  std::uint64_t to;    ///< vertices of the other block that they reach
};

struct Skin {
  Index vertices = 0;
  Index blocks = 0;
  FloatStreams rest;  ///< x, y, z, nx, ny, nz; padded to whole blocks with zeros
  std::vector<Triangle> triangles;
  mesh::IndexRows neighbours;
  mesh::IndexRows triangles_of_vertex;

  std::vector<std::uint64_t> neighbours_in_block;  ///< per vertex
  std::vector<std::uint64_t> block_vertices;       ///< per block: which of the 64 exist
  std::vector<Index> first_component;              ///< per block, blocks + 1 entries
  std::vector<std::uint64_t> components;           ///< per block: its vertices by what hangs together within it
  std::vector<Index> first_link;                   ///< per block, blocks + 1 entries
  std::vector<BlockLink> links;
  std::vector<CrossEdge> cross_edges;

  std::span<const BlockLink> linksOf(Index block) const {
    return {links.data() + first_link[block], links.data() + first_link[block + 1]};
  }
  std::span<const std::uint64_t> componentsOf(Index block) const {
    return {components.data() + first_component[block], components.data() + first_component[block + 1]};
  }
  RestBlock restBlock(Index block) const {
    const std::size_t first = std::size_t{block} * kBlockVertices;
    return {{rest[0] + first, rest[1] + first, rest[2] + first, rest[3] + first, rest[4] + first, rest[5] + first}};
  }
  Vec3f restPosition(Index v) const { return {rest[0][v], rest[1][v], rest[2][v]}; }
  Vec3f restNormal(Index v) const { return {rest[3][v], rest[4][v], rest[5][v]}; }
};

/// Normals are area-weighted (computed from the positions as floats). Throws Error for a triangle that names a vertex
/// that is not there. Positions that are not finite are carried along; such vertices never move.
Skin buildSkin(const mesh::TriangleMesh& mesh);

}  // namespace palpate::deform
