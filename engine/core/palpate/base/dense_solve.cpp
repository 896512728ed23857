// Both work on columns, which lie in a row in memory, and add each sum from the front: the order of additions is the
// code's, not the processor's. Signs of the reflections avoid cancellation (Golub and Van Loan, 5.1.3).
#include "palpate/base/dense_solve.h"

#include <cmath>
#include <span>

namespace palpate {
namespace {

std::span<double> columnFrom(Eigen::MatrixXd& matrix, Eigen::Index column, Eigen::Index row) {
  return {matrix.data() + column * matrix.rows() + row, static_cast<std::size_t>(matrix.rows() - row)};
}

void subtract(std::span<double> from, double factor, std::span<const double> column) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= factor * column[i];
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Eigen::Index largestBelow(const Eigen::MatrixXd& matrix, Eigen::Index column) {
  Eigen::Index largest = column;
  for (Eigen::Index i = column + 1; i < matrix.rows(); ++i)
    if (std::abs(matrix(i, column)) > std::abs(matrix(largest, column))) largest = i;
  return largest;
}

/// Solves with the upper triangle of the first columns.
void substituteBack(Eigen::MatrixXd& matrix, Eigen::MatrixXd& right) {
  for (Eigen::Index j = 0; j < right.cols(); ++j) {
    for (Eigen::Index k = matrix.cols() - 1; k >= 0; --k) {
      right(k, j) /= matrix(k, k);
      for (Eigen::Index i = 0; i < k; ++i) right(i, j) -= right(k, j) * matrix(i, k);
    }
  }
}

}  // namespace

Eigen::MatrixXd solved(Eigen::MatrixXd matrix, Eigen::MatrixXd right) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index pivot = largestBelow(matrix, k);
    if (pivot != k) {
      matrix.row(k).swap(matrix.row(pivot));
      right.row(k).swap(right.row(pivot));
    }
    const std::span<double> factors = columnFrom(matrix, k, k + 1);
    for (double& factor : factors) factor /= matrix(k, k);
    for (Eigen::Index j = k + 1; j < n; ++j) subtract(columnFrom(matrix, j, k + 1), matrix(k, j), factors);
    for (Eigen::Index j = 0; j < right.cols(); ++j) subtract(columnFrom(right, j, k + 1), right(k, j), factors);
  }
  substituteBack(matrix, right);
  return right;
}

Eigen::VectorXd leastSquares(Eigen::MatrixXd matrix, const Eigen::VectorXd& right) {
  Eigen::MatrixXd rest = right;
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    const std::span<double> column = columnFrom(matrix, k, k);
    const double length = std::sqrt(dot(column, column));
    const double onto = column[0] > 0.0 ? -length : length;  // away from the column's head: no cancellation
    column[0] -= onto;
    const double half = 0.5 * dot(column, column);
    if (half > 0.0) {
      for (Eigen::Index j = k + 1; j < matrix.cols(); ++j) {
        const std::span<double> other = columnFrom(matrix, j, k);
        subtract(other, dot(column, other) / half, column);
      }
      const std::span<double> aim = columnFrom(rest, 0, k);
      subtract(aim, dot(column, aim) / half, column);
    }
    column[0] = onto;
  }
  Eigen::MatrixXd head = rest.topRows(matrix.cols());
  substituteBack(matrix, head);
  return head;
}

}  // namespace palpate
