// The sparse symmetric matrix of a mesh: where the entries of every element lie is found once, and so is the order of
// elimination; each Newton step only fills in and factorises.
//
// Based on: Eigen, SimplicialLDLT with approximate minimum degree; compared with CHOLMOD in
// docs/explanation/tissue.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "palpate/elements/quad_element.h"
#include "palpate/elements/quad_mesh.h"
#include "palpate/elements/sphere_contact.h"

namespace palpate::elements {

class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const QuadMesh& mesh);

  void clear();
  void add(std::size_t element, const std::array<double, kQuadEntries>& entries);
  void add(const std::array<int, 3>& edge, const EdgeAnswer& answer);

  /// Returns the number of negative pivots: 0 where the energy is convex, so that every step goes downhill; -1 where
  /// the matrix is singular.
  int factorise();
  /// With the last factors.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return factors_.solve(right); }

  const Eigen::SparseMatrix<double>& lower() const { return lower_; }

 private:
  int placeOf(int row, int column) const;

  const QuadMesh& mesh_;
  Eigen::SparseMatrix<double> lower_;
  std::vector<std::array<int, kQuadEntries>> places_;  ///< in the values of `lower_`; kHeld: none
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
};

}  // namespace palpate::elements
