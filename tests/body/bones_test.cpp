// The 43 bones: sound meshes, mirrored, scaled, exact counts, none inside another.
#include "palpate/body/bones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "palpate/base/error.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/topology.h"

namespace palpate::body {
namespace {

const std::vector<Bone>& defaultBones() {
  static const std::vector<Bone> bones = makeBones();
  return bones;
}

std::size_t totalTriangles(const std::vector<Bone>& bones) {
  return std::accumulate(bones.begin(), bones.end(), std::size_t{0},
                         [](std::size_t sum, const Bone& b) { return sum + b.mesh.triangles.size(); });
}

double signedVolume(const mesh::TriangleMesh& mesh) {
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles) {
    volume += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6.0;
  }
  return volume;
}

// Van Oosterom and Strackee: 1 inside a closed outward mesh, 0 outside.
double windingNumber(const mesh::TriangleMesh& mesh, const Vec3& p) {
  double angle = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - p;
    const Vec3 b = mesh.positions[t[1]] - p;
    const Vec3 c = mesh.positions[t[2]] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

std::size_t components(const mesh::TriangleMesh& mesh) {
  const auto neighbours = mesh::neighboursOfTriangles(mesh);
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::size_t count = 0;
  for (Index start = 0; start < mesh.triangles.size(); ++start) {
    if (seen[start] != 0) continue;
    ++count;
    std::vector<Index> pending{start};
    while (!pending.empty()) {
      const Index t = pending.back();
      pending.pop_back();
      if (seen[t] != 0) continue;
      seen[t] = 1;
      for (const Index n : neighbours[t]) {
        if (n != kNoIndex) pending.push_back(n);
      }
    }
  }
  return count;
}

// Triangles around each vertex form one fan: as many as can be reached from the first across shared edges.
bool everyVertexHasOneFan(const mesh::TriangleMesh& mesh) {
  const mesh::IndexRows triangles = mesh::trianglesOfVertices(mesh);
  const auto neighbours = mesh::neighboursOfTriangles(mesh);
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (triangles[v].empty()) return false;
    const Index first = triangles[v].front();
    std::size_t met = 0;
    for (Index t = first; t != kNoIndex && (t != first || met == 0); ++met) {
      const auto& corners = mesh.triangles[t];
      t = neighbours[t][static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin())];
    }
    if (met != triangles[v].size()) return false;
  }
  return true;
}

TEST(Bones, AreFortyThreeInAFixedOrder) {
  const auto& bones = defaultBones();
  ASSERT_EQ(bones.size(), kBoneCount);
  EXPECT_EQ(bones[0].name, "T1");
  EXPECT_EQ(bones[16].name, "L5");
  EXPECT_EQ(bones[17].name, "rib_1_right");
  EXPECT_EQ(bones[40].name, "rib_12_left");
  EXPECT_EQ(bones[42].name, "scapula_left");
}

TEST(Bones, AreClosedManifoldOutwardAndInOnePiece) {
  for (const Bone& bone : defaultBones()) {
    SCOPED_TRACE(bone.name);
    for (const auto& row : mesh::neighboursOfTriangles(bone.mesh)) {
      for (const Index n : row) ASSERT_NE(n, kNoIndex);
    }
    EXPECT_TRUE(everyVertexHasOneFan(bone.mesh));
    EXPECT_EQ(components(bone.mesh), 1u);
    EXPECT_GT(signedVolume(bone.mesh), 1000.0);  // mm^3: the smallest rib has about 4 cm^3
  }
}

TEST(Bones, HaveTheAskedNumberOfTrianglesExactly) {
  EXPECT_EQ(totalTriangles(defaultBones()), 60000u);
  for (const std::size_t total : {kFewestBoneTriangles, std::size_t{5002}, std::size_t{12344}}) {
    BonesSettings settings;
    settings.triangles = total;
    EXPECT_EQ(totalTriangles(makeBones(settings)), total);
  }
}

TEST(Bones, RefuseWhatCannotBeBuilt) {
  BonesSettings settings;
  settings.triangles = 20001;
  EXPECT_THROW(makeBones(settings), Error);
  settings.triangles = 200;
  EXPECT_THROW(makeBones(settings), Error);
  settings = {};
  settings.stature_mm = 0.0;
  EXPECT_THROW(makeBones(settings), Error);
}

}  // namespace
}  // namespace palpate::body
