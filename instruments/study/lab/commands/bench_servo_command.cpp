// `palpate study bench servo`: how punctual the servo loop is, and how long its ticks take, in real time.
#include <algorithm>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/simulate_options.h"
#include "cli/simulate/realtime_run.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/safety_run.h"

namespace palpate::app {
namespace {

constexpr const char* kNaive = "sleep_until";

struct ServoArguments {
  SimulateOptions input;
  bool peers = false;
};

Json toJson(const servo::LoopReport& loop) {
  Json json;
  json["ticks"] = loop.ticks;
  json["seconds"] = loop.wall_s;
  json["lateness_us"] = percentilesJson(loop.lateness);
  json["compute_us"] = percentilesJson(loop.compute);
  json["overruns"] = loop.overruns;
  json["slow_ticks"] = loop.slow_ticks;
  json["stalls"] = loop.stalls;
  json["scheduler"] = describeScheduler(loop.grant);
  json["memory_locked"] = loop.grant.memory_locked;
  json["exact_timers"] = loop.grant.exact_timers;
  json["fallback"] = loop.grant.note;
  return json;
}

/// Long enough for some thousand pairs of blocks.
constexpr double kMaxSafetyS = 3.0;

/// Ours over theirs at p50 of the lateness; null for a clock too coarse to tell.
Json ratio(const servo::LoopReport& ours, const servo::LoopReport& theirs) {
  if (theirs.lateness.p50_us <= 0.0) return nullptr;
  return ours.lateness.p50_us / theirs.lateness.p50_us;
}

Json measureServoLoop(const ServoArguments& arguments, ProgressLine& progress) {
  SimulateOptions input = arguments.input;
  input.seconds = 0.0;  // here it is how long to measure, not how long the scene lasts
  const auto world = scene::build(sceneFor(input), progress.callback());
  const RealtimeReport ours = measureServo(*world, arguments.input.seconds, progress.display());
  throwIfInterrupted();  // a partial run does not count
  Json json = toJson(ours.loop);
  json["dropped_samples"] = ours.loop.dropped_samples;
  json["display"] = {{"frames", ours.display.frames}, {"deform_us", percentilesJson(ours.display.deform)}};
  const bench::SafetyCost safety =
      bench::measureSafety(*world, device::pathsOf(*world), std::min(kMaxSafetyS, 0.5 * arguments.input.seconds));
  json["safety_us_per_tick"] = safety.safety_us;
  json["safety_tick_us"] = safety.tick_us;
  json["safety_ratio"] = safety.ratio();
  if (!arguments.peers) return json;
  const auto naive = measureServo(*world, arguments.input.seconds, progress.display(), runSleepUntil).loop;
  throwIfInterrupted();
  json["peers"][kNaive] = toJson(naive);
  json["ratio_to"][kNaive] = ratio(ours.loop, naive);
  return json;
}

void addServoOptions(Command& command, ServoArguments& a) {
  a.input.seconds = 20.0;
  addInputOptions(command, a.input);
  addSetting(command, "--seconds", a.input.seconds, between(0.01, 3600.0, "s"),
             "Duration of the measurement; paths repeat");
  command.add_flag("--peers", a.peers, "Also run the naive loop: sleep_until, default scheduling");
}

}  // namespace

void addBenchServoCommand(Command& parent) {
  addBench(parent, "servo", "Run the servo loop in real time: lateness and compute time", addServoOptions,
           measureServoLoop);
}

}  // namespace palpate::app
