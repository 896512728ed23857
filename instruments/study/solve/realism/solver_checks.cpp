#include "solve/realism/solver_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/elements/equilibrium.h"
#include "palpate/elements/press_model.h"
#include "palpate/elements/press_solver.h"

namespace palpate::lab {

namespace {

/// Work is summed up by straight lines over steps: with longer ones that error is seen, not the solver's.
constexpr double kCheckedStepMm = 0.15;

/// The press of one depth. Throws Error where it is not reached.
elements::PressSolution reachedPress(const tissue::LayerStack& stack, elements::PressSettings settings,
                                     double depth_mm) {
  settings.depths_mm = {depth_mm};
  elements::PressSolution solution = elements::solvePress(stack, settings);
  if (!solution.stopped_by.empty()) {
    throw Error(fmt::format("cannot solve a press of {:g} mm: {}", depth_mm, solution.stopped_by));
  }
  return solution;
}

double pressForce(const tissue::LayerStack& stack, const elements::PressSettings& settings, double depth_mm) {
  return reachedPress(stack, settings, depth_mm).table.shapes.back().force_n;
}

}  // namespace

HertzCheck checkHertz() {
  // The block is 3,000 times as deep as the press; elements are a tenth of the contact's radius.
  constexpr double kYoungKpa = 27.0;
  constexpr double kPoisson = 0.48;
  constexpr double kSphereMm = 8.0;
  constexpr double kDepthMm = 0.1;
  constexpr double kBlockMm = 300.0;
  constexpr double kRigidKpaPerMm = 2e5;
  const elements::MeshFineness fine = {
      .columns = {.first_mm = 0.08, .uniform_to_mm = 1.6, .growth = 1.2, .widest_mm = 40, .to_mm = kBlockMm},
      .rows = {.first_mm = 0.1, .fewest = 2, .most = 40}};
  elements::PressModel model({{{"", kBlockMm, kYoungKpa}}, kPoisson}, fine, kSphereMm, kRigidKpaPerMm);
  const elements::Equilibrium found = elements::settle(model, model.atRest(), kDepthMm, {});
  if (!found.found()) throw Error("cannot solve a small press on a deep block: " + found.trouble);
  const double radius = std::sqrt(kSphereMm * kDepthMm);
  const double force = 4.0 / 3.0 * kYoungKpa / (1.0 - kPoisson * kPoisson) * radius * kDepthMm;
  return {std::abs(found.balance.force_mn / force - 1.0), std::abs(found.balance.contact_radius_mm / radius - 1.0)};
}

double energyError(const tissue::LayerStack& stack, double depth_mm) {
  elements::PressSettings settings;
  settings.first_step_mm = kCheckedStepMm;
  settings.longest_step_mm = kCheckedStepMm;
  const elements::PressSolution solution = reachedPress(stack, settings, depth_mm);
  return std::abs(solution.work_mj / solution.path.back().energy_mj - 1.0);
}

RefinedPress refinePress(const tissue::LayerStack& stack, double depth_mm, std::size_t levels) {
  RefinedPress refined;
  double fineness = 0.5;
  double default_n = 0.0;
  for (std::size_t i = 0; i < levels; ++i, fineness *= 2.0) {
    refined.fineness.push_back(fineness);
    refined.force_n.push_back(pressForce(stack, {.fineness = fineness}, depth_mm));
    if (fineness == 1.0) default_n = refined.force_n.back();
  }
  const double coarse = refined.force_n.at(levels - 3);
  const double middle = refined.force_n[levels - 2];
  const double finest = refined.force_n[levels - 1];
  refined.order = observedOrder(coarse, middle, finest);
  refined.grid_convergence = gridConvergence(coarse, middle, finest);
  refined.default_error = std::abs(default_n / finest - 1.0);
  return refined;
}

double stepError(const tissue::LayerStack& stack, double depth_mm) {
  const elements::PressSettings usual;
  elements::PressSettings shorter;
  shorter.first_step_mm = usual.first_step_mm / 3.0;
  shorter.longest_step_mm = usual.longest_step_mm / 3.0;
  return std::abs(pressForce(stack, usual, depth_mm) / pressForce(stack, shorter, depth_mm) - 1.0);
}

std::optional<double> observedOrder(double coarse, double middle, double fine) {
  const double ratio = (coarse - middle) / (middle - fine);
  if (!(ratio > 1.0) || !std::isfinite(ratio)) return std::nullopt;
  return std::log2(ratio);
}

double gridConvergence(double coarse, double middle, double fine) {
  constexpr double kSafetyOfThree = 1.25;
  constexpr double kSafetyOfTwo = 3.0;
  const double difference = std::abs((middle - fine) / fine);
  const std::optional<double> order = observedOrder(coarse, middle, fine);
  return order ? kSafetyOfThree * difference / (std::exp2(*order) - 1.0) : kSafetyOfTwo * difference;
}

}  // namespace palpate::lab
