// Bricks with averaged dilatation, their matrix, and the contact of the ball by an active set.
#include "dissertation/rivals/finite_elements.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::study {

namespace {

constexpr double kPoisson = 0.48;  // as in the truth
constexpr int kBrickUnknowns = 24;
using BrickMatrix = Eigen::Matrix<double, kBrickUnknowns, kBrickUnknowns>;
using StrainMatrix = Eigen::Matrix<double, 6, kBrickUnknowns>;  // xx, yy, zz, xy, yz, zx of engineering

// Corner c of a brick: bit 0 is x, bit 1 is y, bit 2 is z.
double sideOf(int corner, int axis) { return (corner >> axis) % 2 == 0 ? -1.0 : 1.0; }

// Slopes of the eight trilinear functions at a place of the brick, in mm.
std::array<Vec3, 8> slopesAt(const Vec3& place, const Vec3& size) {
  std::array<Vec3, 8> slopes;
  for (int c = 0; c < 8; ++c) {
    const Vec3 side(sideOf(c, 0), sideOf(c, 1), sideOf(c, 2));
    const Vec3 ramp = Vec3::Ones() + side.cwiseProduct(place);
    slopes[c] = 0.25 * Vec3(side.x() * ramp.y() * ramp.z() / size.x(), ramp.x() * side.y() * ramp.z() / size.y(),
                            ramp.x() * ramp.y() * side.z() / size.z());
  }
  return slopes;
}

// The dilatation of every point is replaced by the mean of the brick, which for a box is that of its middle.
StrainMatrix strainAt(const Vec3& place, const Vec3& size) {
  const auto here = slopesAt(place, size);
  const auto middle = slopesAt(Vec3::Zero(), size);
  StrainMatrix strain = StrainMatrix::Zero();
  for (int c = 0; c < 8; ++c) {
    const Vec3& s = here[c];
    const int at = 3 * c;
    for (int axis = 0; axis < 3; ++axis) {
      strain(axis, at + axis) = s[axis];
      for (int row = 0; row < 3; ++row) strain(row, at + axis) += (middle[c][axis] - s[axis]) / 3.0;
    }
    strain(3, at) = s.y();
    strain(3, at + 1) = s.x();
    strain(4, at + 1) = s.z();
    strain(4, at + 2) = s.y();
    strain(5, at) = s.z();
    strain(5, at + 2) = s.x();
  }
  return strain;
}

BrickMatrix brickMatrix(const Vec3& size, double modulus) {
  const double shear = modulus / (2.0 * (1.0 + kPoisson));
  const double lame = modulus * kPoisson / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
  Eigen::Matrix<double, 6, 6> elastic = Eigen::Matrix<double, 6, 6>::Zero();
  elastic.topLeftCorner<3, 3>().setConstant(lame);
  elastic.diagonal() << Vec3::Constant(lame + 2.0 * shear), Vec3::Constant(shear);
  BrickMatrix matrix = BrickMatrix::Zero();
  const double gauss = 1.0 / std::sqrt(3.0);
  const double weight = size.prod() / 8.0;
  for (int point = 0; point < 8; ++point) {
    const StrainMatrix strain = strainAt(gauss * Vec3(sideOf(point, 0), sideOf(point, 1), sideOf(point, 2)), size);
    matrix += weight * strain.transpose() * elastic * strain;
  }
  return matrix;
}

std::vector<int> numberedUnknowns(const TissueBlock& block) {
  std::vector<int> unknown_of(3 * block.nodes(), -1);
  int next = 0;
  for (std::size_t n = 0; n < block.nodes(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!block.isFixed(n, axis)) unknown_of[3 * n + static_cast<std::size_t>(axis)] = next++;
    }
  }
  return unknown_of;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

void addBrick(Triplets& triplets, const std::vector<int>& unknown_of, const std::array<std::size_t, 8>& corners,
              const BrickMatrix& matrix) {
  for (int a = 0; a < kBrickUnknowns; ++a) {
    const int row = unknown_of[3 * corners[a / 3] + static_cast<std::size_t>(a % 3)];
    for (int b = 0; b < kBrickUnknowns; ++b) {
      const int column = unknown_of[3 * corners[b / 3] + static_cast<std::size_t>(b % 3)];
      if (row >= 0 && column >= 0 && column <= row) triplets.emplace_back(row, column, matrix(a, b));
    }
  }
}

Eigen::SparseMatrix<double> assembled(const TissueBlock& block, const std::vector<int>& unknown_of, int unknowns) {
  Triplets triplets;
  for (int k = 0; k < block.rows(); ++k) {
    const BrickMatrix matrix =
        brickMatrix(Vec3(block.spacing(), block.spacing(), block.rowHeight(k)), block.rowModulus(k));
    for (int j = 0; j < block.cells(); ++j) {
      for (int i = 0; i < block.cells(); ++i) {
        std::array<std::size_t, 8> corners{};
        for (int c = 0; c < 8; ++c) corners[c] = block.node(i + c % 2, j + c / 2 % 2, k + c / 4);
        addBrick(triplets, unknown_of, corners, matrix);
      }
    }
  }
  Eigen::SparseMatrix<double> lower(unknowns, unknowns);
  lower.setFromTriplets(triplets.begin(), triplets.end());
  return lower;
}

}  // namespace

