#include "palpate/elements/quad_element.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::elements {

namespace {

struct Shape {
  std::array<double, kQuadNodes> value{};
  std::array<double, kQuadNodes> along_x{};
  std::array<double, kQuadNodes> along_y{};
};

/// Serendipity functions of the square from -1 to 1.
Shape shapeAt(double x, double y) {
  constexpr std::array<double, 4> kX = {-1, 1, 1, -1};
  constexpr std::array<double, 4> kY = {-1, -1, 1, 1};
  Shape s;
  for (std::size_t a = 0; a < 4; ++a) {
    const double px = 1.0 + kX[a] * x;
    const double py = 1.0 + kY[a] * y;
    s.value[a] = 0.25 * px * py * (kX[a] * x + kY[a] * y - 1.0);
    s.along_x[a] = 0.25 * kX[a] * py * (2.0 * kX[a] * x + kY[a] * y);
    s.along_y[a] = 0.25 * kY[a] * px * (kX[a] * x + 2.0 * kY[a] * y);
  }
  for (const auto& [a, side] : {std::pair{std::size_t{4}, -1.0}, std::pair{std::size_t{6}, 1.0}}) {
    s.value[a] = 0.5 * (1.0 - x * x) * (1.0 + side * y);
    s.along_x[a] = -x * (1.0 + side * y);
    s.along_y[a] = 0.5 * side * (1.0 - x * x);
  }
  for (const auto& [a, side] : {std::pair{std::size_t{5}, 1.0}, std::pair{std::size_t{7}, -1.0}}) {
    s.value[a] = 0.5 * (1.0 + side * x) * (1.0 - y * y);
    s.along_x[a] = 0.5 * side * (1.0 - y * y);
    s.along_y[a] = -(1.0 + side * x) * y;
  }
  return s;
}

/// Elements are rectangles at rest.
QuadPoint pointAt(const QuadMesh& mesh, const std::array<int, 8>& nodes, double x, double y, double weight) {
  const auto r = [&](std::size_t a) { return mesh.r[static_cast<std::size_t>(nodes[a])]; };
  const auto z = [&](std::size_t a) { return mesh.z[static_cast<std::size_t>(nodes[a])]; };
  const double half_width = 0.5 * (r(1) - r(0));
  const double half_height = 0.5 * (z(3) - z(0));
  const double radius = r(0) + half_width * (1.0 + x);
  const Shape shape = shapeAt(x, y);
  QuadPoint point;
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    point.along_r[a] = shape.along_x[a] / half_width;
    point.along_z[a] = shape.along_y[a] / half_height;
    point.hoop[a] = shape.value[a] / radius;
  }
  point.volume = weight * half_width * half_height * 2.0 * std::numbers::pi * radius;
  return point;
}

/// Lifts eigenvalues to a small share of the law's own.
void makeConvex(Answer& answer, double least) {
  Eigen::Matrix<double, kGradients, kGradients> full;
  for (std::size_t a = 0; a < kGradients; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      full(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = answer.stiffness[a][b];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kGradients, kGradients>> solver(full);
  if (solver.eigenvalues()[0] >= least) return;
  full = solver.eigenvectors() * solver.eigenvalues().cwiseMax(least).asDiagonal() * solver.eigenvectors().transpose();
  for (std::size_t a = 0; a < kGradients; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      answer.stiffness[a][b] = full(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
    }
  }
}

void addForces(const QuadPoint& point, const Gradient& stress, QuadVector& forces) {
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    forces[2 * a] += point.volume * (stress[0] * point.along_r[a] + stress[1] * point.along_z[a] +  //
                                     stress[4] * point.hoop[a]);
    forces[2 * a + 1] += point.volume * (stress[2] * point.along_r[a] + stress[3] * point.along_z[a]);
  }
}

void addStiffness(const QuadPoint& point, const Answer& law, std::array<double, kQuadEntries>& entries) {
  std::array<std::array<double, kGradients>, kGradients> full = law.stiffness;
  for (std::size_t a = 0; a < kGradients; ++a) {
    for (std::size_t b = 0; b <= a; ++b) full[b][a] = full[a][b] = point.volume * law.stiffness[a][b];
  }
  std::array<Gradient, kQuadFreedoms> stresses;  // for each freedom's unit displacement
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    for (std::size_t i = 0; i < kGradients; ++i) {
      stresses[2 * a][i] = full[i][0] * point.along_r[a] + full[i][1] * point.along_z[a] + full[i][4] * point.hoop[a];
      stresses[2 * a + 1][i] = full[i][2] * point.along_r[a] + full[i][3] * point.along_z[a];
    }
  }
  double* entry = entries.data();
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    const double dr = point.along_r[a];
    const double dz = point.along_z[a];
    const double hoop = point.hoop[a];
    for (std::size_t j = 0; j <= 2 * a; ++j) {
      *entry++ += dr * stresses[j][0] + dz * stresses[j][1] + hoop * stresses[j][4];
    }
    for (std::size_t j = 0; j <= 2 * a + 1; ++j) *entry++ += dr * stresses[j][2] + dz * stresses[j][3];
  }
}

}  // namespace

