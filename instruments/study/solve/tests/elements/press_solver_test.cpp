// Whole presses: against profiles of an independent solver, against themselves on other meshes and steps, and where
// tissue gives way. PALPATE_HEAVY=1 compares every case of the independent solver.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/elements/equilibrium.h"
#include "palpate/elements/press_model.h"
#include "palpate/elements/press_solver.h"
#include "support/error_message.h"
#include "support/golden.h"

namespace palpate::elements {
namespace {

using tissue::LayerStack;
using tissue::PressedShape;

LayerStack back() { return {{{"skin", 2, 150}, {"fat", 8, 10}, {"muscle", 30, 27}}, 0.48}; }
LayerStack softAndThin() { return {{{"skin", 2, 35}, {"fat", 8, 2}, {"muscle", 30, 80}}, 0.48}; }
LayerStack overARib() { return {{{"skin", 2, 150}, {"fat", 2, 10}, {"muscle", 5, 27}}, 0.48}; }

/// Between the table's radii by the parabola through three of them: lines are too coarse under the sphere's rim.
double between(const std::vector<double>& radii, const std::vector<double>& values, double r) {
  const auto after = std::upper_bound(radii.begin() + 1, radii.end() - 2, r);
  const auto i = static_cast<std::size_t>(after - radii.begin()) - 1;
  double sum = 0.0;
  for (std::size_t a = i; a < i + 3; ++a) {
    double weight = 1.0;
    for (std::size_t b = i; b < i + 3; ++b) {
      if (a != b) weight *= (r - radii[b]) / (radii[a] - radii[b]);
    }
    sum += weight * values[a];
  }
  return sum;
}

struct Off {
  double greatest = 0.0;
  double rms = 0.0;  ///< over the area
};

Off measureDeviation(const std::vector<double>& radii, const std::vector<double>& values, const nlohmann::json& r,
                     const nlohmann::json& expected) {
  Off off;
  double squares = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double at = r[i].get<double>();
    const double difference = between(radii, values, at) - expected[i].get<double>();
    off.greatest = std::max(off.greatest, std::abs(difference));
    squares += at * difference * difference;
    area += at;
  }
  off.rms = std::sqrt(squares / area);
  return off;
}

TEST(PressSolver, AgreesWithAnIndependentSolver) {
  const bool all = std::getenv("PALPATE_HEAVY") != nullptr;
  const nlohmann::json golden = test::golden("fem_profiles");
  std::map<std::string, std::vector<nlohmann::json>> stacks;
  for (const auto& one : golden.at("cases")) {
    if (one.at("friction") == "none") stacks[one.at("name").get<std::string>()].push_back(one);
  }
  int compared = 0;
  for (const auto& [name, cases] : stacks) {
    if (!all && name != "back_mid" && name != "bony") continue;
    LayerStack stack;
    for (const auto& layer : cases.front().at("layers_mm_kPa")) stack.layers.push_back({"", layer[0], layer[1]});
    PressSettings settings;
    settings.depths_mm.clear();
    for (const auto& one : cases) settings.depths_mm.push_back(one.at("depth").get<double>());
    const PressSolution solution = solvePress(stack, settings);
    EXPECT_EQ(solution.stopped_by, "");
    ASSERT_EQ(solution.table.shapes.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const PressedShape& shape = solution.table.shapes[i];
      SCOPED_TRACE(fmt::format("{} at {} mm", name, shape.depth_mm));
      const double force = cases[i].at("force_N").get<double>();
      EXPECT_NEAR(shape.force_n, force, 0.003 * force);
      EXPECT_NEAR(shape.surface_mm, cases[i].at("u0").get<double>(), 0.001 * shape.depth_mm);
      const Off down = measureDeviation(solution.table.radii_mm, shape.down, golden.at("r"), cases[i].at("uz"));
      const Off outward = measureDeviation(solution.table.radii_mm, shape.outward, golden.at("r"), cases[i].at("ur"));
      EXPECT_LT(down.greatest, 0.006);
      EXPECT_LT(outward.greatest, 0.006);
      EXPECT_LT(down.rms, 0.0005);
      EXPECT_LT(outward.rms, 0.0005);
      ++compared;
    }
  }
  EXPECT_EQ(compared, all ? 16 : 8);
}

TEST(PressSolver, TheWorkOfTheSphereIsStored) {
  PressSettings settings{.depths_mm = {8.0}};
  settings.longest_step_mm = 0.5;
  const PressSolution solution = solvePress(back(), settings);
  ASSERT_EQ(solution.stopped_by, "");
  const double stored = solution.path.back().energy_mj;
  EXPECT_GT(stored, 5.0);
  EXPECT_NEAR(solution.work_mj, stored, 1e-3 * stored);
}

TEST(PressSolver, APressAndItsReleaseGiveTheEnergyBack) {
  PressModel model(back(), finenessFor({.fineness = 0.5}), 8.0, 1500.0);
  std::vector<double> depths;
  for (int i = 1; i <= 10; ++i) depths.push_back(0.4 * i);
  for (int i = 9; i >= 0; --i) depths.push_back(0.4 * i);
  Eigen::VectorXd state = model.atRest();
  double work = 0.0;
  double deepest_energy = 0.0;
  double force = 0.0;
  double depth = 0.0;
  for (const double next : depths) {
    const Equilibrium found = settle(model, state, next, {});
    ASSERT_TRUE(found.found()) << next << ": " << found.trouble;
    work += 0.5 * (force + found.balance.force_mn) * (next - depth);
    state = found.displacement;
    force = found.balance.force_mn;
    depth = next;
    deepest_energy = std::max(deepest_energy, found.balance.energy());
  }
  EXPECT_LT(std::abs(work), 1e-3 * deepest_energy);
  EXPECT_LT(state.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(PressSolver, AFinerMeshAndOtherStepsGiveTheSame) {
  const std::vector<double> depths = {3.0, 5.0};
  const LayerStack stack = {{{"skin", 2, 150}, {"fat", 4, 10}, {"muscle", 9, 27}}, 0.48};
  const PressSolution coarse = solvePress(stack, {.depths_mm = depths});
  const PressSolution fine = solvePress(stack, {.depths_mm = depths, .fineness = 2.0});
  const PressSolution slow = solvePress(stack, {.depths_mm = depths, .first_step_mm = 0.1, .longest_step_mm = 0.3});
  EXPECT_GT(slow.path.size(), 2 * coarse.path.size());
  ASSERT_EQ(fine.stopped_by + slow.stopped_by, "");
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const PressedShape& one = coarse.table.shapes[i];
    EXPECT_NEAR(fine.table.shapes[i].force_n, one.force_n, 2e-3 * one.force_n);
    EXPECT_NEAR(slow.table.shapes[i].force_n, one.force_n, 1e-5 * one.force_n);
    for (std::size_t k = 0; k < one.down.size(); ++k) {
      EXPECT_NEAR(fine.table.shapes[i].down[k], one.down[k], 3e-3);
      EXPECT_NEAR(fine.table.shapes[i].outward[k], one.outward[k], 3e-3);
      EXPECT_NEAR(slow.table.shapes[i].down[k], one.down[k], 1e-5);
    }
  }
}

TEST(PressSolver, VerySoftFatUnderThinSkinIsPressedToTenMillimetres) {
  const PressSolution solution = solvePress(softAndThin(), {.depths_mm = {5.0, 10.0}});
  EXPECT_EQ(solution.stopped_by, "");
  EXPECT_EQ(solution.converged_to_mm, 10.0);
  ASSERT_EQ(solution.table.shapes.size(), 2u);
  EXPECT_NEAR(solution.table.shapes[1].force_n, 2.061, 0.01);  // what meshes of half and a third the size give
}

TEST(PressSolver, WhereTissueGivesWayItSaysSoAndKeepsWhatItReached) {
  const PressSolution solution = solvePress(overARib(), {.depths_mm = {3.0, 6.0, 8.5}});
  EXPECT_GT(solution.converged_to_mm, 7.3);
  EXPECT_LT(solution.converged_to_mm, 8.0);
  EXPECT_NE(solution.stopped_by.find("gives way"), std::string::npos) << solution.stopped_by;
  EXPECT_NE(solution.stopped_by.find("mm from the axis"), std::string::npos) << solution.stopped_by;
  EXPECT_NE(solution.stopped_by.find("in the skin"), std::string::npos) << solution.stopped_by;
  ASSERT_EQ(solution.table.shapes.size(), 3u);
  EXPECT_EQ(solution.table.shapes.back().depth_mm, solution.converged_to_mm);
  EXPECT_NO_THROW(check(solution.table));
}

TEST(PressSolver, NoTableHasAForceThatFallsWithTheDepth) {
  const PressSolution solution =
      solvePress({{{"", 30, 20}}, 0.48}, {.depths_mm = {10.0, 25.0}, .fineness = 0.5, .longest_step_mm = 2.0});
  EXPECT_NE(solution.stopped_by.find("the force falls"), std::string::npos) << solution.stopped_by;
  EXPECT_GT(solution.converged_to_mm, 14.0);
  for (std::size_t i = 1; i < solution.path.size(); ++i) {
    EXPECT_GT(solution.path[i].force_n, solution.path[i - 1].force_n);
  }
}

TEST(PressSolver, EndsWhenAsked) {
  int asked = 0;
  const PressSolution solution = solvePress(back(), {.depths_mm = {0.5, 5.0}}, {}, [&] { return ++asked > 4; });
  EXPECT_EQ(solution.stopped_by, "asked to stop");
  EXPECT_GE(solution.table.shapes.size(), 1u);
  EXPECT_LT(solution.converged_to_mm, 5.0);
  EXPECT_GT(solution.converged_to_mm, 0.5);
}

TEST(PressSolver, TheTableHasManyRadiiNearTheAxisAndOneOnIt) {
  const std::vector<double> radii = tableRadii(150.0);
  ASSERT_EQ(radii.size(), 121u);
  EXPECT_EQ(radii.front(), 0.0);
  EXPECT_DOUBLE_EQ(radii[1], 0.5);
  EXPECT_DOUBLE_EQ(radii.back(), 120.0);
  EXPECT_TRUE(std::ranges::is_sorted(radii, std::less_equal<>()));
  EXPECT_LT(radii[120] - radii[119], 2.5);
}

TEST(PressSolver, SillyRequestsAreRefusedInWords) {
  const auto refusal = [](const LayerStack& stack, const PressSettings& settings) {
    return support::thrownMessage([&] { solvePress(stack, settings); });
  };
  EXPECT_NE(refusal(back(), {.depths_mm = {5.0, 2.0}}).find("2 after 5"), std::string::npos);
  EXPECT_NE(refusal(back(), {.depths_mm = {5.0, 40.0}}).find("reaches the bone"), std::string::npos);
  EXPECT_NE(refusal(back(), {.depths_mm = {}}).find("no depth"), std::string::npos);
  EXPECT_NE(refusal(back(), {.indenter_radius_mm = 0.0}).find("radius"), std::string::npos);
  EXPECT_NE(refusal(back(), {.radius_mm = 10.0}).find("disc"), std::string::npos);
  EXPECT_NE(refusal({{{"skin", 2, -1}}, 0.48}, {.depths_mm = {1.0}}), "no error");
}

/// A round top of bone gives way to the sides; the wider it is, the nearer to a plane.
TEST(PressSolver, OverNarrowBoneTheForceIsSmallerThanOverAPlane) {
  const tissue::LayerStack rib{{{"skin", 2.0, 150.0}, {"fat", 3.5, 10.0}, {"muscle", 3.5, 27.0}}, 0.48};
  const auto force_over = [&](double bone_radius_mm) {
    PressSettings settings{.depths_mm = {4.0}, .fineness = 0.7};
    settings.bone_radius_mm = bone_radius_mm;
    return solvePress(rib, settings).table.shapes.at(0).force_n;
  };
  const double plane = force_over(0.0);
  const double narrow = force_over(4.0) / plane;
  const double wide = force_over(12.0) / plane;
  const double flat = force_over(90.0) / plane;
  EXPECT_LT(narrow, 0.75);
  EXPECT_GT(narrow, 0.4);
  EXPECT_GT(wide, narrow + 0.05);
  EXPECT_GT(flat, wide + 0.05);
  EXPECT_LT(flat, 1.0);
}

/// Forces at 2 and 5 mm by finite elements that share nothing with these.
TEST(PressSolver, OverPostsWithFlatTopsTheForceIsThatOfIndependentFiniteElements) {
  const tissue::LayerStack back{{{"skin", 2.0, 150.0}, {"fat", 4.6, 10.0}, {"muscle", 3.0, 27.0}}, 0.48};
  const auto expect_forces = [&](double bone_radius_mm, double light_n, double firm_n) {
    PressSettings settings{.depths_mm = {2.0, 5.0}, .fineness = 2.0};
    settings.bone_radius_mm = bone_radius_mm;
    settings.bone_flat_top = true;
    const tissue::LayeredTable table = solvePress(back, settings).table;
    EXPECT_NEAR(table.shapes.at(0).force_n, light_n, 0.05 * light_n) << bone_radius_mm << " mm";
    EXPECT_NEAR(table.shapes.at(1).force_n, firm_n, 0.05 * firm_n) << bone_radius_mm << " mm";
  };
  expect_forces(4.0, 0.50, 2.64);
  expect_forces(7.0, 0.56, 3.18);
}

}  // namespace
}  // namespace palpate::elements
