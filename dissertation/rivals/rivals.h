// The rivals of Table 4.1, which press the same block of tissue: linear finite elements, masses and springs, free-form
// deformation.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "dissertation/rivals/tissue_block.h"

namespace palpate::study {

struct PressedSurface {
  std::vector<Vec3> displacements;  ///< mm, of the vertices of TissueBlock::skin()
  double force_n = 0.0;
};

// Rival 1 of Table 4.1: linear finite elements, "most accurate", "very expensive computation cost".
//
// Bricks of eight nodes, the change of volume averaged over each so that nearly incompressible tissue does not lock.
// The matrix is factorised once a body. A press then asks for the answer of the skin to a unit force at each node that
// the ball turns out to touch - one solution each - and finds the forces that keep the skin out of the ball. Where the
// answers of all nodes of the skin are computed beforehand, what is left of a press is the last step.
// Based on: Hughes, "Generalization of selective integration procedures to anisotropic and nonlinear media", 1980 (the
// brick); Bro-Nielsen and Cotin, "Real-time volumetric deformable models for surgery simulation using finite elements
// and condensation", 1996, and James and Pai, "ArtDefo", 1999 (answers computed beforehand).

class FiniteElements {
 public:
  /// Assembles and factorises. Throws Error where the matrix cannot be factorised.
  explicit FiniteElements(const TissueBlock& block);

  /// A ball of kBallRadiusMm in the middle, without friction. Solves for the answers that it lacks.
  PressedSurface press(double central_depth_mm);

  /// Computes nothing again: the next press starts as the first one did.
  void forgetAnswers() { answers_.clear(); }
  std::size_t answers() const { return answers_.size(); }
  std::size_t unknowns() const { return unknowns_; }
  std::size_t bytes() const;  ///< of the factor
  /// Of the answers of every node of the skin, as they would be kept for any press.
  std::size_t bytesOfAllAnswers() const;

 private:
  struct Answer {
    std::size_t vertex;               ///< of the skin, where the force acts
    std::vector<Vec3> displacements;  ///< of the skin by 1 N inward, mm
  };
  const Answer& answerAt(std::size_t vertex);

  const TissueBlock& block_;
  std::vector<int> unknown_of_;  ///< of node * 3 + axis; -1 where it is fixed
  std::size_t unknowns_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  std::vector<Answer> answers_;
};

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

class MassSpring {
 public:
  explicit MassSpring(const TissueBlock& block);

  /// From rest until no free node feels more than a thousandth of the ball's force.
  PressedSurface press(double central_depth_mm);

  std::size_t springs() const { return springs_.size(); }
  int steps() const { return steps_; }  ///< of the last press
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

// Rival 3 of Table 4.1: free-form deformation, "fast", "not accurate, need manipulation".
//
// A lattice of control points around the body carries cubic B-splines. The user drags one point of the skin: of all
// moves of the control points that take it along, the smallest is taken. Nothing here knows what lies under the skin;
// how far a press reaches is the spacing of the lattice, which somebody has to choose. Based on: Sederberg and Parry,
// "Free-form deformation of solid geometric models", 1986; Hsu, Hughes and Kaufman, "Direct manipulation of free-form
// deformations", 1992 (B-splines, and the least move).

class FreeForm {
 public:
  /// A control point lies under the middle of the skin.
  FreeForm(const TissueBlock& block, double lattice_mm);

  /// Where the vertices of the skin go when its middle is dragged there.
  std::vector<Vec3> press(double central_depth_mm);

  std::size_t controlPoints() const { return moves_.size(); }
  std::size_t bytes() const;

 private:
  /// The four control points along one axis that a place follows, and how much.
  struct Follow {
    int first = 0;
    std::array<double, 4> weights{};
  };
  struct Vertex {
    std::array<Follow, 3> along;
  };
  Vertex vertexAt(const Vec3& place) const;
  template <class Function>
  void forEachControl(const Vertex& vertex, const Function& function) const;

  double lattice_mm_;
  std::array<int, 3> points_{};  ///< of the lattice along each axis
  Vec3 origin_ = Vec3::Zero();
  std::vector<Vertex> vertices_;
  std::vector<Vec3> moves_;  ///< of the control points
  Vertex middle_;
};

}  // namespace palpate::study