namespace {

/// On the square from -1 to 1, those of shear first.
struct QuadPlace {
  double x = 0.0;
  double y = 0.0;
  double weight = 0.0;
};

std::array<QuadPlace, kQuadPoints> quadRule() {
  std::array<QuadPlace, kQuadPoints> rule;
  std::size_t next = 0;
  const double at3 = std::sqrt(0.6);
  const std::array<std::pair<double, double>, 3> three = {{{-at3, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {at3, 5.0 / 9.0}}};
  for (const auto& [x, wx] : three) {
    for (const auto& [y, wy] : three) rule[next++] = {x, y, wx * wy};
  }
  const double at2 = 1.0 / std::sqrt(3.0);
  for (const double x : {-at2, at2}) {
    for (const double y : {-at2, at2}) rule[next++] = {x, y, 1.0};
  }
  return rule;
}

template <class LawAt>
void addUpQuad(const QuadPoints& points, const LawAt& law_at, const QuadVector& displacement, Tangent tangent,
               QuadAnswer& answer) {
  answer = QuadAnswer{.least_j = 1e300};
  for (std::size_t q = 0; q < kQuadPoints; ++q) {
    const Gradient f = gradientAt(points[q], displacement);
    answer.least_j = std::min(answer.least_j, volumeRatio(f));
    if (!(answer.least_j > 0.0)) return;
    const NeoHookean law = law_at(q);
    const NeoHookean part = q < kShearPoints ? NeoHookean{law.shear, 0.0} : NeoHookean{0.0, law.volume};
    Answer local = evaluateLaw(part, f);
    constexpr double kMinShare = 1e-3;
    if (tangent == Tangent::convex) makeConvex(local, kMinShare * part.shear);
    answer.energy += points[q].volume * local.energy;
    addForces(points[q], local.stress, answer.forces);
    addStiffness(points[q], local, answer.stiffness);
  }
}

}  // namespace

Gradient gradientAt(const QuadPoint& point, const QuadVector& u) {
  Gradient f = {1.0, 0.0, 0.0, 1.0, 1.0};
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    f[0] += point.along_r[a] * u[2 * a];
    f[1] += point.along_z[a] * u[2 * a];
    f[2] += point.along_r[a] * u[2 * a + 1];
    f[3] += point.along_z[a] * u[2 * a + 1];
    f[4] += point.hoop[a] * u[2 * a];
  }
  return f;
}

QuadPoints quadPoints(const QuadMesh& mesh, std::size_t element) {
  QuadPoints points;
  const auto rule = quadRule();
  for (std::size_t q = 0; q < kQuadPoints; ++q) {
    points[q] = pointAt(mesh, mesh.nodes[element], rule[q].x, rule[q].y, rule[q].weight);
  }
  return points;
}

std::array<std::array<double, 2>, kQuadPoints> quadPlaces(const QuadMesh& mesh, std::size_t element) {
  const std::array<int, 8>& nodes = mesh.nodes[element];
  const auto between = [](double from, double to, double at) { return from + 0.5 * (to - from) * (1.0 + at); };
  const auto corner = [&](std::size_t a) { return static_cast<std::size_t>(nodes[a]); };
  std::array<std::array<double, 2>, kQuadPoints> places;
  const auto rule = quadRule();
  for (std::size_t q = 0; q < kQuadPoints; ++q) {
    places[q] = {between(mesh.r[corner(0)], mesh.r[corner(1)], rule[q].x),
                 between(mesh.z[corner(0)], mesh.z[corner(3)], rule[q].y)};
  }
  return places;
}

void answerOfQuad(const QuadPoints& points, const NeoHookean& law, const QuadVector& displacement, Tangent tangent,
                  QuadAnswer& answer) {
  addUpQuad(
      points, [&](std::size_t) { return law; }, displacement, tangent, answer);
}

void answerOfQuad(const QuadPoints& points, const QuadLaws& laws, const QuadVector& displacement, Tangent tangent,
                  QuadAnswer& answer) {
  addUpQuad(
      points, [&](std::size_t q) { return laws[q]; }, displacement, tangent, answer);
}

std::array<double, 3> edgeShape(double s) { return {0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)}; }

}  // namespace palpate::elements
