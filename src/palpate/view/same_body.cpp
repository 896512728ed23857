#include "palpate/view/same_body.h"

#include <algorithm>

namespace palpate::view {

namespace {

bool areSame(const mesh::TriangleMesh& a, const mesh::TriangleMesh& b) {
  return a.triangles == b.triangles && a.positions == b.positions;
}

}  // namespace

bool haveSameBody(const scene::World& a, const scene::World& b) {
  const auto same_bone = [](const body::Bone& p, const body::Bone& q) { return areSame(p.mesh, q.mesh); };
  return a.texture == b.texture && areSame(a.skin, b.skin) &&
         std::equal(a.anatomy.bones.begin(), a.anatomy.bones.end(), b.anatomy.bones.begin(), b.anatomy.bones.end(),
                    same_bone);
}

}  // namespace palpate::view
