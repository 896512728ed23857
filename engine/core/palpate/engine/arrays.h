// A world from arrays that another program holds: places, triangles, a stiffness for each place. No file.
//
//   arrays ─ meshFromArrays ─► mesh ─ repair, spatial order ─► scene::build ─► World + who became whom
//
// The world's vertices and triangles are not in the order they were given in: seams are welded, faults mended, and
// neighbours in space are neighbours in memory. The maps give the new places.
#pragma once

#include <cmath>
#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

/// `coordinates_mm` holds x, y, z of each vertex, `corners` three vertices of each triangle, counter-clockwise seen
/// from outside, counted from 0. Any number types. Throws Error naming the first coordinate that is not finite, the
/// first index that names no vertex, and counts that are not whole.
template <std::floating_point Real, std::integral Integer>
mesh::TriangleMesh meshFromArrays(std::span<const Real> coordinates_mm, std::span<const Integer> corners);

struct WorldFromArrays {
  std::shared_ptr<const scene::World> world;
  /// A vertex of world->body->skin each: the given one it is. Where several were given at one place, the first of them;
  /// for one that mending put in the middle of an edge (rare), an end of that edge.
  std::vector<Index> source_vertex;
  /// A triangle of world->body->skin each: the given one with these corners; kNoIndex for one that mending made.
  std::vector<Index> source_triangle;
  /// The other way round, a given vertex or triangle each; kNoIndex for what the world has not. Where mending made
  /// several of one, the first of them.
  std::vector<Index> built_vertex;
  std::vector<Index> built_triangle;
};

/// `mesh` may have any faults that scene::build mends; the scene gives everything but the body, and needs no fingers.
/// `stiffness_n_per_mm` has a value for each given vertex, finite and >= 0, or is empty: then the scene's is used.
/// `file_notes`, of MeshWithChannels where a file was read, come first among the world's notes.
/// Throws Error as scene::build does, and for stiffnesses that are not so.
WorldFromArrays worldFromMesh(const mesh::TriangleMesh& mesh, std::span<const double> stiffness_n_per_mm = {},
                              const scene::Scene& scene = {}, const Progress& progress = {},
                              std::span<const std::string> file_notes = {});

// ---- how meshFromArrays looks at any type

namespace arrays {
void checkCounts(std::size_t coordinates, std::size_t corners);
[[noreturn]] void failAtCoordinate(std::size_t place);
[[noreturn]] void failAtCorner(std::size_t place, long long index, std::size_t vertices);
}  // namespace arrays

template <std::floating_point Real, std::integral Integer>
mesh::TriangleMesh meshFromArrays(std::span<const Real> coordinates_mm, std::span<const Integer> corners) {
  arrays::checkCounts(coordinates_mm.size(), corners.size());
  mesh::TriangleMesh mesh;
  mesh.positions.resize(coordinates_mm.size() / 3);
  for (std::size_t i = 0; i < coordinates_mm.size(); ++i) {
    const auto coordinate = static_cast<double>(coordinates_mm[i]);
    if (!std::isfinite(coordinate)) arrays::failAtCoordinate(i);
    mesh.positions[i / 3][static_cast<Eigen::Index>(i % 3)] = coordinate;
  }
  mesh.triangles.resize(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!std::in_range<Index>(corners[i]) || static_cast<Index>(corners[i]) >= mesh.positions.size()) {
      arrays::failAtCorner(i, static_cast<long long>(corners[i]), mesh.positions.size());
    }
    mesh.triangles[i / 3][i % 3] = static_cast<Index>(corners[i]);
  }
  return mesh;
}

}  // namespace palpate::engine
