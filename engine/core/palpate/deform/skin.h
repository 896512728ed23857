// The skin at rest, laid out for deformation: immutable, built once, shared by any number of threads.
//
// Holds the rest shape as arrays of floats in blocks of 64 consecutive vertices and tiles of 64 consecutive blocks,
// with a box around each block; and who is joined to whom in three forms: vertices in blocks and blocks in tiles for
// the search of a region, and plain adjacency for strain and recomputed normals. Sort the mesh spatially before
// (mesh/reorder.h): any order gives the same surface, a bad one makes the blocks wide and the work slow.
#pragma once

#include <span>

#include "palpate/base/progress.h"
#include "palpate/deform/fold_bounds.h"
#include "palpate/deform/group_graph.h"
#include "palpate/deform/kernels/blocks.h"
#include "palpate/mesh/topology.h"

namespace palpate::deform {

/// Bodies that lie within this of the body frame's origin along each axis count from there; the last bit of a float is
/// a micrometre here. Others, scans in map coordinates, count from the middle of their box, in whole millimetres.
inline constexpr double kNearMm = 1e4;

/// Streams of the rest shape: x, y, z, nx, ny, nz.
inline constexpr std::size_t kRestStreams = 6;

struct Skin {
  Index vertices = 0;
  Index blocks = 0;
  /// Origin of all positions here and of the surfaces of this skin, mm: zero, but for a body that lies farther from the
  /// body frame's origin than a float resolves micrometres (kNearMm).
  Vec3 origin = Vec3::Zero();
  FloatStreams rest;                    ///< kRestStreams, padded to whole blocks with zeros
  std::span<const Triangle> triangles;  ///< triangles of the mesh that it was built from
  mesh::IndexRows neighbours;
  mesh::IndexRows triangles_of_vertex;

  GroupGraph vertex_graph;                      ///< vertices in blocks
  GroupGraph block_graph;                       ///< blocks in tiles
  std::vector<std::uint64_t> connected_blocks;  ///< per tile: blocks whose vertices are all connected within the block
  /// Per block the centre and half size (x, y, z) of the box of its positions, then of its normals: 12 streams, padded
  /// to whole tiles.
  FloatStreams bounds;
  std::vector<FoldBound> fold_bounds;        ///< per block
  std::vector<float> spread_of_tiles;        ///< the largest FoldBound::spread of each tile
  AlignedVector<float> fold_gradient_mm;     ///< per vertex, padded to whole blocks (fold_bounds.h)
  AlignedVector<float> fold_crease;          ///< likewise
  AlignedVector<float> room_beside_staying;  ///< per vertex, padded to whole blocks; mm (fold_bounds.h)
  /// Per vertex how thick the part is under it, mm, and the least of each block: no dent comes out of the far side.
  /// Empty: not measured, and nothing limits the dent but the caps.
  std::vector<float> thickness_mm;
  std::vector<float> least_thickness_mm;

  std::span<const GroupLink> linksOf(Index block) const { return vertex_graph.linksOf(block); }
  TileBounds tileBounds(Index tile) const {
    TileBounds tile_bounds{};
    for (std::size_t i = 0; i < 12; ++i) tile_bounds.values[i] = bounds[i] + std::size_t{tile} * kTileBlocks;
    return tile_bounds;
  }
  RestBlock restBlock(Index block) const {
    const std::size_t first = std::size_t{block} * kBlockVertices;
    return {{rest[0] + first, rest[1] + first, rest[2] + first, rest[3] + first, rest[4] + first, rest[5] + first}};
  }
  /// `area`: DeformedBlock::area of the block.
  FoldBlock foldBlock(Index block, const float* area) const {
    const std::size_t first = std::size_t{block} * kBlockVertices;
    return {restBlock(block), fold_gradient_mm.data() + first, fold_crease.data() + first, area};
  }
  EdgeBlock edgeBlock(Index block) const {
    const float* room = room_beside_staying.data() + std::size_t{block} * kBlockVertices;
    return {restBlock(block), room, fold_bounds[block].longest_mm};
  }
  /// A ball that holds all triangles at the vertices of a block; about the origin, as all here.
  Vec3 centreOf(Index block) const {
    return Vec3f(bounds[0][block], bounds[1][block], bounds[2][block]).cast<double>();
  }
  double radiusOf(Index block) const {
    const Vec3f half(bounds[3][block], bounds[4][block], bounds[5][block]);
    return static_cast<double>(half.norm()) + static_cast<double>(fold_bounds[block].longest_mm);
  }
  Vec3f restPosition(Index v) const { return {rest[0][v], rest[1][v], rest[2][v]}; }
  /// In the body frame.
  Vec3 restPlace(Index v) const { return origin + restPosition(v).cast<double>(); }
  Vec3f restNormal(Index v) const { return {rest[3][v], rest[4][v], rest[5][v]}; }
};

/// Normals are area-weighted (computed from the positions as floats). Throws Error for a triangle that names a vertex
/// that is not there. Positions that are not finite are carried along; such vertices never move. The skin reads the
/// mesh's triangles where they are: the mesh must outlive it.
Skin buildSkin(const mesh::TriangleMesh& mesh, const Progress& progress = {});
Skin buildSkin(const mesh::TriangleMesh&&, const Progress& = {}) = delete;

/// `thickness_mm`: one a vertex (tree/triangle_tree.h), or empty. Throws Error for another number of them.
void setThickness(std::vector<float> thickness_mm, Skin& skin);

}  // namespace palpate::deform
