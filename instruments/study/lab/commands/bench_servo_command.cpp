// `palpate study bench servo`: how punctual the servo loop is, and how long its ticks take, in real time.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/simulate_options.h"
#include "cli/simulate/realtime_run.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/servo_costs.h"
#include "palpate/base/json.h"

namespace palpate::app {
namespace {

constexpr const char* kNaive = "sleep_until";

struct ServoArguments {
  SimulateOptions input;
  bool peers = false;
  bool json = false;
};

lab::Percentiles toPercentiles(const servo::DurationPercentiles& p) {
  return {p.p50_us, p.p99_us, p.p99_9_us, p.max_us};
}

Json toJson(const servo::LoopReport& loop) {
  Json json;
  json["ticks"] = loop.ticks;
  json["seconds"] = loop.wall_s;
  json["lateness_us"] = percentilesJson(toPercentiles(loop.lateness));
  json["compute_us"] = percentilesJson(toPercentiles(loop.compute));
  json["overruns"] = loop.overruns;
  json["slow_ticks"] = loop.slow_ticks;
  json["stalls"] = loop.stalls;
  json["scheduler"] = describeScheduler(loop.grant);
  json["memory_locked"] = loop.grant.memory_locked;
  json["exact_timers"] = loop.grant.exact_timers;
  json["fallback"] = loop.grant.note;
  return json;
}

Json toJson(const RealtimeReport& report) {
  Json json = toJson(report.loop);
  json["dropped_samples"] = report.loop.dropped_samples;
  json["display"] = {{"frames", report.display.frames},
                     {"deform_us", percentilesJson(toPercentiles(report.display.deform))}};
  return json;
}

std::string textOf(const servo::LoopReport& loop) {
  std::string text = fmt::format("ticks          {} in {:.2f} s\n", loop.ticks, loop.wall_s);
  text += fmt::format("lateness       {}\n", percentilesText(toPercentiles(loop.lateness)));
  text += fmt::format("compute        {}\n", percentilesText(toPercentiles(loop.compute)));
  text += fmt::format("overruns       {} deadlines without a tick; {} ticks longer than a period, {} stalls\n",
                      loop.overruns, loop.slow_ticks, loop.stalls);
  text += fmt::format("scheduler      {}, memory {}, timers {}\n", describeScheduler(loop.grant),
                      loop.grant.memory_locked ? "locked" : "not locked",
                      loop.grant.exact_timers ? "exact" : "with default slack");
  if (!loop.grant.note.empty()) text += fmt::format("               {}\n", loop.grant.note);
  return text;
}

/// Long enough for some thousand pairs of blocks.
constexpr double kMaxSafetyS = 3.0;

void addSafety(const bench::SafetyCost& cost, Json& json, std::string& text) {
  json["safety_us_per_tick"] = cost.safety_us;
  json["safety_tick_us"] = cost.tick_us;
  json["safety_ratio"] = cost.ratio();
  text += fmt::format("safety         {:.3f} us of {:.3f} us, a tick of one finger ({:.0f} %, median of {} blocks)\n",
                      cost.safety_us, cost.tick_us, 100.0 * cost.ratio(), cost.blocks);
}

/// Ours over theirs at p50 of the lateness; null for a clock too coarse to tell.
Json ratio(const servo::LoopReport& ours, const servo::LoopReport& theirs) {
  if (theirs.lateness.p50_us <= 0.0) return nullptr;
  return ours.lateness.p50_us / theirs.lateness.p50_us;
}

void runServoBench(const ServoArguments& arguments) {
  ProgressLine progress;
  SimulateOptions input = arguments.input;
  input.seconds = 0.0;  // here it is how long to measure, not how long the scene lasts
  const auto world = scene::build(sceneFor(input), progress.callback());
  const RealtimeReport ours = measureServo(*world, arguments.input.seconds, progress.display());
  throwIfInterrupted();  // a partial run does not count
  Json json = toJson(ours);
  std::string text = textOf(ours.loop);
  addSafety(bench::measureSafety(*world, device::pathsOf(*world), std::min(kMaxSafetyS, 0.5 * arguments.input.seconds)),
            json, text);
  if (arguments.peers) {
    const auto naive = measureServo(*world, arguments.input.seconds, progress.display(), runSleepUntil).loop;
    throwIfInterrupted();
    json["peers"][kNaive] = toJson(naive);
    json["ratio_to"][kNaive] = ratio(ours.loop, naive);
    text += fmt::format("\n{}\n{}", kNaive, textOf(naive));
  }
  progress.clear();
  printReport(std::move(json), text, arguments.json);
}

}  // namespace

void addBenchServoCommand(Command& parent) {
  auto arguments = std::make_shared<ServoArguments>();
  arguments->input.seconds = 20.0;
  Command& command = *parent.add_subcommand("servo", "Run the servo loop in real time: lateness and compute time");
  addInputOptions(command, arguments->input);
  addSetting(command, "--seconds", arguments->input.seconds, between(0.01, 3600.0, "s"),
             "Duration of the measurement; paths repeat");
  command.add_flag("--peers", arguments->peers, "Also run the naive loop: sleep_until, default scheduling");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments, &command] {
    arguments->input.radius_given = command.count("--radius-mm") > 0;
    runServoBench(*arguments);
  });
}

}  // namespace palpate::app
