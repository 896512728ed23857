// Judged by what was put in: systems with a known answer, and residuals that the answer must leave.
#include "palpate/base/dense_solve.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"

namespace palpate {
namespace {

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = random.normal();
  return matrix;
}

TEST(DenseSolve, FindsTheSolutionThatTheRightSideWasMadeFrom) {
  for (const Eigen::Index n : {1, 2, 7, 40, 150}) {
    const Eigen::MatrixXd matrix = randomMatrix(n, n, 1);
    const Eigen::MatrixXd wanted = randomMatrix(n, 3, 2);
    EXPECT_LT((solved(matrix, matrix * wanted) - wanted).cwiseAbs().maxCoeff(), 1e-9) << n;
  }
}

TEST(DenseSolve, SwapsRowsWhereTheDiagonalIsZero) {
  const Eigen::Matrix3d matrix{{0.0, 2.0, 0.0}, {0.0, 0.0, 4.0}, {8.0, 0.0, 0.0}};
  EXPECT_EQ(solved(matrix, Eigen::Vector3d(2.0, 4.0, 8.0)), Eigen::Vector3d(1.0, 1.0, 1.0));
}

TEST(DenseSolve, OfASingularMatrixIsNoNumber) {
  const Eigen::Matrix2d matrix{{1.0, 2.0}, {2.0, 4.0}};
  EXPECT_FALSE(solved(matrix, Eigen::Vector2d(1.0, 1.0)).allFinite());
}

TEST(LeastSquares, LeavesARestThatStandsAcrossEveryColumn) {
  const Eigen::MatrixXd matrix = randomMatrix(60, 5, 3);
  const Eigen::VectorXd right = randomMatrix(60, 1, 4);
  const Eigen::VectorXd rest = right - matrix * leastSquares(matrix, right);
  EXPECT_LT((matrix.transpose() * rest).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(rest.norm(), 1.0);
}

TEST(LeastSquares, OfAsManyRowsAsColumnsSolvesTheSystem) {
  const Eigen::MatrixXd matrix = randomMatrix(6, 6, 5);
  const Eigen::VectorXd wanted = randomMatrix(6, 1, 6);
  EXPECT_LT((leastSquares(matrix, matrix * wanted) - wanted).cwiseAbs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace palpate
