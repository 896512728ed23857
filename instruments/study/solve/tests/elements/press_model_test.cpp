// The element, its law and the contact against what shares no code with them: differences of the energy, uniform
// strains, Hertz.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "palpate/elements/equilibrium.h"
#include "palpate/elements/press_model.h"

namespace palpate::elements {
namespace {

tissue::LayerStack threeLayers() { return {{{"skin", 2, 150}, {"fat", 8, 10}, {"muscle", 20, 27}}, 0.48}; }

MeshFineness coarse() {
  return {.columns = {.first_mm = 2.5, .uniform_to_mm = 10, .growth = 1.6, .widest_mm = 20, .to_mm = 60},
          .rows = {.first_mm = 4, .fewest = 1, .most = 3}};
}

Eigen::VectorXd shaken(const PressModel& model, double by_mm, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-by_mm, by_mm);
  Eigen::VectorXd step(model.mesh().freedom_count);
  for (double& value : step) value = off(random);
  return step;
}

TEST(PressModel, ResidualIsTheSlopeOfTheEnergy) {
  PressModel model(threeLayers(), coarse(), 8.0, 1500.0);
  const Eigen::VectorXd state = model.moved(model.atRest(), shaken(model, 0.15, 1), 1.0);
  const double depth = 1.0;
  const Balance balance = model.evaluate(state, depth, Tangent::exact);
  ASSERT_TRUE(balance.possible());
  ASSERT_GT(balance.force_mn, 100.0);  // it is touched
  const Eigen::VectorXd residual = model.residual();
  for (unsigned seed = 2; seed < 6; ++seed) {
    const Eigen::VectorXd along = shaken(model, 1.0, seed);
    constexpr double kStep = 1e-5;
    const double above = model.evaluate(model.moved(state, along, kStep), depth, Tangent::exact).energy();
    const double below = model.evaluate(model.moved(state, along, -kStep), depth, Tangent::exact).energy();
    const double slope = residual.dot(along);
    EXPECT_NEAR((above - below) / (2 * kStep), slope, 1e-6 * residual.norm() * along.norm());
  }
}

TEST(PressModel, TangentIsTheSlopeOfTheResidual) {
  PressModel model(threeLayers(), coarse(), 8.0, 1500.0);
  const Eigen::VectorXd state = model.moved(model.atRest(), shaken(model, 0.15, 7), 1.0);
  const double depth = 1.0;
  model.evaluate(state, depth, Tangent::exact);
  const Eigen::SparseMatrix<double> tangent = model.tangent().lower();
  for (unsigned seed = 8; seed < 12; ++seed) {
    const Eigen::VectorXd along = shaken(model, 1.0, seed);
    const Eigen::VectorXd expected = tangent.selfadjointView<Eigen::Lower>() * along;
    constexpr double kStep = 1e-6;
    model.evaluate(model.moved(state, along, kStep), depth, Tangent::exact);
    const Eigen::VectorXd above = model.residual();
    model.evaluate(model.moved(state, along, -kStep), depth, Tangent::exact);
    const Eigen::VectorXd found = (above - model.residual()) / (2 * kStep);
    EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(PressModel, TheConvexTangentHasNoNegativePivot) {
  PressModel model(threeLayers(), coarse(), 8.0, 1500.0);
  const Eigen::VectorXd state = model.moved(model.atRest(), shaken(model, 0.4, 13), 1.0);
  ASSERT_TRUE(model.evaluate(state, 4.0, Tangent::exact).possible());
  EXPECT_GT(model.tangent().factorise(), 0);  // far from equilibrium the exact one does
  model.evaluate(state, 4.0, Tangent::convex);
  EXPECT_EQ(model.tangent().factorise(), 0);
}

TEST(PressModel, AUniformStrainOfOneMaterialLeavesNoForceInside) {
  PressModel model({{{"", 10, 30}, {"", 7, 30}}, 0.48}, coarse(), 8.0, 1500.0);
  const QuadMesh& mesh = model.mesh();
  Eigen::VectorXd state = model.atRest();
  double size = 0.0;
  for (std::size_t n = 0; n < mesh.r.size(); ++n) {
    state[static_cast<Eigen::Index>(2 * n)] = 0.1 * mesh.r[n];
    state[static_cast<Eigen::Index>(2 * n + 1)] = -0.15 * mesh.z[n];
  }
  ASSERT_TRUE(model.evaluate(state, -10.0, Tangent::exact).possible());  // the sphere stays away
  size = model.residual().cwiseAbs().maxCoeff();
  int inside = 0;
  for (std::size_t n = 0; n < mesh.r.size(); ++n) {
    if (mesh.z[n] > mesh.height() - 1e-9) continue;  // the surface is pulled, the base and the rim are held
    for (const int freedom : mesh.freedoms[n]) {
      if (freedom == kHeld) continue;
      EXPECT_LT(std::abs(model.residual()[freedom]), 1e-9 * size);
      ++inside;
    }
  }
  EXPECT_GT(inside, 30);
}

TEST(PressModel, AnElementTurnedInsideOutIsNamed) {
  PressModel model(threeLayers(), coarse(), 8.0, 1500.0);
  Eigen::VectorXd state = model.atRest();
  const QuadMesh& mesh = model.mesh();
  for (std::size_t n = 0; n < mesh.r.size(); ++n) {  // the fat's upper border goes through its lower
    if (mesh.z[n] > 27.9 && mesh.r[n] < 0.1) state[static_cast<Eigen::Index>(2 * n + 1)] = -9.0;
  }
  const Balance balance = model.evaluate(state, 1.0, Tangent::exact);
  ASSERT_FALSE(balance.possible());
  EXPECT_NE(model.placeOfElement(balance.inverted).find("in the fat"), std::string::npos)
      << model.placeOfElement(balance.inverted);
}

/// Hertz: what a half-space goes down by outside the contact.
double hertzSurface(double r, double a, double sphere) {
  if (r <= a) return (a * a - 0.5 * r * r) / sphere;
  return ((2 * a * a - r * r) * std::asin(a / r) + a * std::sqrt(r * r - a * a)) / (std::numbers::pi * sphere);
}

TEST(PressModel, ASmallPressOnADeepBlockIsHertz) {
  constexpr double kYoung = 27.0;
  constexpr double kPoisson = 0.48;
  constexpr double kSphere = 8.0;
  constexpr double kDepth = 0.1;
  const MeshFineness fine = {
      .columns = {.first_mm = 0.08, .uniform_to_mm = 1.6, .growth = 1.2, .widest_mm = 40, .to_mm = 300},
      .rows = {.first_mm = 0.1, .fewest = 2, .most = 40}};
  PressModel model({{{"", 300, kYoung}}, kPoisson}, fine, kSphere, 2e5);
  const Equilibrium found = settle(model, model.atRest(), kDepth, {});
  ASSERT_TRUE(found.found()) << found.trouble;
  const double surface = -found.displacement[1];
  EXPECT_NEAR(surface, kDepth, 0.001 * kDepth);
  const double force = 4.0 / 3.0 * kYoung / (1 - kPoisson * kPoisson) * std::sqrt(kSphere * kDepth) * kDepth;
  EXPECT_NEAR(found.balance.force_mn, force, 0.008 * force);
  const double a = std::sqrt(kSphere * kDepth);
  const QuadMesh& mesh = model.mesh();
  double worst = 0.0;
  int compared = 0;
  for (const auto& edge : mesh.surface) {
    const double r = mesh.r[static_cast<std::size_t>(edge[2])];
    if (r > 20.0) break;
    worst = std::max(worst, std::abs(-found.displacement[2 * edge[2] + 1] - hertzSurface(r, a, kSphere)));
    ++compared;
  }
  EXPECT_GT(compared, 25);
  EXPECT_LT(worst, 0.0064 * kDepth);
  EXPECT_NEAR(found.balance.contact_radius_mm, a, 0.04);
}

}  // namespace
}  // namespace palpate::elements
