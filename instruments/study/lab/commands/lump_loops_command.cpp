// `palpate lump loops`: whether lumps give energy away. Adds itself to the command of
// `instruments/study/solve/commands/lump_command.cpp`.
#include <fmt/format.h>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/commands.h"
#include "lab/loops/lump_loops.h"
#include "report/page/figures_text.h"

namespace palpate::app {

namespace {

/// Shares of the stored energy; and N mm.
constexpr double kMaxShare = 1e-5;
constexpr double kMaxGivenNMm = 1e-5;
/// Limit of the stability map where a run may start.
constexpr double kMaxPortEnergyMj = 0.01;
/// A rule whose error falls with the square gains a factor of four; mere rounding gains nothing.
constexpr double kRounding = 1e-9;
constexpr double kFourfold = 3.0;

struct LumpLoopsArguments {
  lab::ClosedPathsPlan closed;
  lab::HeldLumpsPlan held;
  lab::StiffestLumpPlan stiffest;
  std::uint64_t seed = 1;
  std::size_t threads = 0;
  bool json = false;
};

bool convergesQuadratically(const lab::ClosedPathsFigures& closed) {
  if (closed.by_steps.size() < 3 || closed.by_steps[0].mean_share < kRounding) return true;
  return closed.by_steps[1].mean_share > kFourfold * closed.by_steps[0].mean_share;
}

/// Results of the three measurements.
struct LumpLoops {
  lab::ClosedPathsFigures closed;
  lab::HeldLumpsFigures held;
  lab::StiffestLumpFigures stiffest;
};

bool holds(const LumpLoops& loops) {
  const auto& [closed, held, stiffest] = loops;
  return closed.worstShare() <= kMaxShare && convergesQuadratically(closed) && held.given_back_n_mm <= kMaxGivenNMm &&
         held.oscillating == 0 && stiffest.oscillating == 0 && stiffest.port_energy_mj <= kMaxPortEnergyMj;
}

Json loopsJson(const LumpLoops& loops, std::uint64_t seed) {
  const auto& [closed, held, stiffest] = loops;
  Json json = {{"holds", holds(loops)},
               {"worst_work_n_mm", closed.worst_work_n_mm},
               {"stored_n_mm", closed.stored_n_mm},
               {"worst_work_share", closed.worstShare()},
               {"falls_with_the_square", convergesQuadratically(closed)},
               {"by_step", Json::array()},
               {"paths", closed.paths},
               {"ticks", closed.ticks},
               {"lumps", closed.lumps},
               {"mobile",
                {{"paths", held.paths},
                 {"with_two_fingers", held.with_two_fingers},
                 {"moved", held.felt},
                 {"farthest_mm", held.farthest_mm},
                 {"given_back_n_mm", held.given_back_n_mm},
                 {"lost_n_mm", held.lost_n_mm},
                 {"oscillating", held.oscillating}}},
               {"stiffest",
                {{"systems", stiffest.systems},
                 {"slope_n_per_mm", stiffest.slope_n_per_mm},
                 {"oscillating", stiffest.oscillating},
                 {"oscillating_bare", stiffest.oscillating_bare},
                 {"port_energy_mj", stiffest.port_energy_mj}}},
               {"seed", seed}};
  for (const auto& by_step : closed.by_steps) {
    json["by_step"].push_back({{"step_mm", by_step.step_mm},
                               {"worst_work_share", by_step.worst_share},
                               {"mean_work_share", by_step.mean_share}});
  }
  return json;
}

void runLumpLoops(LumpLoopsArguments arguments) {
  ProgressLine progress;
  arguments.closed.seed = arguments.held.seed = arguments.seed;
  arguments.closed.threads = arguments.held.threads = arguments.stiffest.threads = arguments.threads;
  const LumpLoops loops{lab::measureClosedPaths(arguments.closed, progress.callback()),
                        lab::measureHeldLumps(arguments.held, progress.callback()),
                        lab::measureStiffestLump(arguments.stiffest, progress.callback())};
  progress.clear();
  const Json json = loopsJson(loops, arguments.seed);
  fmt::print("{}", arguments.json ? jsonText(json) : study::figuresText(json));
  if (!holds(loops)) throw ExitWith(1);
}

}  // namespace

void addLumpLoopsCommand(Command& lump) {
  const auto [command, a] = addCommand<LumpLoopsArguments>(
      lump, "loops", "Check that lumps give no energy away on random paths (exit code 0: they do not, 1: they do)",
      runLumpLoops);
  addSetting(command, "--paths", a.closed.paths, between(1, 1e7),
             "Number of closed paths without friction over fixed lumps");
  addSetting(command, "--step-mm", a.closed.step_mm, between(0.001, 1.0, "mm"),
             "Mean step of a closed path; steps twice and four times as long are used too");
  addSetting(command, "--hands", a.held.paths, between(1, 1e6),
             "Number of paths of simulated hands over a mobile lump, every second one with two fingers");
  addSetting(command, "--seconds", a.held.seconds, between(0.5, 60.0, "s"), "Duration of a hand's path");
  addSetting(command, "--systems", a.stiffest.systems, between(1, 1e5),
             "Number of random devices and hands to kick over the stiffest lump");
  addSetting(command, "--seed", a.seed, between(0, 1e15),
             "Seed of lumps, paths and hands; the same seed gives the same result");
  addSetting(command, "--threads", a.threads, between(0, 1024), "Number of threads; 0: one per processor");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
