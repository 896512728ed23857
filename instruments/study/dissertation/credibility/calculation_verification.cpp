// How far are the numbers from those on finer meshes and shorter ticks?
#include "dissertation/credibility/credibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dissertation/credibility/checked_stack.h"
#include "lab/runs/safety_run.h"
#include "lab/workloads/heldout_meshes.h"
#include "palpate/base/random.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/presets.h"
#include "solve/realism/lump_judge.h"
#include "solve/realism/solver_checks.h"

namespace palpate::study {

namespace {

/// Bars of docs/explanation/tissue.md.
constexpr double kMeshBarPercent = 0.3;
constexpr double kStepBarPercent = 0.001;
/// Share of the greatest force: a fifth of the smallest change of force that people notice.
constexpr double kTickBarPercent = 1.5;
/// Share of the felt force on the finest ball.
constexpr double kFacetBarPercent = 0.5;
constexpr double kMicrosecondsOfATick = 1000.0;

Evidence solverMesh(const CredibilitySettings& settings) {
  const lab::RefinedPress refined = lab::refinePress(checkedStack(), kCheckedDepthMm);
  Evidence evidence{.name = "solver_mesh",
                    .title = "Elements of the tissue solver",
                    .against = "the same press on finer meshes and with shorter steps",
                    .command = "",
                    .numbers = {}};
  for (std::size_t i = 0; i < refined.force_n.size(); ++i) {
    evidence.numbers.push_back({fmt::format("force_n_fineness_{:g}", refined.fineness[i]), refined.force_n[i], "N"});
  }
  if (refined.order) evidence.numbers.push_back({"observed_order", *refined.order, ""});
  evidence.numbers.push_back({"grid_convergence_percent", 100.0 * refined.grid_convergence, "%", kMeshBarPercent});
  evidence.numbers.push_back({"default_mesh_error_percent", 100.0 * refined.default_error, "%", kMeshBarPercent});
  if (!settings.quick) {
    evidence.numbers.push_back(
        {"step_error_percent", 100.0 * lab::stepError(checkedStack(), kCheckedDepthMm), "%", kStepBarPercent});
  }
  return evidence;
}

/// The force of a press and a drag at 1 kHz against the same at 8 kHz, every millisecond.
Evidence tickLength() {
  constexpr double kDragMm = 30.0;
  constexpr double kShortTickS = 0.001 / 8.0;
  const contact::Surface surface = flatSheet({});
  const std::vector<Vec3> usual = pressFlat(surface, {.drag_mm = kDragMm});
  const std::vector<Vec3> finer = pressFlat(surface, {.drag_mm = kDragMm, .tick_s = kShortTickS});
  double greatest = 0.0;
  std::vector<double> errors;
  for (const Vec3& force : finer) greatest = std::max(greatest, force.norm());
  for (std::size_t i = 0; i < usual.size(); ++i) errors.push_back(100.0 * (usual[i] - finer[i]).norm() / greatest);
  const lab::Spread spread = lab::computeSpread(errors);
  return {.name = "tick_length",
          .title = "Ticks of the servo loop",
          .against = "the same press and drag at eight times the rate",
          .command = "",
          .numbers = {{"greatest_force_n", greatest, "N"},
                      {"ticks", static_cast<double>(spread.count), ""},
                      {"error_mean_percent", spread.mean, "%"},
                      {"error_p95_percent", spread.p95, "%"},
                      {"error_worst_percent", spread.worst, "%", kTickBarPercent}}};
}

/// Errors of the felt force on a ball of this level, %, against Hooke's law on the sphere itself.
lab::Spread facetErrors(int level, std::uint64_t seed) {
  constexpr double kBallMm = 60.0;
  constexpr double kStiffness = 0.5;  // N/mm
  constexpr int kPresses = 200;
  constexpr int kTicks = 60;  // to be pressed
  const mesh::TriangleMesh ball = lab::bumpyBallMesh(kBallMm, 0.0, 1.0, level);
  contact::SurfaceOptions options;
  options.self_intersecting = false;
  const contact::Surface surface =
      contact::buildSurface(ball, std::vector<double>(ball.positions.size(), kStiffness), options);
  Random random(seed);
  std::vector<double> errors;
  for (int press = 0; press < kPresses; ++press) {
    const Vec3 out = random.normal3().normalized();
    contact::FingerState state;
    Vec3 force = Vec3::Zero();
    for (int tick = 0; tick <= kTicks; ++tick) {
      const double depth = kCheckedDepthMm * (2.0 * tick / kTicks - 1.0);
      force = contact::step(surface, {}, state, (kBallMm - depth) * out).force;
    }
    errors.push_back(100.0 * std::abs(force.norm() / (kStiffness * kCheckedDepthMm) - 1.0));
  }
  return lab::computeSpread(errors);
}

Evidence facets(const CredibilitySettings& settings) {
  constexpr int kCoarsest = 4;
  constexpr int kLevels = 3;
  Evidence evidence{.name = "facets",
                    .title = "Triangles of the skin",
                    .against = "Hooke's law on the ball that the triangles stand for",
                    .command = "",
                    .numbers = {}};
  std::vector<lab::Spread> spreads;
  for (int level = kCoarsest; level < kCoarsest + kLevels; ++level) {
    spreads.push_back(facetErrors(level, settings.seed));
    const auto triangles = 8LL << (2 * level);
    evidence.numbers.push_back({fmt::format("error_mean_percent_{}_triangles", triangles), spreads.back().mean, "%"});
  }
  evidence.numbers.push_back({"error_p95_percent", spreads.back().p95, "%"});
  evidence.numbers.push_back({"error_worst_percent", spreads.back().worst, "%", kFacetBarPercent});
  // An error that goes with the square of the edges falls to a quarter.
  evidence.numbers.push_back({"observed_order", std::log2(spreads[kLevels - 2].mean / spreads.back().mean), ""});
  return evidence;
}

Evidence servoTick(const CredibilitySettings& settings) {
  constexpr double kSeconds = 2.0;
  constexpr double kQuickSeconds = 0.2;
  const auto world = scene::build(scene::standardScene());
  const bench::SafetyCost cost =
      bench::measureSafety(*world, device::pathsOf(*world), settings.quick ? kQuickSeconds : kSeconds);
  return {.name = "servo",
          .title = "Time of a tick",
          .against = "the millisecond that a tick has, on this machine",
          .command = "palpate study bench servo --json",
          .numbers = {{"tick_us", cost.tick_us, "us", kMicrosecondsOfATick},
                      {"safety_us", cost.safety_us, "us"},
                      {"blocks", static_cast<double>(cost.blocks), ""}}};
}

}  // namespace

CredibilitySection verifyCalculation(const CredibilitySettings& settings) {
  CredibilitySection section{.name = "calculation_verification", .title = "Calculation verification", .evidence = {}};
  report(settings.progress, "refining elements", 0.0);
  section.evidence.push_back(solverMesh(settings));
  report(settings.progress, "refining ticks and triangles", 0.5);
  section.evidence.push_back(tickLength());
  section.evidence.push_back(facets(settings));
  report(settings.progress, "timing ticks", 0.8);
  section.evidence.push_back(servoTick(settings));
  return section;
}

}  // namespace palpate::study
