#include "palpate/elements/hex_block.h"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include "palpate/base/error.h"

namespace palpate::elements {

namespace {

constexpr int kHeldHere = -1;

/// A number for each free displacement, kHeldHere for the others.
struct Freedoms {
  explicit Freedoms(const HexBoundary& boundary) {
    numbers.reserve(boundary.held.size());
    for (const bool held : boundary.held) numbers.push_back(held ? kHeldHere : count++);
  }

  std::vector<int> numbers;
  int count = 0;
};

struct Equations {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd right;
  double given_energy = 0.0;  ///< twice that of the given displacements alone
};

Equations assembleEquations(const HexBlock& block, const HexBoundary& boundary, const Freedoms& freedoms) {
  Equations equations;
  equations.right = Eigen::VectorXd::Zero(freedoms.count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(block.nodes()) * 300);
  for (int i = 0; i + 1 < block.alongX(); ++i) {
    for (int j = 0; j + 1 < block.alongY(); ++j) {
      for (int k = 0; k + 1 < block.deep(); ++k) {
        const HexMatrix stiffness = block.elementStiffness(i, j, k);
        const std::array<int, 8> nodes = block.elementNodes(i, j, k);
        std::array<int, 24> places{};
        for (int a = 0; a < 24; ++a) {
          places[static_cast<std::size_t>(a)] = 3 * nodes[static_cast<std::size_t>(a / 3)] + a % 3;
        }
        for (int a = 0; a < 24; ++a) {
          const int place = places[static_cast<std::size_t>(a)];
          const int row = freedoms.numbers[static_cast<std::size_t>(place)];
          for (int b = 0; b < 24; ++b) {
            const int other = places[static_cast<std::size_t>(b)];
            const int column = freedoms.numbers[static_cast<std::size_t>(other)];
            if (row != kHeldHere && column != kHeldHere) {
              entries.emplace_back(row, column, stiffness(a, b));
            } else if (row != kHeldHere) {
              equations.right[row] -= stiffness(a, b) * boundary.given[other];
            } else if (column == kHeldHere) {
              equations.given_energy += boundary.given[place] * stiffness(a, b) * boundary.given[other];
            }
          }
        }
      }
    }
  }
  equations.matrix.resize(freedoms.count, freedoms.count);
  equations.matrix.setFromTriplets(entries.begin(), entries.end());
  return equations;
}

/// Incomplete Cholesky in the grid's own order: a third of the iterations of the sparsest order.
using Solver = Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                                        Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>;

}  // namespace

std::array<int, 8> HexBlock::elementNodes(int i, int j, int k) const {
  std::array<int, 8> all{};
  for (int v = 0; v < 8; ++v) all[static_cast<std::size_t>(v)] = node(i + (v & 1), j + (v >> 1 & 1), k + (v >> 2));
  return all;
}

HexMatrix HexBlock::elementStiffness(int i, int j, int k) const {
  const auto width = [](const std::vector<double>& lines, int l) {
    return lines[static_cast<std::size_t>(l) + 1] - lines[static_cast<std::size_t>(l)];
  };
  const Vec3 size(width(x_mm, i), width(y_mm, j), width(rows.depths_mm, k));
  const auto layer = static_cast<std::size_t>(rows.layers[static_cast<std::size_t>(k)]);
  return hexStiffness(size, stack.layers[layer].young_kpa, stack.poisson);
}

HexMotion solveHexBlock(const HexBlock& block, const HexBoundary& boundary, const char* what) {
  const Freedoms freedoms(boundary);
  const Equations equations = assembleEquations(block, boundary, freedoms);
  Solver solver;
  solver.setTolerance(1e-5);
  solver.setMaxIterations(5000);
  solver.compute(equations.matrix);
  const Eigen::VectorXd free = solver.solve(equations.right);
  if (solver.info() != Eigen::Success) {
    throw Error(fmt::format("the {} was not solved: residual {:.1e} after {} iterations", what, solver.error(),
                            solver.iterations()));
  }
  HexMotion motion{boundary.given, 0.0};
  for (Eigen::Index place = 0; place < motion.displacement.size(); ++place) {
    const int freedom = freedoms.numbers[static_cast<std::size_t>(place)];
    if (freedom != kHeldHere) motion.displacement[place] = free[freedom];
  }
  constexpr double kQuarters = 4.0;
  motion.n_per_mm = 1e-3 * kQuarters * (equations.given_energy - equations.right.dot(free));
  return motion;
}

}  // namespace palpate::elements
