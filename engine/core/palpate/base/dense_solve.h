// Dense linear systems solved in one order of arithmetic. Eigen's own factorisations work in blocks whose size follows
// the processor's caches and registers, so that the same system has other last bits on another machine. These are for
// the systems that build a body or a map: some hundred unknowns, before the first tick.
//
// Golub and Van Loan, "Matrix Computations" (4th ed., 2013): 3.4 (partial pivoting) and 5.2, 5.3 (Householder, least
// squares).
#pragma once

#include <Eigen/Core>

namespace palpate {

/// The X with `matrix` X = `right`, by elimination with partial pivoting. `matrix` is n by n and not singular (else the
/// result is not finite), `right` n by m. n^3/3 multiplications. Any thread.
Eigen::MatrixXd solved(Eigen::MatrixXd matrix, Eigen::MatrixXd right);

/// The x of least |`matrix` x - `right`|, by Householder reflections. `matrix` has at least as many rows as columns and
/// independent columns. Any thread.
Eigen::VectorXd leastSquares(Eigen::MatrixXd matrix, const Eigen::VectorXd& right);

}  // namespace palpate
