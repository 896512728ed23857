// The generalised winding number of a surface in a microsecond: 1 inside a closed body, 0 outside, 2 where two bodies
// overlap, a share in between near a hole.
//
// For oracles that run in every tick; `windingNumber` of surface_side.h is the exact sum that this one is tested
// against.
#pragma once

#include <vector>

#include "lab/judges/box_tree.h"

namespace palpate::lab {

class FastWinding {
 public:
  /// The tree must outlive this.
  explicit FastWinding(const BoxTree& tree);

  /// Within about 0.01 of the exact sum (instruments/study/lab/tests/lab/fast_winding_test.cpp).
  double at(const Vec3& point) const;

 private:
  /// A node's triangles from afar.
  struct Dipole {
    Vec3 centre = Vec3::Zero();  ///< centre of their area
    Vec3 area = Vec3::Zero();    ///< sum of area vectors
    Mat3 spread = Mat3::Zero();  ///< sum of (centre of triangle - centre) x area vector: the term after the dipole
    double far2 = 0.0;           ///< squared distance from which on it replaces them
  };
  void summarise(Index node);

  const BoxTree& tree_;
  std::vector<Dipole> dipoles_;  ///< per node
};

}  // namespace palpate::lab
