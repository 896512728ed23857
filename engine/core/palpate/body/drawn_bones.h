// From the shapes of bones (bone_shapes.h, skeleton/skeleton_shapes.h) to the bones of a body: each shape reduced to
// its share of the triangles (mesh/decimate.h), mirrored and put in its place. bones.cpp and skeleton/skeleton.cpp have
// the lists of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "palpate/body/bone_shapes.h"
#include "palpate/body/bones.h"

namespace palpate::body {

/// A half of the midline, to be joined with its mirror image, or a right bone, to be mirrored for the left. Ribs, and
/// cartilages likewise, come in two rows, first all right ones and then all left ones; other pairs side by side.
struct BonePlan {
  std::string name;  ///< without its side
  BoneKind kind;
  double weight;  ///< share in the triangles, relative: the visible error after reduction is alike
  bool midline;
  std::function<mesh::TriangleMesh(double cell_mm)> shape;  ///< by the grid of a vertebra
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
};

/// Edge of bones that are swept along a line and need no grid; a longer one would cross in the bend of a rib's neck.
inline constexpr double kSweptEdgeMm = 2.2;

/// Plans a vertebra, T1 to L5. `row` must live as long as the plan.
BonePlan vertebraPlan(const VertebraRow& row);
/// Plans rib `number` in 1..12; `row` likewise.
BonePlan ribPlan(int number, const RibRow& row, SweptEnd anterior = {});
BonePlan scapulaPlan(const ScapulaPlace& place);

struct DrawnBones {
  std::vector<BonePlan> plans;
  const char* need;       ///< "the bones need", for an error
  std::size_t fewest;     ///< triangles
  std::size_t fine_from;  ///< triangles from which the grid is fine

  /// Shares a total out over the bones in order: even counts whose sum is the total, mirror images equal.
  std::vector<std::size_t> share(std::size_t total) const;
  /// Works on two threads where there are two. `cell_mm`: grid of a vertebra; 0: fits the triangles. Throws Error on a
  /// wrong number of triangles or cell.
  std::vector<Bone> draw(std::size_t triangles, double cell_mm) const;
};

}  // namespace palpate::body
