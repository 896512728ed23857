// Each damage is one pass over the mesh and knows nothing of the shape.
#include "lab/workloads/hunted_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/mesh/topology.h"

namespace palpate::lab {
namespace {

Vec3 normalDeviate(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

/// Puts `middle` on the edge `i` of a triangle; the other half becomes a new triangle.
void splitEdge(mesh::TriangleMesh& mesh, Index triangle, int i, Index middle) {
  Triangle& kept = mesh.triangles[triangle];
  Triangle half = kept;
  kept[static_cast<std::size_t>((i + 1) % 3)] = middle;
  half[static_cast<std::size_t>(i)] = middle;
  mesh.triangles.push_back(half);
}

}  // namespace

void squeeze(mesh::TriangleMesh& mesh, const Vec3& direction, double factor) {
  for (Vec3& p : mesh.positions) p += (factor - 1.0) * p.dot(direction) * direction;
}

void splitIntoSlivers(mesh::TriangleMesh& mesh, double share, Random& random) {
  const auto neighbours = mesh::neighboursOfTriangles(mesh);
  const std::size_t triangles = mesh.triangles.size();
  std::vector<bool> used(triangles, false);  // a triangle is split once: neighbours stay true
  for (std::size_t n = 0; n < static_cast<std::size_t>(share * static_cast<double>(triangles)); ++n) {
    const auto t = static_cast<Index>(random.below(triangles));
    const int i = static_cast<int>(random.below(3));
    const Index other = neighbours[t][static_cast<std::size_t>(i)];
    if (other == kNoIndex || used[t] || used[other]) continue;
    const Index a = mesh.triangles[t][static_cast<std::size_t>(i)];
    const Index b = mesh.triangles[t][static_cast<std::size_t>((i + 1) % 3)];
    const double at = std::pow(10.0, random.uniform(-4, -0.4));
    const auto middle = static_cast<Index>(mesh.positions.size());
    mesh.positions.emplace_back(mesh.positions[a] + at * (mesh.positions[b] - mesh.positions[a]));
    const Triangle& across = mesh.triangles[other];
    const int j = static_cast<int>(std::find(across.begin(), across.end(), b) - across.begin());
    splitEdge(mesh, t, i, middle);
    splitEdge(mesh, other, j, middle);
    used[t] = used[other] = true;
  }
}

void shake(mesh::TriangleMesh& mesh, double size_mm, Random& random) {
  for (Vec3& p : mesh.positions) p += size_mm * normalDeviate(random);
}

void pierce(mesh::TriangleMesh& mesh, std::size_t count, Random& random) {
  for (std::size_t n = 0; n < count && mesh.triangles.size() > 8; ++n) {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(random.below(mesh.triangles.size())));
  }
}

void slit(mesh::TriangleMesh& mesh, std::size_t cuts, double gap_mm, Random& random) {
  for (std::size_t n = 0; n < cuts; ++n) {
    // A vertex of some triangles becomes two: those on one side of a plane through it get the copy.
    const Index vertex = mesh.triangles[random.below(mesh.triangles.size())][0];
    const Vec3 across = normalDeviate(random).normalized(), at = mesh.positions[vertex];
    const auto copy = static_cast<Index>(mesh.positions.size());
    mesh.positions.emplace_back(at + gap_mm * across);
    for (Triangle& t : mesh.triangles) {
      if (across.dot(mesh::centreOf(mesh, t) - at) > 0.0) std::replace(t.begin(), t.end(), vertex, copy);
    }
  }
}

void repeatTriangles(mesh::TriangleMesh& mesh, std::size_t count, Random& random) {
  const std::size_t triangles = mesh.triangles.size();
  for (std::size_t n = 0; n < count;) {
    const bool both_ways = random.below(2) == 0;
    // Generators number neighbours one after the other: now and then some side by side.
    for (std::size_t at = random.below(triangles), run = 1 + random.below(4); run > 0 && at < triangles;
         --run, ++at, ++n) {
      Triangle t = mesh.triangles[at];
      mesh.triangles.push_back(t);
      if (!both_ways) continue;
      std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
}

void place(mesh::TriangleMesh& mesh, const Vec3& at, Random& random) {
  const Vec3 axis = normalDeviate(random).normalized();
  const Eigen::AngleAxisd turn(random.uniform(0, std::numbers::pi), axis);
  for (Vec3& p : mesh.positions) p = turn * p + at;
}

}  // namespace palpate::lab
