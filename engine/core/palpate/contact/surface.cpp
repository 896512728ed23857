// Builds the skin that fingers feel, and refuses a mesh on which a walk could lose its way.
//
// Based on: Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal" (2005).
#include "palpate/contact/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/base/background.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/contact/narrow_cracks.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/mesh/intersections.h"
#include "palpate/mesh/weld.h"

namespace palpate::contact {

using tree::TriangleRecord;

namespace {

constexpr std::string_view kSurfaceStage = "building the contact surface";
/// So many triangles, or vertices and their fans, are looked at in less than 0.1 s.
constexpr Index kReportedPart = 1 << 17;

/// Progress of a step that takes this part of the time. `progress` must outlive it.
Progress partOf(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](std::string_view, double done) { progress(kSurfaceStage, from + (to - from) * done); };
}

/// `what`: "stiffness", a vertex each.
void checkEach(const std::vector<double>& values, std::size_t vertices, const std::string& what) {
  if (values.size() != vertices) {
    throw Error("contact surface: " + std::to_string(values.size()) + " numbers of " + what + " for " +
                std::to_string(vertices) + " vertices");
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!(values[v] >= 0.0) || !std::isfinite(values[v])) {
      throw Error("contact surface: the " + what + " of vertex " + std::to_string(v) +
                  " must be a number of at least 0");
    }
  }
}

/// Angle of the triangle at a corner, radian.
double angleAt(const TriangleRecord& record, int corner) {
  const Vec3 a = record.corners[(corner + 1) % 3] - record.corners[corner];
  const Vec3 b = record.corners[(corner + 2) % 3] - record.corners[corner];
  return elementary::atan2(a.cross(b).norm(), a.dot(b));
}

void fillVertices(SurfaceGeometry& geometry, std::size_t vertices) {
  geometry.vertex_normals.assign(vertices, Vec3::Zero());
  geometry.vertex_on_border.assign(vertices, 0);
  for (const TriangleRecord& record : geometry.tree.records) {
    const Vec3 normal = faceNormal(record);
    for (int i = 0; i < 3; ++i) {
      geometry.vertex_normals[record.vertices[i]] += angleAt(record, i) * normal;
      if (record.neighbours[i] != kNoIndex) continue;
      geometry.vertex_on_border[record.vertices[i]] = 1;
      geometry.vertex_on_border[record.vertices[(i + 1) % 3]] = 1;
    }
  }
  for (Vec3& normal : geometry.vertex_normals) normal.stableNormalize();
}

/// Every triangle of a vertex must be reached by turning around it; otherwise the walk would miss some.
void checkFans(const Surface& surface, std::size_t vertex_count, const Progress& progress) {
  std::vector<Index> triangles(vertex_count, 0);
  std::vector<Index> one_record(vertex_count, kNoIndex);
  for (Index r = 0; r < surface.geometry->tree.records.size(); ++r) {
    const auto& vertices = surface.geometry->tree.records[r].vertices;
    if (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]) {
      throw Error("contact surface: triangle " + std::to_string(surface.geometry->tree.source_triangle[r]) +
                  " uses a vertex twice; repair the mesh first");
    }
    for (const Index v : vertices) {
      ++triangles[v];
      one_record[v] = r;
    }
  }
  for (Index v = 0; v < triangles.size(); ++v) {
    if (v % kReportedPart == 0) report(progress, kSurfaceStage, static_cast<double>(v) / triangles.size());
    if (one_record[v] == kNoIndex) continue;
    const auto& vertices = surface.geometry->tree.records[one_record[v]].vertices;
    const auto corner = static_cast<int>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
    Index reached = 0;
    visitFan(surface, one_record[v], corner, [&](Index, int) { ++reached; });
    if (reached != triangles[v]) {
      throw Error("contact surface: the triangles of vertex " + std::to_string(v) +
                  " do not form a single fan; repair the mesh first");
    }
  }
}

/// Vertices of the triangles around a corner, without itself; each once where the fan is closed.
void collectNeighbours(const Surface& surface, Index record, int corner, std::vector<Index>& vertices) {
  vertices.clear();
  visitFan(surface, record, corner,
           [&](Index t, int c) { vertices.push_back(surface.geometry->tree.records[t].vertices[(c + 1) % 3]); });
}

