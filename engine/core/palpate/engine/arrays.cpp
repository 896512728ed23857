// Follows every vertex and triangle through mending and sorting. Vertices are followed by scene::mendedBody; triangles
// leave no trace and are found again by their corners, of which mending keeps the names: a sorted list and a search
// each. Load time.
#include "palpate/engine/arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/mesh/weld.h"
#include "palpate/scene/body_parts.h"

namespace palpate::engine {

namespace {

void checkStiffness(std::span<const double> stiffness, std::size_t vertices) {
  if (stiffness.empty()) return;
  if (stiffness.size() != vertices) {
    throw Error(fmt::format("arrays: {} stiffness values for {} vertices; expected one per vertex", stiffness.size(),
                            vertices));
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!std::isfinite(stiffness[v]) || stiffness[v] < 0.0) {
      throw Error(
          fmt::format("arrays: the stiffness of vertex {} is {}; expected a number of at least 0", v, stiffness[v]));
    }
  }
}

/// values[order[i]] at i.
template <class T>
std::vector<T> inOrder(std::span<const T> values, const std::vector<Index>& order) {
  std::vector<T> result;
  result.reserve(order.size());
  for (const Index i : order) result.push_back(values[i]);
  return result;
}

/// For each of `count` sources the first that came from it.
std::vector<Index> firstPerSource(const std::vector<Index>& sources, std::size_t count) {
  std::vector<Index> first(count, kNoIndex);
  for (Index i = 0; i < sources.size(); ++i) {
    if (sources[i] != kNoIndex && first[sources[i]] == kNoIndex) first[sources[i]] = i;
  }
  return first;
}

/// The sources without those of vertices that mending put in the middle of an edge: these have one end of it as theirs.
std::vector<Index> whereUnmoved(const mesh::TriangleMesh& given, const mesh::TriangleMesh& built,
                                std::vector<Index> sources) {
  for (Index v = 0; v < sources.size(); ++v) {
    if (built.positions[v] != given.positions[sources[v]]) sources[v] = kNoIndex;
  }
  return sources;
}

/// A triangle by its corners, whichever comes first and whichever way it is wound.
Triangle byCorners(const Triangle& triangle, const std::vector<Index>& names) {
  Triangle corners = {names[triangle[0]], names[triangle[1]], names[triangle[2]]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Mending flips, drops and cuts triangles but keeps the names of their corners, so a triangle is found again by them.
std::vector<Index> sourcesOfTriangles(const mesh::TriangleMesh& given, const std::vector<Index>& place_of_given,
                                      const mesh::TriangleMesh& built, const std::vector<Index>& source_vertex) {
  std::vector<std::pair<Triangle, Index>> known;
  known.reserve(given.triangles.size());
  for (Index t = 0; t < given.triangles.size(); ++t) {
    known.emplace_back(byCorners(given.triangles[t], place_of_given), t);
  }
  std::sort(known.begin(), known.end());
  std::vector<Index> sources;
  sources.reserve(built.triangles.size());
  for (const Triangle& triangle : built.triangles) {
    const Triangle corners = byCorners(triangle, source_vertex);
    const auto found = std::lower_bound(known.begin(), known.end(), std::pair(corners, Index{0}));
    sources.push_back(found != known.end() && found->first == corners ? found->second : kNoIndex);
  }
  return sources;
}

}  // namespace

namespace arrays {

void checkCounts(std::size_t coordinates, std::size_t corners) {
  if (coordinates % 3 != 0) throw Error(fmt::format("arrays: {} coordinates; expected three per vertex", coordinates));
  if (corners % 3 != 0) throw Error(fmt::format("arrays: {} corners; expected three per triangle", corners));
  constexpr std::size_t kMax = std::numeric_limits<Index>::max() - 1;
  if (coordinates / 3 > kMax || corners / 3 > kMax) {
    throw Error("arrays: too many vertices or triangles for 32-bit indices");
  }
}

void failAtCoordinate(std::size_t place) {
  throw Error(fmt::format("arrays: {} of vertex {} is not finite", "xyz"[place % 3], place / 3));
}

void failAtCorner(std::size_t place, long long index, std::size_t vertices) {
  throw Error(fmt::format("arrays: corner {} of triangle {} is vertex {}, but there are only {} vertices", place % 3,
                          place / 3, index, vertices));
}

}  // namespace arrays

WorldFromArrays worldFromMesh(const mesh::TriangleMesh& mesh, std::span<const double> stiffness_n_per_mm,
                              const scene::Scene& scene, const Progress& progress,
                              std::span<const std::string> file_notes) {
  checkStiffness(stiffness_n_per_mm, mesh.positions.size());
  WorldFromArrays built;
  scene::BodyParts body = scene::mendedBody(mesh, "arrays", progress, built.source_vertex);
  body.notes.insert(body.notes.begin(), file_notes.begin(), file_notes.end());
  if (!stiffness_n_per_mm.empty()) body.given_stiffness_n_per_mm = inOrder(stiffness_n_per_mm, built.source_vertex);
  const std::vector<Index> first_at_place = mesh::equalVertices(mesh.positions);
  const std::vector<Index> unmoved = whereUnmoved(mesh, body.skin, built.source_vertex);
  built.source_triangle = sourcesOfTriangles(mesh, first_at_place, body.skin, unmoved);
  const std::vector<Index> built_of_first = firstPerSource(unmoved, mesh.positions.size());
  built.built_vertex = inOrder(std::span(built_of_first), first_at_place);
  built.built_triangle = firstPerSource(built.source_triangle, mesh.triangles.size());
  scene::Scene described = scene;
  described.body = {};
  described.body.kind = scene::BodyKind::mesh;
  built.world = scene::buildOn(described, std::move(body), progress);
  return built;
}

}  // namespace palpate::engine
