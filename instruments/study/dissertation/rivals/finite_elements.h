// Rival 1 of Table 4.1: linear finite elements, "most accurate", "very expensive computation cost".
//
// Bricks of eight nodes, the change of volume averaged over each so that nearly incompressible tissue does not lock.
// The matrix is factorised once a body. A press then needs the answer of the skin to a unit force at each node that the
// ball turns out to touch - one solution each - and finds the forces that keep the skin out of the ball. Where the
// answers of all nodes of the skin are computed beforehand, only the last step is left of a press.
// Based on: Hughes, "Generalization of selective integration procedures to anisotropic and nonlinear media", 1980 (the
// brick); Bro-Nielsen and Cotin, "Real-time volumetric deformable models for surgery simulation using finite elements
// and condensation", 1996, and James and Pai, "ArtDefo", 1999 (answers computed beforehand).
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "dissertation/rivals/pressed_surface.h"
#include "dissertation/rivals/tissue_block.h"

namespace palpate::study {

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
  std::size_t bytes() const;  ///< size of the factor
  /// Size of the answers of every node of the skin, if kept for any press.
  std::size_t bytesOfAllAnswers() const;

 private:
  struct Answer {
    std::size_t vertex;               ///< vertex of the skin where the force acts
    std::vector<Vec3> displacements;  ///< displacements of the skin by 1 N inward, mm
  };
  const Answer& answerAt(std::size_t vertex);

  const TissueBlock& block_;
  std::vector<int> unknown_of_;  ///< index for node * 3 + axis; -1 where it is fixed
  std::size_t unknowns_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  std::vector<Answer> answers_;
};

}  // namespace palpate::study
