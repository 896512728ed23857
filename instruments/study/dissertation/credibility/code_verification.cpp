// Does the code do what its equations say? Printed numbers, kept bits, a hunt with an independent oracle, and the
// solver against Hertz and its own energy.
#include "dissertation/credibility/credibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "dissertation/credibility/checked_stack.h"
#include "dissertation/numbers/numbers_study.h"
#include "lab/hunt/hunt.h"
#include "lab/runs/scene_bits.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/scene/presets.h"
#include "solve/realism/solver_checks.h"

namespace palpate::study {

namespace {

constexpr double kNoneAllowed = 0.0;
/// Bars of docs/explanation/tissue.md.
constexpr double kHertzBarPercent = 0.8;
constexpr double kHertzContactBarPercent = 4.5;  ///< elements are a tenth of the radius; half of one is seen
constexpr double kEnergyBarPercent = 0.1;

double asNumber(std::size_t count) { return static_cast<double>(count); }

Evidence printedNumbersEvidence() {
  const std::vector<NumberRow> rows = studyNumbers();
  const auto count = [&](Verdict verdict) { return static_cast<double>(countRows(rows, verdict)); };
  return {.name = "numbers",
          .title = "Printed numbers",
          .against = "numbers that W. Ji's dissertation prints",
          .command = "palpate study numbers --json",
          .numbers = {{"from_engine", count(Verdict::from_engine), ""},
                      {"arithmetic", count(Verdict::arithmetic), ""},
                      {"misprints", count(Verdict::misprint), ""},
                      {"not_reproduced", count(Verdict::not_reproduced), "", kNoneAllowed},
                      {"inconsistent_statements", count(Verdict::inconsistent), ""},
                      {"not_computable", count(Verdict::not_computable), ""}}};
}

/// The scene that is compiled in under the name of its file; nothing for one of a file alone.
std::optional<scene::Scene> compiledScene(const std::string& stem) {
  if (stem == "default") return scene::standardScene();
  const auto found = std::ranges::find_if(
      scene::presets(), [&](const scene::Preset& preset) { return preset.file == stem && !preset.as_printed; });
  if (found == scene::presets().end()) return std::nullopt;
  return scene::presetScene(found->name);
}

std::uint64_t hexIn(const Json& row, const char* key) {
  return std::strtoull(row.at(key).get<std::string>().c_str(), nullptr, 16);
}

Evidence keptBits(const CredibilitySettings& settings) {
  double scenes = 0.0;
  double elsewhere = 0.0;
  double differ = 0.0;
  for (const std::string_view line : split(settings.data.kept_bits, '\n')) {
    if (line.empty()) continue;
    const Json row = Json::parse(line);
    const auto scene = compiledScene(row.at("scene").get<std::string>());
    if (!scene || (settings.quick && scenes > 0.0)) {
      ++elsewhere;
      continue;
    }
    const bench::SceneBits bits = bench::bitsOf(*scene::build(*scene));
    ++scenes;
    if (bits != bench::SceneBits{hexIn(row, "world"), hexIn(row, "forces"), hexIn(row, "skin")}) ++differ;
  }
  return {.name = "kept_bits",
          .title = "The same bits as on every platform",
          .against = "bodies, forces and skins kept from earlier runs (tests/platforms/kept.jsonl)",
          .command = "tools/check-platforms gcc",
          .numbers = {{"scenes", scenes, ""},
                      {"scenes_differ", differ, "", kNoneAllowed},
                      {"scenes_not_felt_here", elsewhere, ""}}};
}

Evidence hunted(const CredibilitySettings& settings) {
  lab::HuntPlan plan;
  plan.ticks = huntedTicks(settings);
  plan.seed = settings.seed;
  const lab::HuntResult result = lab::hunt(plan, settings.progress);
  Evidence evidence{.name = "hunt",
                    .title = "Contact on random bodies",
                    .against = "a judge with geometry of its own (docs/howto/hunt.md)",
                    .command = fmt::format("palpate study hunt --ticks {} --seed {} --json", plan.ticks, plan.seed),
                    .numbers = {{"ticks", asNumber(result.ticks), ""},
                                {"touching_ticks", asNumber(result.touching_ticks), ""},
                                {"bodies", asNumber(result.bodies), ""},
                                {"paths", asNumber(result.paths), ""},
                                {"failing_paths", asNumber(result.failing.size()), "", kNoneAllowed}}};
  for (std::size_t fault = 0; fault < lab::kFaults; ++fault) {
    evidence.numbers.push_back({fmt::format("{}_ticks", lab::nameOf(static_cast<lab::Fault>(fault))),
                                asNumber(result.fault_ticks[fault]), "", kNoneAllowed});
  }
  return evidence;
}

Evidence solverAgainstTheory() {
  const lab::HertzCheck hertz = lab::checkHertz();
  return {.name = "solver",
          .title = "The tissue solver against theory",
          .against = "Hertz for a small press on a deep block, and the work of the sphere",
          .command = "",
          .numbers = {{"hertz_force_error_percent", 100.0 * hertz.force_error, "%", kHertzBarPercent},
                      {"hertz_contact_error_percent", 100.0 * hertz.contact_error, "%", kHertzContactBarPercent},
                      {"energy_error_percent", 100.0 * lab::energyError(checkedStack(), kCheckedDepthMm), "%",
                       kEnergyBarPercent}}};
}

}  // namespace

std::size_t huntedTicks(const CredibilitySettings& settings) {
  constexpr std::size_t kTicks = 400000;
  constexpr std::size_t kQuickTicks = 20000;
  return settings.quick ? kQuickTicks : kTicks;
}

CredibilitySection verifyCode(const CredibilitySettings& settings) {
  CredibilitySection section{.name = "code_verification", .title = "Code verification", .evidence = {}};
  section.evidence.push_back(printedNumbersEvidence());
  report(settings.progress, "feeling the kept scenes", 0.0);
  section.evidence.push_back(keptBits(settings));
  section.evidence.push_back(hunted(settings));
  report(settings.progress, "pressing a deep block", 1.0);
  section.evidence.push_back(solverAgainstTheory());
  return section;
}

}  // namespace palpate::study
