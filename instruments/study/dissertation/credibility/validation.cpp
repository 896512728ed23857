// How far is the model from measurements and solutions made elsewhere? One piece of evidence for each data set.
#include "dissertation/credibility/credibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "dissertation/interpolation/interpolation_findings.h"
#include "dissertation/interpolation/left_out.h"
#include "dissertation/relaxation/relaxation_measurement.h"
#include "solve/realism/fem_cases.h"
#include "solve/realism/living_limbs.h"
#include "solve/realism/living_tests.h"
#include "solve/realism/lump_judge.h"
#include "solve/realism/realism.h"
#include "solve/realism/realism_stacks.h"
#ifdef PALPATE_HAS_TEACH
#include "teach/study/lump_measurement.h"
#endif

namespace palpate::study {

namespace {

/// Bars of docs/explanation/tissue.md: layered stacks, presses of 5 mm and more.
constexpr double kNormalBarPercent = 1.5;
constexpr double kVectorBarPercent = 2.0;
constexpr double kForceBarPercent = 10.0;
constexpr double kDragBarPercent = 3.0;
/// Bars of docs/reference/lump-figures.md.
constexpr double kLumpForceBarPercent = 10.0;
constexpr double kLumpPressureBarPercent = 20.0;
constexpr double kLumpFieldBarPercent = 2.0;

/// count, mean, p95 and worst of some errors, the last with a bar.
void addSpread(Evidence& evidence, const std::string& of, const std::string& unit, const lab::Spread& spread,
               std::optional<double> bar) {
  const std::string in = unit == "%" ? "percent" : unit;
  evidence.numbers.push_back({fmt::format("{}_count", of), static_cast<double>(spread.count), ""});
  evidence.numbers.push_back({fmt::format("{}_mean_{}", of, in), spread.mean, unit});
  evidence.numbers.push_back({fmt::format("{}_p95_{}", of, in), spread.p95, unit});
  evidence.numbers.push_back({fmt::format("{}_worst_{}", of, in), spread.worst, unit, bar});
}

/// The cases of the first stack alone.
lab::FemCases ofOneStack(lab::FemCases cases) {
  const std::string name = cases.cases.front().name;
  std::erase_if(cases.cases, [&](const lab::FemCase& one) { return one.name != name; });
  return cases;
}

Evidence independentSolver(const CredibilitySettings& settings) {
  lab::FemCases cases = lab::parseFemCases(settings.data.fem_profiles, "fem_profiles.json");
  if (settings.quick) cases = ofOneStack(std::move(cases));
  const lab::RealismFigures figures =
      lab::judgeRealism(lab::stacksOfCases(cases, settings.progress), settings.progress);
  std::vector<double> force, normal, vector, drag;
  for (const lab::JudgedPress& press : figures.presses) {
    if (!press.layered_stack || press.depth_mm < lab::kJudgedFromMm) continue;
    force.push_back(100.0 * std::abs(press.layered.force_error));
    normal.push_back(100.0 * press.layered.shape.normal_rms);
    vector.push_back(100.0 * press.layered.shape.vector_rms);
  }
  for (const lab::JudgedDrag& judged : figures.drags) {
    if (judged.layered_stack) drag.push_back(100.0 * judged.layered_rms);
  }
  Evidence evidence{.name = "fem_profiles",
                    .title = "Presses of an independent solver",
                    .against = "finite elements of another program (tests/data/golden/fem_profiles.json)",
                    .command = "palpate tissue realism --cases tests/data/golden/fem_profiles.json --json",
                    .numbers = {}};
  addSpread(evidence, "force", "%", lab::computeSpread(force), kForceBarPercent);
  addSpread(evidence, "normal", "%", lab::computeSpread(normal), kNormalBarPercent);
  addSpread(evidence, "vector", "%", lab::computeSpread(vector), kVectorBarPercent);
  addSpread(evidence, "drag", "%", lab::computeSpread(drag), kDragBarPercent);
  return evidence;
}

Evidence independentLumps(const CredibilitySettings& settings) {
  lab::LumpCases cases = lab::parseLumpCases(settings.data.lumps, "lumps.json");
  const lab::LumpFindings found = lab::judgeLumps(cases, settings.progress);
  Evidence evidence{.name = "lumps",
                    .title = "Lumps of an independent solver",
                    .against = "finite elements with the lump in the mesh (tests/data/golden/lumps.json)",
                    .command = "palpate lump check --cases tests/data/golden/lumps.json --json",
                    .numbers = {}};
  addSpread(evidence, "force", "%", found.force, kLumpForceBarPercent);
  addSpread(evidence, "pressure", "%", found.pressure, kLumpPressureBarPercent);
  addSpread(evidence, "field", "%", found.field, kLumpFieldBarPercent);
  return evidence;
}

/// Five people: predicts each measured point from the rest. The prediction must be nearer than the mean of the others,
/// which needs no map.
Evidence measuredEllipses() {
  std::vector<TensorSet> sets = subjectSets(maps::ForceDirection::up);
  const std::vector<TensorSet> down = subjectSets(maps::ForceDirection::down);
  const double scatter_mm = subjectScatterMm(sets);
  sets.insert(sets.end(), down.begin(), down.end());
  const LeftOutErrors errors = leftOutErrors(sets, Interpolator::gri, kEffectRadius);
  const LeftOutErrors without_map = leftOutErrors(sets, Interpolator::mean, kEffectRadius);
  Evidence evidence{.name = "measured_ellipses",
                    .title = "Ellipses measured on people",
                    .against = "points left out of Appendix C of the dissertation",
                    .command = "palpate study interpolation --json",
                    .numbers = {{"boundary_rms_mm", errors.rms_mm, "mm", without_map.rms_mm},
                                {"people_at_one_point_rms_mm", scatter_mm, "mm"}}};
  addSpread(evidence, "boundary", "mm", lab::computeSpread(errors.each_mm), {});
  return evidence;
}

Evidence beef(const CredibilitySettings& settings) {
  const RelaxationMeasurement found = measureRelaxation(settings.quick, settings.progress);
  std::vector<double> errors;
  for (const BeefLoss& loss : beefLosses(found)) errors.push_back(100.0 * std::abs(loss.lost - loss.recorded));
  Evidence evidence{.name = "relaxation",
                    .title = "Force that falls while it is held",
                    .against = "recordings of dead beef, to which two terms were fitted",
                    .command = "palpate study relaxation --json",
                    .numbers = {}};
  addSpread(evidence, "lost_force", "%", lab::computeSpread(errors), 100.0 * kBeefBar);
  return evidence;
}

#ifdef PALPATE_HAS_TEACH
/// Whether people find a lump, as published; the figures that the observer was fitted to are left out.
Evidence lumpsFoundByPeople(const CredibilitySettings& settings) {
  const LumpMeasurement found = measureLumps(lumpPlan({.quick = true}), settings.progress);
  Evidence evidence{.name = "found_lumps",
                    .title = "Lumps that people find in silicone",
                    .against = "shares of found lumps in two published studies, by simulated trainees",
                    .command = "palpate study lumps --quick --json",
                    .numbers = {}};
  for (const ExaminedGroup& group : found.groups) {
    std::vector<double> errors;
    for (const DetectionFigure& figure : group.figures) {
      if (!figure.fitted && std::isfinite(figure.printed)) errors.push_back(std::abs(figure.found - figure.printed));
    }
    const bool later = &group == &found.groups.front();
    addSpread(evidence, group.name, "points", lab::computeSpread(errors),
              later ? LumpMeasurement::kLaterBarPoints : LumpMeasurement::k1985BarPoints);
  }
  return evidence;
}
#endif

/// People with even numbers, whom nothing was fitted to.
Evidence livingLimbs(const CredibilitySettings& settings) {
  const lab::LivingTests living = lab::readLivingTests(settings.living);
  std::vector<lab::LivingTest> tests = living.tests;
  std::erase_if(tests, [](const lab::LivingTest& test) { return test.person % 2 != 0; });
  std::set<int> people;
  for (const lab::LivingTest& test : tests) people.insert(test.person);
  const std::vector<double> n_per_mm = lab::probeStiffnesses(tests, lab::LimbModel::relaxed_limb, settings.progress);
  const lab::LivingFigures figures = lab::livingFigures(tests, n_per_mm);
  std::vector<double> errors;
  for (std::size_t i = 0; i < tests.size(); ++i)
    errors.push_back(100.0 * std::abs(n_per_mm[i] / tests[i].n_per_mm - 1.0));
  Evidence evidence{.name = "living_limbs",
                    .title = "Stiffness of living limbs under a probe",
                    .against = "the list of doi 10.18735/S5R97F; muscle fitted to other people of it",
                    .command = "palpate tissue realism --json --living DIR",
                    .numbers = {{"people", static_cast<double>(people.size()), ""},
                                {"stiffness_median_percent", 100.0 * figures.median_error, "%"},
                                {"bias_percent", 100.0 * figures.bias, "%"}}};
  addSpread(evidence, "stiffness", "%", lab::computeSpread(errors), {});
  return evidence;
}

}  // namespace

CredibilitySection validate(const CredibilitySettings& settings) {
  CredibilitySection section{.name = "validation", .title = "Validation", .evidence = {}};
  section.evidence.push_back(independentSolver(settings));
  if (!settings.quick) section.evidence.push_back(independentLumps(settings));
  section.evidence.push_back(measuredEllipses());
  section.evidence.push_back(beef(settings));
#ifdef PALPATE_HAS_TEACH
  if (!settings.quick) section.evidence.push_back(lumpsFoundByPeople(settings));
#endif
  if (!settings.living.empty()) section.evidence.push_back(livingLimbs(settings));
  return section;
}

}  // namespace palpate::study
