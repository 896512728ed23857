// The poses of a glTF file's meshes: the tree of nodes, and the joints that move a skinned mesh.
//
// Based on: Khronos Group, glTF 2.0 specification, 3.5 (scenes, nodes) and 3.7.3 (skins).
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/files/detail/gltf_data.h"
#include "palpate/mesh/files/detail/json.h"

namespace palpate::mesh {

/// `Size` numbers, or the fallback without an array. Throws Error for another count.
template <int Size>
Eigen::Matrix<double, Size, 1> vectorOr(JsonValue array, const Eigen::Matrix<double, Size, 1>& fallback) {
  if (!array) return fallback;
  const auto numbers = array.items();
  if (numbers.size() != Size) array.fail(fmt::format("{} numbers are expected", Size));
  Eigen::Matrix<double, Size, 1> result;
  for (std::size_t i = 0; i < Size; ++i) result[static_cast<Eigen::Index>(i)] = numbers[i].number();
  return result;
}

/// A node's move, turn (x, y, z, w) and scale in one.
Eigen::Affine3d composed(const Vec3& move, const Eigen::Vector4d& turn, const Vec3& scale);

class GltfPose {
 public:
  explicit GltfPose(JsonValue root);

  std::size_t nodes() const { return nodes_.size(); }
  JsonValue node(std::size_t n) const { return nodes_[n]; }
  bool isShown(std::size_t n) const { return shown_[n]; }

  /// Calls show(node, transform) for each node of the file's default scene, parents first; without scenes for all
  /// nodes. Throws Error where nodes do not form a tree.
  using Show = std::function<void(JsonValue node, const Eigen::Affine3d& transform)>;
  void showScene(const Show& show);

  /// The motion of a vertex that a joint alone moves: the joint's place now, from where it was when the skin was made.
  /// One per joint of the skin. Throws Error.
  const std::vector<Eigen::Affine3d>& jointMotions(JsonValue skin_index, GltfAccessors& accessors);

 private:
  using Visit = std::function<void(std::size_t node, const Eigen::Affine3d& transform)>;
  std::vector<std::size_t> roots() const;
  std::vector<std::size_t> orphans() const;
  std::vector<std::size_t> nodeIndices(JsonValue list) const;
  void walk(const std::vector<std::size_t>& roots, std::vector<bool>& visited, const Visit& visit) const;
  void placeJoints();

  JsonValue root_;
  std::vector<JsonValue> nodes_;
  std::vector<bool> shown_;
  std::vector<JsonValue> skins_;
  std::vector<std::vector<Eigen::Affine3d>> joints_;  // per skin; empty: not computed yet
  std::vector<bool> is_placed_;                       // for joints: the nodes that hang under some root
  std::vector<Eigen::Affine3d> places_;
};

}  // namespace palpate::mesh
