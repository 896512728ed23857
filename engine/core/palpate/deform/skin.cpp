// Builds a skin at load time: rest shape in streams, who is joined to whom, boxes around blocks.
#include "palpate/deform/skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/deform/normals.h"

namespace palpate::deform {

namespace {

void requireVerticesOfTriangles(const mesh::TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) {
      if (v >= mesh.positions.size())
        throw Error(fmt::format("triangle {} uses vertex {}, which does not exist", t, v));
    }
  }
}

/// Vertices that are not finite are nowhere.
Vec3 chooseOrigin(const mesh::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : mesh.positions) {
    if (position.allFinite()) box.extend(position);
  }
  const bool is_near = box.isEmpty() || box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() <= kNearMm;
  return is_near ? Vec3(Vec3::Zero()) : Vec3(box.center().array().round());
}

void storeRestPositions(const mesh::TriangleMesh& mesh, Skin& skin) {
  skin.rest = FloatStreams(kRestStreams, std::size_t{skin.blocks} * kBlockVertices, 0);
  for (Index v = 0; v < skin.vertices; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      skin.rest[axis][v] = static_cast<float>(mesh.positions[v][axis] - skin.origin[axis]);
    }
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

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
/// A few roundings of a float: boxes are that much wider, so that what holds for the box holds for every vertex as the
/// kernels round it.
constexpr float kRounding = 1e-6f;

struct Interval {
  float centre;
  float half;
};

Interval boundingInterval(std::span<const float> values) {
  if (!std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); })) return {kNan, kNan};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const float centre = 0.5f * *low + 0.5f * *high;
  const float half = std::max(*high - centre, centre - *low);
  return {centre, half + kRounding * (half + std::abs(centre))};
}

/// Boxes around the vertices of each block and around their normals: they let a whole block be taken or left at once. A
/// block with a number that is not finite has boxes of NaN: it is never decided as a whole.
FloatStreams boundsOfBlocks(const Skin& skin) {
  FloatStreams bounds(12, std::size_t{blocksFor(skin.blocks)} * kTileBlocks, 0);
  for (Index block = 0; block < skin.blocks; ++block) {
    const RestBlock rest = skin.restBlock(block);
    const Index count = std::min(kBlockVertices, skin.vertices - block * kBlockVertices);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto [centre, half] = boundingInterval({rest.values[i], count});
      const std::size_t first = i < 3 ? 0 : 6;
      bounds[first + i % 3][block] = centre;
      bounds[first + 3 + i % 3][block] = half;
    }
  }
  return bounds;
}

std::vector<float> spreadOfTiles(const std::vector<FoldBound>& blocks) {
  std::vector<float> tiles(blocksFor(static_cast<Index>(blocks.size())), 0.0f);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    float& tile = tiles[b / kTileBlocks];
    tile = std::max(tile, blocks[b].spread);
  }
  return tiles;
}

}  // namespace

Skin buildSkin(const mesh::TriangleMesh& mesh, const Progress& progress) {
  int step = 0;
  const auto next = [&] { report(progress, "building the skin", step++ / 10.0); };
  next();
  requireVerticesOfTriangles(mesh);
  Skin skin;
  skin.vertices = static_cast<Index>(mesh.positions.size());
  skin.blocks = blocksFor(skin.vertices);
  skin.triangles = mesh.triangles;
  next();
  skin.triangles_of_vertex = mesh::trianglesOfVertices(mesh);
  next();
  skin.neighbours = mesh::neighboursOfVertices(mesh, skin.triangles_of_vertex);
  next();
  skin.origin = chooseOrigin(mesh);
  storeRestPositions(mesh, skin);
  next();
  storeRestNormals(skin);
  next();
  joinBlocks(skin);
  next();
  skin.bounds = boundsOfBlocks(skin);
  next();
  setFoldBounds(skin);
  next();
  skin.spread_of_tiles = spreadOfTiles(skin.fold_bounds);
  skin.room_beside_staying = roomBesideStaying(skin);
  next();
  return skin;
}

void setThickness(std::vector<float> thickness_mm, Skin& skin) {
  if (!thickness_mm.empty() && thickness_mm.size() != skin.vertices) {
    throw Error(fmt::format("{} thicknesses for {} vertices", thickness_mm.size(), skin.vertices));
  }
  skin.thickness_mm = std::move(thickness_mm);
  skin.least_thickness_mm.clear();
  if (skin.thickness_mm.empty()) return;
  skin.least_thickness_mm.assign(skin.blocks, std::numeric_limits<float>::infinity());
  for (Index v = 0; v < skin.vertices; ++v) {
    float& least = skin.least_thickness_mm[blockOf(v)];
    least = std::min(least, skin.thickness_mm[v]);
  }
}

}  // namespace palpate::deform
