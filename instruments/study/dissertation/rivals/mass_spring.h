// Rival 2 of Table 4.1: masses and springs, "fast", "linear simulation".
//
// The nodes of the same block, joined along the edges of its cells and across their faces. With these stiffnesses a
// grid of cubes has the modulus of its tissue and, as every lattice of central springs, a Poisson ratio of 1/4: tissue,
// which keeps its volume, cannot be had. Springs keep their directions, so that forces are linear in the displacements
// ("linear simulation"). A press is relaxed step by step: explicit, fictitious masses that make every node as quick as
// is stable, and a stop of all motion whenever its energy has passed a peak.
// Based on: Terzopoulos, Platt, Barr and Fleischer, "Elastically deformable models", 1987; Van Gelder, "Approximate
// simulation of elastic membranes by triangulated spring meshes", 1998 (stiffness by the volume around a spring);
// Barnes, "Form finding and analysis of tension structures by dynamic relaxation", 1999 (kinetic damping).
#pragma once

#include <vector>

#include "dissertation/rivals/pressed_surface.h"
#include "dissertation/rivals/tissue_block.h"

namespace palpate::study {

class MassSpring {
 public:
  explicit MassSpring(const TissueBlock& block);

  /// From rest until no free node feels more than a thousandth of the ball's force.
  PressedSurface press(double central_depth_mm);

  std::size_t springs() const { return springs_.size(); }
  int steps() const { return steps_; }  ///< in the last press
  std::size_t bytes() const;

 private:
  struct Spring {
    Index from;
    Index to;
    Vec3 along;  ///< unit, times the root of the stiffness in N/mm
  };
  void addForces();
  double moveAll(bool from_standstill);
  double holdOutOfBall(double central_depth_mm);
  double restlessForce() const;

  const TissueBlock& block_;
  std::vector<Spring> springs_;
  std::vector<double> masses_;  ///< fictitious, with a time step of 1
  std::vector<Vec3> displacements_;
  std::vector<Vec3> velocities_;
  std::vector<Vec3> forces_;
  std::vector<bool> touched_;  ///< a vertex of the skin each
  int steps_ = 0;
};

}  // namespace palpate::study