FiniteElements::FiniteElements(const TissueBlock& block) : block_(block), unknown_of_(numberedUnknowns(block)) {
  unknowns_ = 1 + static_cast<std::size_t>(*std::max_element(unknown_of_.begin(), unknown_of_.end()));
  factor_.compute(assembled(block, unknown_of_, static_cast<int>(unknowns_)));
  if (factor_.info() != Eigen::Success) throw Error("study rivals: the elements' matrix cannot be factorised");
}

const FiniteElements::Answer& FiniteElements::answerAt(std::size_t vertex) {
  for (const Answer& answer : answers_) {
    if (answer.vertex == vertex) return answer;
  }
  const std::size_t top = block_.firstTopNode();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns_));
  force[unknown_of_[3 * (top + vertex) + 2]] = -1.0;
  const Eigen::VectorXd moved = factor_.solve(force);
  Answer answer{.vertex = vertex, .displacements = std::vector<Vec3>(block_.nodesOfALevel(), Vec3::Zero())};
  for (std::size_t v = 0; v < answer.displacements.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const int unknown = unknown_of_[3 * (top + v) + static_cast<std::size_t>(axis)];
      if (unknown >= 0) answer.displacements[v][axis] = moved[unknown];
    }
  }
  answers_.push_back(std::move(answer));
  return answers_.back();
}

PressedSurface FiniteElements::press(double central_depth_mm) {
  const std::size_t top = block_.firstTopNode();
  const auto wanted = [&](std::size_t v) {
    return ballDepth(block_.place(top + v).head<2>().norm(), central_depth_mm);
  };
  answers_.reserve(block_.nodesOfALevel());  // answers are kept by reference below
  std::vector<std::size_t> touched{block_.nodesOfALevel() / 2};
  PressedSurface pressed;
  constexpr int kMaxRounds = 50;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto count = static_cast<Eigen::Index>(touched.size());
    Eigen::MatrixXd answer_between(count, count);
    Eigen::VectorXd depth(count);
    for (Eigen::Index b = 0; b < count; ++b) {
      const Answer& answer = answerAt(touched[static_cast<std::size_t>(b)]);
      depth[b] = wanted(touched[static_cast<std::size_t>(b)]);
      for (Eigen::Index a = 0; a < count; ++a) {
        answer_between(a, b) = -answer.displacements[touched[static_cast<std::size_t>(a)]].z();
      }
    }
    const Eigen::VectorXd forces = answer_between.ldlt().solve(depth);
    // A node that the ball would have to pull is released; otherwise nodes that end inside the ball are added.
    Eigen::Index pulled = 0;
    if (forces.minCoeff(&pulled) < 0.0) {
      touched.erase(touched.begin() + pulled);
      continue;
    }
    pressed.force_n = forces.sum();
    pressed.displacements.assign(block_.nodesOfALevel(), Vec3::Zero());
    for (Eigen::Index b = 0; b < count; ++b) {
      const Answer& answer = answerAt(touched[static_cast<std::size_t>(b)]);
      for (std::size_t v = 0; v < answer.displacements.size(); ++v) {
        pressed.displacements[v] += forces[b] * answer.displacements[v];
      }
    }
    const std::size_t before = touched.size();
    for (std::size_t v = 0; v < pressed.displacements.size(); ++v) {
      constexpr double kTouching = 1e-6;  // mm
      if (-pressed.displacements[v].z() < wanted(v) - kTouching &&
          std::find(touched.begin(), touched.end(), v) == touched.end()) {
        touched.push_back(v);
      }
    }
    if (touched.size() == before) break;
  }
  return pressed;
}

std::size_t FiniteElements::bytes() const {
  const auto& lower = factor_.matrixL().nestedExpression();
  return static_cast<std::size_t>(lower.nonZeros()) * (sizeof(double) + sizeof(int));
}

std::size_t FiniteElements::bytesOfAllAnswers() const {
  const std::size_t vertices = block_.nodesOfALevel();
  return vertices * vertices * sizeof(Vec3);
}

}  // namespace palpate::study
