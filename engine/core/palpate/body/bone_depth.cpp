// All bones in one box tree (mesh/nearest.h); each search starts with the answer of the point before as its reach.
#include "palpate/body/bones.h"

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/mesh/nearest.h"

namespace palpate::body {
namespace {

struct JoinedBones {
  mesh::TriangleMesh mesh;
  std::vector<Index> bone_of_triangle;
};

JoinedBones joined(std::span<const Bone> bones) {
  JoinedBones all;
  for (Index b = 0; b < bones.size(); ++b) {
    append(bones[b].mesh, all.mesh);
    all.bone_of_triangle.resize(all.mesh.triangles.size(), b);
  }
  return all;
}

// A reach is the old nearest point's distance, a little widened so that the strict comparison finds it again.
constexpr double kReachSlack = 1.0 + 1e-9;

}  // namespace

BoneDepth depthToBones(std::span<const Vec3> points, std::span<const Bone> bones) {
  const JoinedBones all = joined(bones);
  if (all.mesh.triangles.empty()) throw Error("bone depth: the body has no bones");
  const mesh::NearestTriangle tree(all.mesh);
  BoneDepth result;
  result.depth_mm.reserve(points.size());
  result.bone.reserve(points.size());
  Vec3 last_found = all.mesh.positions[all.mesh.triangles[0][0]];
  for (const Vec3& p : points) {
    const mesh::NearestTriangle::Hit hit = tree.find(p, (p - last_found).norm() * kReachSlack + 1e-9);
    last_found = hit.point;
    result.depth_mm.push_back(hit.distance);
    result.bone.push_back(all.bone_of_triangle[hit.triangle]);
  }
  return result;
}

}  // namespace palpate::body
