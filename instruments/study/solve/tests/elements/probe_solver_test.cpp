// The pressed probe: against a column in compression, against a rectangle on a half-space, and what scales.
#include "palpate/elements/probe_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"
#include "support/error_message.h"

namespace palpate::elements {
namespace {

using tissue::LayerStack;

TEST(ProbeSolver, AWideProbeOnAThinCompressibleLayerIsAColumn) {
  LayerStack stack{{{"", 5.0, 20.0}}};
  stack.poisson = 0.0;
  const double stiffness = probeStiffness(stack, {.length_mm = 100.0, .width_mm = 100.0, .half_length_mm = 150.0});
  const double column = 1e-3 * 20.0 * 100.0 * 100.0 / 5.0;
  EXPECT_GT(stiffness, column);
  EXPECT_LT(stiffness, 1.1 * column) << "the skin around its edges";
}

/// A rigid rectangle on a half-space: Gazetas 1991, K = G L / (1 - nu) (1.46 + 3.08 (B / L)^0.75) with half sides L, B.
/// The block's end and the mesh make it stiffer.
TEST(ProbeSolver, OnADeepBlockIsARigidRectangleOnAHalfSpace) {
  // Rows are as fine as layers are thin.
  LayerStack stack{{{"", 2.0, 30.0}, {"", 4.0, 30.0}, {"", 10.0, 30.0}, {"", 34.0, 30.0}, {"", 100.0, 30.0}}};
  stack.poisson = 0.48;
  const double shear = 30.0 / (2.0 * 1.48);
  const double half_length = 20.0;
  const double shape = 1.46 + 3.08 * std::pow(9.0 / 40.0, 0.75);
  const double theory = 1e-3 * shear * half_length / (1.0 - stack.poisson) * shape;
  const double stiffness = probeStiffness(stack, {.half_length_mm = 150.0, .fineness = 0.8});
  EXPECT_GT(stiffness, theory);
  EXPECT_LT(stiffness, 1.15 * theory);
}

TEST(ProbeSolver, IsProportionalToTheModuliAndSofterOverARoundBone) {
  LayerStack stack{{{"skin", 1.5, 150.0}, {"fat", 3.0, 10.0}, {"muscle", 8.0, 27.0}}};
  ProbeSettings settings;
  settings.fineness = 0.6;
  const double plane = probeStiffness(stack, settings);
  settings.bone_radius_mm = 7.0;
  const double round = probeStiffness(stack, settings);
  EXPECT_LT(round, 0.85 * plane);
  settings.bone_radius_mm = 60.0;
  EXPECT_NEAR(probeStiffness(stack, settings) / plane, 1.0, 0.05) << "nearly a plane";
  settings.bone_radius_mm = 7.0;
  for (tissue::Layer& layer : stack.layers) layer.young_kpa *= 2.0;
  EXPECT_NEAR(probeStiffness(stack, settings) / round, 2.0, 1e-3);
}

TEST(ProbeSolver, RefusesSizesThatMakeNoSense) {
  const LayerStack stack{{{"", 8.0, 20.0}}};
  const auto complaint = [&](const ProbeSettings& settings) {
    return support::thrownMessage([&] { probeStiffness(stack, settings); });
  };
  EXPECT_EQ(complaint({.length_mm = 0.0}), "the probe's length (mm) is 0; it must be 2 to 200");
  EXPECT_EQ(complaint({.width_mm = std::nan("")}), "the probe's width (mm) is nan; it must be 2 to 200");
  EXPECT_NE(complaint({.bone_radius_mm = -1.0}).find("the bone's radius"), std::string::npos);
  EXPECT_NE(complaint({.width_mm = 60.0, .bone_radius_mm = 5.0}).find("half the limb's width"), std::string::npos);
  EXPECT_NE(complaint({.half_length_mm = 10.0}).find("half the block's length"), std::string::npos);
  EXPECT_NE(complaint({.fineness = 9.0}).find("fineness"), std::string::npos);
}

}  // namespace
}  // namespace palpate::elements
