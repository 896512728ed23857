// `palpate study bench batch`: many fingers on one world and on several threads, against one finger in a plain loop.
#include <fmt/format.h>

#include <string>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/simulate_options.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/servo_costs.h"
#include "palpate/base/json.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/fingers.h"

namespace palpate::app {
namespace {

struct BatchArguments {
  SimulateOptions input;
  bench::BatchSettings batch;
  bool json = false;
};

double ratioOrZero(double value, double to) { return to > 0.0 ? value / to : 0.0; }

Json toJson(const bench::BatchRates& rates, double native_ticks_per_s) {
  Json json;
  json["ticks_per_s_core"] = rates.one_thread_ticks_per_s;
  json["ticks_per_s"] = rates.ticks_per_s;
  json["thread_scaling"] = rates.scaling();
  json["ratio_to_native"] = ratioOrZero(rates.one_thread_ticks_per_s, native_ticks_per_s);
  return json;
}

Json toJson(const BatchArguments& arguments, double radius_mm, const bench::BatchFigures& f) {
  Json json = toJson(f.batch, f.native_ticks_per_s);
  json["rollout"] = toJson(f.rollout, f.native_ticks_per_s);
  json["native_ticks_per_s"] = f.native_ticks_per_s;
  json["triangles"] = f.triangles;
  json["radius_mm"] = radius_mm;
  json["fingers"] = arguments.batch.fingers;
  json["action_ticks"] = arguments.batch.action_ticks;
  json["threads"] = arguments.batch.threads;
  json["pass_ticks"] = f.pass_ticks;
  json["touching"] = f.touching;
  json["different"] = f.different;
  json["allocations"] = orNull(f.allocations);
  json["locks"] = orNull(f.locks);
  return json;
}

std::string formatRateLine(const char* name, const bench::BatchRates& rates, std::size_t threads,
                           double native_ticks_per_s) {
  return fmt::format("{:14} {:.2f} M ticks/s on one thread, {:.2f} of the loop; {:.2f} M on {}, {:.2f} times one\n",
                     name, 1e-6 * rates.one_thread_ticks_per_s,
                     ratioOrZero(rates.one_thread_ticks_per_s, native_ticks_per_s), 1e-6 * rates.ticks_per_s, threads,
                     rates.scaling());
}

std::string textOf(const BatchArguments& arguments, double radius_mm, const bench::BatchFigures& f) {
  std::string text = fmt::format("triangles      {}\n", f.triangles);
  text += fmt::format("fingers        {} of {} mm, {:.0f} % of {} ticks in contact\n", arguments.batch.fingers,
                      radius_mm, 100.0 * f.touching, f.pass_ticks);
  text += fmt::format("one in a loop  {:.2f} M ticks/s\n", 1e-6 * f.native_ticks_per_s);
  text += formatRateLine("batch", f.batch, arguments.batch.threads, f.native_ticks_per_s);
  text += formatRateLine("rollout", f.rollout, arguments.batch.threads, f.native_ticks_per_s);
  text += fmt::format("felt otherwise {} fingers with more threads\n", f.different);
  return text + fmt::format("allocations    {}, locks {}\n", countText(f.allocations), countText(f.locks));
}

void runBatchBench(const BatchArguments& arguments) {
  ProgressLine progress;
  const auto world = scene::build(sceneFor(arguments.input), progress.callback());
  const contact::FingerSettings finger = engine::fingerSettings(world->scene).front();
  const device::FingerPaths paths = device::pathsOf(*world);
  const bench::BatchFigures figures =
      bench::measureBatch(*world, finger, *paths.tips.front(), arguments.batch, progress.callback());
  progress.clear();
  printReport(toJson(arguments, finger.radius_mm, figures), textOf(arguments, finger.radius_mm, figures),
              arguments.json);
}

}  // namespace

void addBenchBatchCommand(Command& parent) {
  auto arguments = std::make_shared<BatchArguments>();
  Command& command =
      *parent.add_subcommand("batch", "Step many fingers on several threads, each along the path of the scene's first");
  addInputOptions(command, arguments->input);
  addSetting(command, "--fingers", arguments->batch.fingers, between(1.0, 1e5), "Number of fingers");
  addSetting(command, "--action-ticks", arguments->batch.action_ticks, between(1.0, 1e4),
             "Ticks that a batch moves one finger before the next");
  addSetting(command, "--threads", arguments->batch.threads, between(1.0, 1024.0),
             "Number of threads to compare with one");
  addSetting(command, "--seconds", arguments->batch.seconds, between(0.01, 3600.0, "s"), "Duration of the measurement");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments, &command] {
    arguments->input.radius_given = command.count("--radius-mm") > 0;
    runBatchBench(*arguments);
  });
}

}  // namespace palpate::app
