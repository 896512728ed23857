// The dragged skin: against an independent solver, against what is known of a half-space, and its fitted form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "palpate/base/error.h"
#include "palpate/elements/hex_element.h"
#include "palpate/elements/stack_solver.h"
#include "support/error_message.h"
#include "support/golden.h"

namespace palpate::elements {
namespace {

using tissue::LayerStack;

LayerStack parseStack(const nlohmann::json& layers) {
  LayerStack stack;
  for (const auto& layer : layers) stack.layers.push_back({"", layer[0], layer[1]});
  return stack;
}

TEST(HexElement, SixMotionsCostNothingAndAUniformStrainWhatTheLawSays) {
  const Vec3 size(2, 3, 5);
  constexpr double kYoung = 30.0;
  constexpr double kPoisson = 0.48;
  const HexMatrix stiffness = hexStiffness(size, kYoung, kPoisson);
  EXPECT_LT((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::SelfAdjointEigenSolver<HexMatrix> modes(stiffness);
  EXPECT_LT(std::abs(modes.eigenvalues()[5]), 1e-9 * modes.eigenvalues()[23]);
  EXPECT_GT(modes.eigenvalues()[6], 1e-4 * modes.eigenvalues()[23]);
  // Stretched along x, free to thin: the energy is E / 2 times the square of the strain.
  Eigen::Matrix<double, 24, 1> stretched;
  for (int v = 0; v < 8; ++v) {
    const Vec3 at((v & 1) != 0 ? size.x() : 0, (v & 2) != 0 ? size.y() : 0, (v & 4) != 0 ? size.z() : 0);
    stretched.segment<3>(3 * v) = 0.01 * Vec3(at.x(), -kPoisson * at.y(), -kPoisson * at.z());
  }
  EXPECT_NEAR(stretched.dot(stiffness * stretched), kYoung * 1e-4 * size.prod(), 1e-9);
}

TEST(DragSolver, AgreesWithAnIndependentSolver) {
  const nlohmann::json golden = test::golden("fem_profiles").at("tangential").at("data");
  for (const std::string name : {"mid", "homog"}) {
    SCOPED_TRACE(name);
    const nlohmann::json& one = golden.at(name);
    const DragField field = solveDragField(parseStack(one.at("layers")), {});
    ASSERT_EQ(field.lines_mm.size(), one.at("rx").size());
    const double most = name == "homog" ? 0.015 : 0.002;  // its rows near the surface are others
    for (std::size_t i = 0; i < field.lines_mm.size(); ++i) {
      const double at = one.at("rx")[i].get<double>();
      EXPECT_NEAR(field.at(at, 0.0), one.at("ux")[i].get<double>(), most) << at;
      EXPECT_NEAR(field.at(0.0, at), one.at("uy")[i].get<double>(), most) << at;
    }
    // The other quarters are mirrored: along the drag alike, across it turned round.
    const Vec2 here = field.movedAt({20.0, 14.0});
    EXPECT_GT(here.y(), 0.0);
    EXPECT_LT((field.movedAt({-20.0, 14.0}) - Vec2(here.x(), -here.y())).norm(), 1e-12);
    EXPECT_LT((field.movedAt({-20.0, -14.0}) - here).norm(), 1e-12);
    EXPECT_EQ(field.movedAt({200.0, 0.0}), Vec2(0.0, 0.0));
    const FittedDrag fitted = fitDrag(field, {0.0, 10.0});
    const nlohmann::json& p = one.at("lorentz").at("p");
    EXPECT_NEAR(fitted.shape.along_mm, p[0].get<double>(), 0.03 * p[0].get<double>());
    EXPECT_NEAR(fitted.shape.across_mm, p[1].get<double>(), 0.03 * p[1].get<double>());
    EXPECT_NEAR(fitted.shape.exponent, p[2].get<double>(), 0.02);
    EXPECT_LT(fitted.rms, 0.03);
    EXPECT_GT(fitted.rms, 0.01);  // of a form that is not the truth
    EXPECT_EQ(fitted.shape.on_along, (std::vector{1.0, field.at(10.0, 0.0)}));
    EXPECT_EQ(fitted.shape.on_across, (std::vector{1.0, field.at(0.0, 10.0)}));
  }
}

/// Where the share falls to a level along a line from the patch.
template <class Share>
double radiusOf(double level, const Share& share) {
  double r = 0.0;
  while (share(r) > level) r += 0.01;
  return r;
}

TEST(DragSolver, AHomogeneousBlockIsMindlinsAndCerrutis) {
  constexpr double kPoisson = 0.48;
  const DragField field =
      solveDragField({{{"", 5, 27}, {"", 20, 27}, {"", 175, 27}}, kPoisson}, {.half_width_mm = 200.0});
  // A round bonded patch on a half-space: along 32 (1 - nu) G a / (7 - 8 nu), down 4 G a ln(3 - 4 nu) / (1 - 2 nu).
  const double along = 32 * (1 - kPoisson) / (7 - 8 * kPoisson);
  const double down = 4 * std::log(3 - 4 * kPoisson) / (1 - 2 * kPoisson);
  EXPECT_NEAR(field.drag_n_per_mm / field.press_n_per_mm, along / down, 0.03 * along / down);
  // Far from a force along the surface the skin moves 1 / (1 - nu) times as far along it as across.
  const double far_along = radiusOf(0.15, [&](double r) { return field.at(r, 0.0); });
  const double far_across = radiusOf(0.15, [&](double r) { return field.at(0.0, r); });
  EXPECT_NEAR(far_along / far_across, 1.0 / (1.0 - kPoisson), 0.1 / (1.0 - kPoisson));
}

TEST(DragSolver, StiffSkinCarriesADragFartherAndAgainstThePress) {
  const StackSettings settings{.press = {.depths_mm = {1.0}}};
  const StackSolution soft = solveStack({{{"skin", 2, 150}, {"fat", 4, 10}, {"muscle", 9, 27}}, 0.48}, settings);
  const StackSolution stiff = solveStack({{{"skin", 2, 1000}, {"fat", 4, 10}, {"muscle", 9, 27}}, 0.48}, settings);
  ASSERT_TRUE(soft.press.table.drag && stiff.press.table.drag);
  EXPECT_EQ(soft.press.table.drag->on_along.size(), soft.press.table.radii_mm.size());
  EXPECT_GT(stiff.press.table.drag->on_along[60], soft.press.table.drag->on_along[60]);
  EXPECT_GT(stiff.press.table.drag->tangential_over_normal, 1.5 * soft.press.table.drag->tangential_over_normal);
  EXPECT_NO_THROW(check(stiff.press.table));
}

TEST(DragSolver, SillySizesAreRefused) {
  const LayerStack stack{{{"", 20, 27}}, 0.48};
  const auto refusal = [&](const DragSettings& settings) {
    return support::thrownMessage([&] { solveDragField(stack, settings); });
  };
  EXPECT_NE(refusal({.patch_radius_mm = 0.0}).find("patch"), std::string::npos);
  EXPECT_NE(refusal({.half_width_mm = 10.0}).find("block"), std::string::npos);
  EXPECT_NE(refusal({.fineness = 0.0}).find("fineness"), std::string::npos);
}

}  // namespace
}  // namespace palpate::elements
