// Meshes and judges for the tests of the partitions: brute force over all triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/hdb/haptic_box.h"
#include "support/mesh_zoo.h"

namespace palpate::hdb::test {

/// The height field of golden/hdb_query.json: 41 x 46 vertices, 350 x 400 mm.
inline mesh::TriangleMesh goldenBack() {
  constexpr Index kAcross = 41, kAlong = 46;
  mesh::TriangleMesh mesh;
  for (Index j = 0; j < kAlong; ++j) {
    for (Index i = 0; i < kAcross; ++i) {
      const double x = -175.0 + 350.0 * i / (kAcross - 1), y = 400.0 * j / (kAlong - 1);
      const double arch = 1.0 - (x / 175.0) * (x / 175.0);
      mesh.positions.emplace_back(x, y, 72.0 * arch + 12.0 * std::sin(2.0 * std::numbers::pi * y / 400.0));
    }
  }
  for (Index j = 0; j + 1 < kAlong; ++j) {
    for (Index i = 0; i + 1 < kAcross; ++i) {
      const Index a = j * kAcross + i;
      mesh.triangles.push_back({a, a + 1, a + kAcross + 1});
      mesh.triangles.push_back({a, a + kAcross + 1, a + kAcross});
    }
  }
  return mesh;
}

/// The zoo without those that no partition is built of.
inline std::vector<zoo::Specimen> buildableZoo() {
  std::vector<zoo::Specimen> zoo = zoo::specimens();
  std::erase_if(zoo, [](const zoo::Specimen& s) {
    return s.name == "cube with non-finite vertices" || s.name == "cube with wrong indices";
  });
  zoo.push_back({"empty", zoo::empty()});
  zoo.push_back({"far away and huge", zoo::cube(1e9, Vec3(1e12, -1e12, 1e12))});
  zoo.push_back({"tiny", zoo::sphere(1e-9, 2)});
  zoo.push_back({"a body and a stray triangle", zoo::joined(zoo::sphere(20.0, 2), zoo::cube(1.0, Vec3(1e9, 0, 0)))});
  return zoo;
}

inline Box3 computeBox(const mesh::TriangleMesh& mesh, Index triangle) {
  Box3 box;
  for (const Index v : mesh.triangles[triangle]) box.extend(mesh.positions[v]);
  return box;
}

inline Box3 computeBox(const mesh::TriangleMesh& mesh) {
  Box3 box;
  for (Index t = 0; t < mesh.triangles.size(); ++t) box.extend(computeBox(mesh, t));
  return box;
}

/// Brute force: the triangles whose box meets the box.
inline std::set<Index> trianglesMeeting(const mesh::TriangleMesh& mesh, const Box3& box) {
  std::set<Index> found;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Box3 own = computeBox(mesh, t);
    const bool apart = (own.min().array() > box.max().array()).any() || (own.max().array() < box.min().array()).any();
    if (!apart) found.insert(t);
  }
  return found;
}

inline std::set<Index> trianglesOfLeaves(const Partition& partition, const std::vector<Index>& leaves) {
  std::set<Index> found;
  for (const Index leaf : leaves) {
    const auto triangles = trianglesOf(partition, partition.nodes[leaf]);
    found.insert(triangles.begin(), triangles.end());
  }
  return found;
}

inline std::size_t missing(const std::set<Index>& must, const std::set<Index>& found) {
  return static_cast<std::size_t>(std::count_if(must.begin(), must.end(), [&](Index t) { return !found.contains(t); }));
}

/// A box somewhere in and around the model, from a hundredth of it to twice its size; every fourth one has a face
/// exactly on a vertex.
inline Box3 randomBox(Random& random, const mesh::TriangleMesh& mesh) {
  const Box3 bounds = computeBox(mesh);
  if (bounds.isEmpty()) return hapticBox(Vec3::Zero(), 1.0);
  const double longest = std::max(bounds.sizes().maxCoeff(), 1e-12);
  Vec3 centre;
  for (int i = 0; i < 3; ++i) {
    centre[i] = random.uniform(bounds.min()[i] - 0.2 * longest, bounds.max()[i] + 0.2 * longest);
  }
  Box3 box = hapticBox(centre, longest * std::pow(10.0, random.uniform(-2.0, 0.3)));
  if (random.below(4) == 0) {
    const Triangle& triangle = mesh.triangles[random.below(mesh.triangles.size())];
    const int axis = static_cast<int>(random.below(3));
    const double shift = mesh.positions[triangle[0]][axis] - box.max()[axis];
    box.min()[axis] += shift;
    box.max()[axis] = mesh.positions[triangle[0]][axis];
  }
  return box;
}

inline constexpr TreeKind kTrees[] = {TreeKind::Bsp, TreeKind::Octree};
inline constexpr Assignment kAssignments[] = {Assignment::Cut, Assignment::BothSides, Assignment::Majority};

/// For SCOPED_TRACE.
inline std::string nameOf(const BuildSettings& s) {
  const char letter = s.assignment == Assignment::Cut ? 'A' : s.assignment == Assignment::BothSides ? 'B' : 'C';
  return std::string(s.tree == TreeKind::Bsp ? "bsp " : "octree ") + letter + " " + std::to_string(s.threshold);
}

}  // namespace palpate::hdb::test
