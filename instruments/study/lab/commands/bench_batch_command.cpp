// `palpate study bench batch`: many fingers on one world and on several threads, against one finger in a plain loop.
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/simulate_options.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/batch_run.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/fingers.h"

namespace palpate::app {
namespace {

struct BatchArguments {
  SimulateOptions input;
  bench::BatchSettings batch;
};

Json toJson(const bench::BatchRates& rates, double native_ticks_per_s) {
  Json json;
  json["ticks_per_s_core"] = rates.one_thread_ticks_per_s;
  json["ticks_per_s"] = rates.ticks_per_s;
  json["thread_scaling"] = rates.scaling();
  json["ratio_to_native"] = native_ticks_per_s > 0.0 ? rates.one_thread_ticks_per_s / native_ticks_per_s : 0.0;
  return json;
}

Json measureBatches(const BatchArguments& arguments, ProgressLine& progress) {
  const auto world = scene::build(sceneFor(arguments.input), progress.callback());
  const contact::FingerSettings finger = engine::fingerSettings(world->scene).front();
  const device::FingerPaths paths = device::pathsOf(*world);
  const bench::BatchFigures f =
      bench::measureBatch(*world, finger, *paths.tips.front(), arguments.batch, progress.callback());
  Json json = toJson(f.batch, f.native_ticks_per_s);
  json["rollout"] = toJson(f.rollout, f.native_ticks_per_s);
  json["native_ticks_per_s"] = f.native_ticks_per_s;
  json["triangles"] = f.triangles;
  json["radius_mm"] = finger.radius_mm;
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

void addBatchOptions(Command& command, BatchArguments& a) {
  addInputOptions(command, a.input);
  addSetting(command, "--fingers", a.batch.fingers, between(1.0, 1e5), "Number of fingers");
  addSetting(command, "--action-ticks", a.batch.action_ticks, between(1.0, 1e4),
             "Ticks that a batch moves one finger before the next");
  addSetting(command, "--threads", a.batch.threads, between(1.0, 1024.0), "Number of threads to compare with one");
  addSetting(command, "--seconds", a.batch.seconds, between(0.01, 3600.0, "s"), "Duration of the measurement");
}

}  // namespace

void addBenchBatchCommand(Command& parent) {
  addBench(parent, "batch", "Step many fingers on several threads, each along the path of the scene's first",
           addBatchOptions, measureBatches);
}

}  // namespace palpate::app
