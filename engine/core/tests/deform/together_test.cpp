#include "palpate/deform/together.h"
#include "palpate/deform/plan.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/tissue/profile.h"
#include "support/golden.h"

namespace palpate::deform {

std::vector<double> solvedDepths(const Eigen::MatrixXd& g, const Eigen::VectorXd& depths) {
  const auto n = static_cast<std::size_t>(depths.size());
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < g.rows(); ++i) {
    for (Eigen::Index j = 0; j < g.cols(); ++j) rows.push_back(g(i, j));
  }
  std::vector<double> amplitudes(n);
  solveDepths({rows, n}, {depths.data(), n}, amplitudes);
  return amplitudes;
}

TEST(SolveDepths, TwoFingersAsInTheReference) {
  for (const auto& c : test::goldenRows("two_fingers", "cases")) {
    const double g = tissue::profile(c["distance"].get<double>() / c["R"].get<double>());
    EXPECT_NEAR(g, c["g"], 1e-12);
    Eigen::Matrix2d coupling;
    coupling << 1, g, g, 1;
    const auto amplitudes = solvedDepths(coupling, Eigen::Vector2d(c["depths"][0], c["depths"][1]));
    EXPECT_NEAR(amplitudes[0], c["amplitudes"][0], 1e-9) << c;
    EXPECT_NEAR(amplitudes[1], c["amplitudes"][1], 1e-9) << c;
    EXPECT_NEAR(amplitudes[0] + g * amplitudes[1], c["solved_depth_at_1"], 1e-9) << c;
    EXPECT_NEAR(g * amplitudes[0] + amplitudes[1], c["solved_depth_at_2"], 1e-9) << c;
  }
}

TEST(SolveDepths, OneFingerIsItsOwnAmplitude) {
  EXPECT_EQ(solvedDepths(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Constant(1, 7.0)), (std::vector<double>{7.0}));
  EXPECT_TRUE(solvedDepths(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)).empty());
}

// Any number of fingers at random places: nobody is shallower than asked, and only those without amplitude are deeper.
TEST(SolveDepths, EveryFingerGetsItsDepth) {
  Random random(17);
  for (int round = 0; round < 200; ++round) {
    const auto n = static_cast<Eigen::Index>(1 + random.below(10));
    Eigen::MatrixXd g(n, n);
    Eigen::VectorXd depths(n);
    std::vector<Vec2> places;
    for (Eigen::Index i = 0; i < n; ++i) {
      places.emplace_back(random.uniform(0, 80), random.uniform(0, 80));
      depths[i] = random.uniform(0, 10);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        g(i, j) =
            tissue::profile((places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]).norm() / 30);
      }
    }
    const auto amplitudes = solvedDepths(g, depths);
    const Eigen::VectorXd reached = g * Eigen::Map<const Eigen::VectorXd>(amplitudes.data(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_GE(amplitudes[static_cast<std::size_t>(i)], 0.0);
      EXPECT_GE(reached[i], depths[i] - 0.01);
      if (amplitudes[static_cast<std::size_t>(i)] > 0.01) {
        EXPECT_NEAR(reached[i], depths[i], 0.01);
      }
    }
  }
}

TEST(SolveDrags, FingersThatShareSkinEachGetTheirDrag) {
  const std::vector<double> g{1.0, 0.5, 0.5, 1.0};
  const std::vector<Vec3> drags{{6, 0, 0}, {6, 3, 0}};
  std::vector<Vec3> shifts(2);
  solveDrags({g, 2}, drags, 20.0, shifts);
  EXPECT_LT((shifts[0] + 0.5 * shifts[1] - drags[0]).norm(), 1e-9);
  EXPECT_LT((0.5 * shifts[0] + shifts[1] - drags[1]).norm(), 1e-9);
}

TEST(SolveDrags, PullingTheSamePointApartStaysBounded) {
  const std::vector<double> g{1.0, 1.0, 1.0, 1.0};
  const std::vector<Vec3> drags{{15, 0, 0}, {-15, 0, 0}};
  std::vector<Vec3> shifts(2);
  solveDrags({g, 2}, drags, 20.0, shifts);
  for (const Vec3& shift : shifts) EXPECT_LE(shift.norm(), 20.0 + 1e-12);
  EXPECT_NEAR((shifts[0] + shifts[1]).norm(), 0.0, 1e-9) << "neither wins";
}

// Two fingers in one ellipse of 150 mm that drag the skin apart: nowhere on the line through both does it move farther
// than a finger asks, nor shear more than both fingers would alone.
TEST(SolveDrags, SkinNeverShearsMoreThanTheFingersAsk) {
  constexpr double kRadius = 150.0;
  constexpr double kDrag = 6.0;
  const auto profile = [](double x, double centre) { return tissue::profile(std::abs(x - centre) / kRadius); };
  for (const double apart : {2.0, 10.0, 40.0, 100.0}) {
    const double g = profile(apart, 0.0);
    const std::vector<double> coupling{1.0, g, g, 1.0};
    const std::vector<Vec3> drags{{0, kDrag, 0}, {0, -kDrag, 0}};
    std::vector<Vec3> shifts(2);
    solveDrags({coupling, 2}, drags, 20.0, shifts);
    const auto moved = [&](double x) { return shifts[0].y() * profile(x, 0.0) + shifts[1].y() * profile(x, apart); };
    for (double x = -200.0; x < 300.0; x += 1.0) {
      const double alone =
          std::abs(profile(x + 1, 0.0) - profile(x, 0.0)) + std::abs(profile(x + 1, apart) - profile(x, apart));
      EXPECT_LE(std::abs(moved(x)), kDrag + 1e-9) << apart;
      EXPECT_LE(std::abs(moved(x + 1) - moved(x)), kDrag * alone + 1e-9) << apart;
    }
  }
}

TEST(SolveDrags, AFingerThatHoldsTheSkinHoldsItAgainstAnothersDrag) {
  const std::vector<double> g{1.0, 0.9, 0.9, 1.0};
  const std::vector<Vec3> drags{{6, 0, 0}, {0, 0, 0}};
  std::vector<Vec3> shifts(2);
  solveDrags({g, 2}, drags, 20.0, shifts);
  EXPECT_LT((0.9 * shifts[0] + shifts[1]).norm(), 1e-9);
  EXPECT_GT((shifts[0] + 0.9 * shifts[1]).x(), 1.0);
}

}  // namespace palpate::deform
