// Two walks over the nodes: that of the scene shows meshes, that of all nodes places joints, which may hang outside of
// the scene. A joint's motion is its place times its inverse bind matrix; read_gltf.cpp blends them by a vertex's
// weights.
#include "palpate/mesh/files/detail/gltf_pose.h"

#include <algorithm>

namespace palpate::mesh {

namespace {

Eigen::Affine3d readMatrix(JsonValue node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  const auto numbers = node["matrix"].items();
  if (numbers.size() != 16) node["matrix"].fail("a matrix needs 16 numbers");
  for (Eigen::Index i = 0; i < 16; ++i) {
    transform.matrix()(i % 4, i / 4) = numbers[static_cast<std::size_t>(i)].number();
  }
  transform.makeAffine();
  return transform;
}

Eigen::Affine3d readTransform(JsonValue node) {
  if (node["matrix"]) return readMatrix(node);
  return composed(vectorOr<3>(node["translation"], Vec3::Zero()),
                  vectorOr<4>(node["rotation"], Eigen::Vector4d(0, 0, 0, 1)), vectorOr<3>(node["scale"], Vec3::Ones()));
}

}  // namespace

Eigen::Affine3d composed(const Vec3& move, const Eigen::Vector4d& turn, const Vec3& scale) {
  const Eigen::Quaterniond rotation(turn.w(), turn.x(), turn.y(), turn.z());
  return Eigen::Translation3d(move) * rotation.normalized() * Eigen::Scaling(scale);
}

GltfPose::GltfPose(JsonValue root)
    : root_(root),
      nodes_(root["nodes"].items()),
      shown_(nodes_.size(), false),
      skins_(root["skins"].items()),
      joints_(skins_.size()) {}

void GltfPose::showScene(const Show& show) {
  walk(roots(), shown_, [&](std::size_t n, const Eigen::Affine3d& transform) { show(nodes_[n], transform); });
}

/// The nodes of the file's default scene; without scenes all nodes without a parent.
std::vector<std::size_t> GltfPose::roots() const {
  const auto scenes = root_["scenes"].items();
  if (scenes.empty()) return orphans();
  const JsonValue chosen = root_["scene"];
  return nodeIndices(scenes[chosen ? chosen.index(scenes.size(), "scene") : 0]["nodes"]);
}

std::vector<std::size_t> GltfPose::orphans() const {
  std::vector<bool> is_child(nodes_.size(), false);
  for (const JsonValue node : nodes_) {
    for (std::size_t child : nodeIndices(node["children"])) is_child[child] = true;
  }
  std::vector<std::size_t> result;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (!is_child[n]) result.push_back(n);
  }
  return result;
}

std::vector<std::size_t> GltfPose::nodeIndices(JsonValue list) const {
  std::vector<std::size_t> indices;
  for (const JsonValue item : list.items()) indices.push_back(item.index(nodes_.size(), "node"));
  return indices;
}

/// Depth first with a stack of its own: a chain of a million nodes is legal.
void GltfPose::walk(const std::vector<std::size_t>& roots, std::vector<bool>& visited, const Visit& visit) const {
  struct Pending {
    std::size_t node;
    Eigen::Affine3d parent;
  };
  std::vector<Pending> pending;
  const auto push = [&](std::vector<std::size_t> nodes, const Eigen::Affine3d& parent) {
    std::reverse(nodes.begin(), nodes.end());  // the first comes off the stack first
    for (const std::size_t node : nodes) {
      if (visited[node]) nodes_[node].fail("the node is shown twice: nodes must form a tree");
      visited[node] = true;
      pending.push_back({node, parent});
    }
  };
  push(roots, Eigen::Affine3d::Identity());
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    const JsonValue node = nodes_[next.node];
    const Eigen::Affine3d transform = next.parent * readTransform(node);
    visit(next.node, transform);
    push(nodeIndices(node["children"]), transform);
  }
}

/// Joints may hang elsewhere than the mesh that they carry.
void GltfPose::placeJoints() {
  is_placed_.assign(nodes_.size(), false);
  places_.assign(nodes_.size(), Eigen::Affine3d::Identity());
  walk(orphans(), is_placed_, [&](std::size_t n, const Eigen::Affine3d& transform) { places_[n] = transform; });
}

const std::vector<Eigen::Affine3d>& GltfPose::jointMotions(JsonValue skin_index, GltfAccessors& accessors) {
  const std::size_t s = skin_index.index(skins_.size(), "skin");
  std::vector<Eigen::Affine3d>& result = joints_[s];
  if (!result.empty()) return result;
  if (is_placed_.empty()) placeJoints();
  const JsonValue skin = skins_[s];
  const std::vector<std::size_t> joints = nodeIndices(skin["joints"]);
  if (joints.empty()) skin.fail("a skin without joints");
  std::vector<Eigen::Matrix4d> inverse_bind;
  if (const JsonValue accessor = skin["inverseBindMatrices"]) {
    inverse_bind = accessors.vectors<Eigen::Matrix4d>(accessor);
    if (inverse_bind.size() < joints.size()) {
      skin.fail(fmt::format("{} joints, but {} inverse bind matrices", joints.size(), inverse_bind.size()));
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!is_placed_[joints[j]]) skin.fail("a joint within a loop of nodes");
    Eigen::Affine3d to_joint = Eigen::Affine3d::Identity();
    if (!inverse_bind.empty()) to_joint.matrix() = inverse_bind[j];
    to_joint.makeAffine();
    result.push_back(places_[joints[j]] * to_joint);
  }
  return result;
}

}  // namespace palpate::mesh