/// Whether a vertex is the middle that repair gave an edge to tell it from another between the same two vertices
/// (mesh/fans.h): it lies in the middle of two neighbours that have an edge of their own as well.
bool anyEdgeTwice(const mesh::TriangleMesh& mesh, const Surface& surface, const Progress& progress) {
  std::vector<std::uint8_t> done(mesh.positions.size(), 0);
  std::vector<Index> around, beyond;
  const std::size_t records = surface.geometry->tree.records.size();
  for (Index r = 0; r < records; ++r) {
    if (r % kReportedPart == 0) report(progress, kSurfaceStage, static_cast<double>(r) / records);
    for (int corner = 0; corner < 3; ++corner) {
      const Index v = surface.geometry->tree.records[r].vertices[corner];
      if (std::exchange(done[v], 1) != 0) continue;
      collectNeighbours(surface, r, corner, around);
      for (std::size_t i = 0; i < around.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (mesh.positions[v] != Vec3(0.5 * (mesh.positions[around[i]] + mesh.positions[around[j]]))) continue;
          bool twice = false;
          visitFan(surface, r, corner, [&](Index t, int) {
            const auto& vertices = surface.geometry->tree.records[t].vertices;
            const auto at = std::find(vertices.begin(), vertices.end(), around[i]);
            if (at == vertices.end()) return;
            collectNeighbours(surface, t, static_cast<int>(at - vertices.begin()), beyond);
            twice = twice || std::find(beyond.begin(), beyond.end(), around[j]) != beyond.end();
          });
          if (twice) return true;
        }
      }
    }
  }
  return false;
}

bool anyPlaceTwice(const mesh::TriangleMesh& mesh) {
  const std::vector<Index> same_as = mesh::equalVertices(mesh.positions);
  for (Index v = 0; v < same_as.size(); ++v) {
    if (same_as[v] != v) return true;
  }
  return false;
}

/// Whether two triangles in one plane have more in common than their rims.
bool overlapInPlane(const TriangleRecord& one, const TriangleRecord& other, const Vec3& normal, double rounding) {
  for (const TriangleRecord* record : {&one, &other}) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 across = (record->corners[(i + 1) % 3] - record->corners[i]).cross(normal).stableNormalized();
      double low[2], high[2];
      for (int k = 0; k < 2; ++k) {
        const auto& [a, b, c] = (k == 0 ? one : other).corners;
        const double at[3] = {across.dot(a), across.dot(b), across.dot(c)};
        low[k] = *std::min_element(at, at + 3);
        high[k] = *std::max_element(at, at + 3);
      }
      if (std::min(high[0], high[1]) - std::max(low[0], low[1]) <= rounding) return false;
    }
  }
  return true;
}

/// Marks the vertices of triangles that lie on each other in one plane, front to front or back to back: the caps of a
/// fold. They do not pierce, but one of the two is inside out or buried. About 1 us a triangle.
void markDoubled(const SurfaceGeometry& geometry, std::vector<std::uint8_t>& at_crossing) {
  constexpr double kInOnePlane = 1e-9;  // of the diagonal: what files round away, and far less than a finger feels
  const double rounding = kInOnePlane * geometry.tree.diagonal;
  const auto& records = geometry.tree.records;
  for (Index t = 0; t < records.size(); ++t) {
    const Vec3& a = records[t].corners[0];  // no binding: Clang 14 lets no lambda have one
    const Vec3 normal = faceNormal(records[t]);
    const auto look_at = [&](Index other) {
      if (other == t) return;
      const auto& corners = records[other].corners;
      if (mesh::areaVector2(corners[0], corners[1], corners[2]).dot(normal) >= 0.0) return;
      for (const Vec3& p : corners) {
        if (!(std::abs((p - a).dot(normal)) <= rounding)) return;
      }
      if (!overlapInPlane(records[t], records[other], normal, rounding)) return;
      for (const Index which : {t, other}) {
        for (const Index vertex : records[which].vertices) at_crossing[vertex] = 1;
      }
    };
    for (int i = 0; i < 3; ++i) {
      visitTrianglesAlong(geometry.tree, records[t].corners[i], records[t].corners[(i + 1) % 3], look_at);
    }
  }
}

