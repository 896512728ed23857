// A way over the skin, straight ahead as seen along a normal: the section of the surface with a plane that holds the
// normal, crossing by crossing, from triangle to triangle across their edges.
//
// How far a region reaches in a direction is counted along it. No allocation.
#pragma once

#include <array>

#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

class SectionWalk {
 public:
  /// Where the section leaves a triangle.
  struct Crossing {
    Vec3 point = Vec3::Zero();
    std::array<Index, 2> vertices = {kNoIndex, kNoIndex};  ///< of the mesh, at the ends of the edge crossed
    double share = 0.0;                                    ///< of the way from the first to the second
  };

  /// From a point of the triangle `record`. `normal` and `ahead` are unit vectors at right angles.
  SectionWalk(const tree::TriangleTree& tree, Index record, const Vec3& from, const Vec3& normal,
              const Vec3& ahead) noexcept;

  /// The next crossing; false where the surface ends. Walks on round a closed body for ever.
  bool next(Crossing& crossing) noexcept;

 private:
  double sideOf(const Vec3& corner) const noexcept { return across_.dot(corner - from_); }
  /// Goes on by the edge of the record, whose ends lie on these sides.
  void leaveBy(std::size_t edge, double first, double second) noexcept;

  const tree::TriangleTree& tree_;
  Vec3 from_, across_;
  Index record_ = kNoIndex;  ///< to be left by `exit_`; kNoIndex at the end
  std::size_t exit_ = 0;
  double first_ = 0.0;  ///< how far the ends of that edge lie from the plane
  double second_ = 0.0;
};

}  // namespace palpate::scene