/// Marks what has a vertex in common with an edge that pierces or with a triangle that is pierced, or lies doubled: a
/// ring more than where sheets meet, so that a small sphere fits wherever a walk arrives there.
void findEntangled(const mesh::TriangleMesh& mesh, SurfaceGeometry& geometry, const Progress& progress) {
  const mesh::Intersections found = mesh::findIntersections(mesh, progress);
  // The search gives up only in a mesh dense with overlaps: there every vertex counts.
  std::vector<std::uint8_t> at_crossing(mesh.positions.size(), found.complete ? 0 : 1);
  for (const mesh::Crossing& crossing : found.crossings) {
    at_crossing[crossing.low] = at_crossing[crossing.high] = 1;
    for (const Index vertex : mesh.triangles[crossing.triangle]) at_crossing[vertex] = 1;
  }
  if (found.complete && found.crossings.empty()) return;
  markDoubled(geometry, at_crossing);
  geometry.entangled.reserve(geometry.tree.records.size());
  for (const TriangleRecord& record : geometry.tree.records) {
    const auto [a, b, c] = record.vertices;
    geometry.entangled.push_back(at_crossing[a] | at_crossing[b] | at_crossing[c]);
  }
}

}  // namespace

std::shared_ptr<const SurfaceGeometry> buildGeometry(const mesh::TriangleMesh& mesh,
                                                     std::optional<bool> self_intersecting, const Progress& progress) {
  const bool is_known = self_intersecting.has_value();
  const auto part = [&](double from, double to) {  // where self-intersections are sought, that is the other half
    return is_known ? partOf(progress, from, to) : partOf(progress, 0.5 * from, 0.5 * to);
  };
  // Steps that do not need each other run side by side. Leaving by an exception waits for those that were started.
  const auto geometry = std::make_shared<SurfaceGeometry>();
  bool place_twice = false;
  Background comparing_places([&] { place_twice = anyPlaceTwice(mesh); });
  geometry->tree = tree::buildTriangleTree(mesh, part(0.0, 0.8));
  const Surface surface{
      .geometry = geometry, .stiffness_n_per_mm = {}, .tissue_mm = {}, .force_law = {}};  // to walk on
  Background filling_vertices([&] { fillVertices(*geometry, mesh.positions.size()); });
  checkFans(surface, mesh.positions.size(), part(0.8, 0.85));
  const bool edge_twice = anyEdgeTwice(mesh, surface, part(0.85, 1.0));
  filling_vertices.join();
  comparing_places.join();
  const auto& on_border = geometry->vertex_on_border;
  geometry->closed = std::find(on_border.begin(), on_border.end(), 1) == on_border.end();
  geometry->touches_itself = place_twice || edge_twice;
  if (self_intersecting.value_or(true)) findEntangled(mesh, *geometry, partOf(progress, 0.5, 1.0));
  geometry->cracked = findCracked(surface);
  geometry->self_intersecting = self_intersecting.value_or(!geometry->entangled.empty());
  return geometry;
}

Surface surfaceOf(std::shared_ptr<const SurfaceGeometry> geometry, std::vector<double> stiffness_n_per_mm,
                  SurfaceOptions options) {
  return surfaceOf(std::move(geometry), std::make_shared<const std::vector<double>>(std::move(stiffness_n_per_mm)),
                   std::move(options));
}

Surface surfaceOf(std::shared_ptr<const SurfaceGeometry> geometry,
                  std::shared_ptr<const std::vector<double>> stiffness_n_per_mm, SurfaceOptions options) {
  const std::size_t vertices = geometry->vertex_normals.size();
  checkEach(*stiffness_n_per_mm, vertices, "stiffness");
  if (!options.tissue_mm.empty()) checkEach(options.tissue_mm, vertices, "tissue thickness");
  return {.geometry = std::move(geometry),
          .stiffness_n_per_mm = std::move(stiffness_n_per_mm),
          .tissue_mm = std::move(options.tissue_mm),
          .force_law = options.force_law,
          .lumps = std::move(options.lumps)};
}

Surface buildSurface(const mesh::TriangleMesh& mesh, std::vector<double> stiffness_n_per_mm, SurfaceOptions options) {
  checkEach(stiffness_n_per_mm, mesh.positions.size(), "stiffness");  // before the work
  auto geometry = buildGeometry(mesh, options.self_intersecting);
  return surfaceOf(std::move(geometry), std::move(stiffness_n_per_mm), std::move(options));
}

}  // namespace palpate::contact
