// `palpate study bench lump`: what lumps and pressure pads cost a servo tick.
#include "cli/kit/number_option.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/lump_costs.h"

namespace palpate::app {

void addBenchLumpCommand(Command& parent) {
  struct Arguments {
    double seconds = 3.0;
  };
  addBench<Arguments>(
      parent, "lump", "Time lumps under a finger and the pressure on its pad",
      [](Command& command, Arguments& a) {
        addSetting(command, "--seconds", a.seconds, between(0.01, 600.0, "s"), "Duration of the measurement");
      },
      [](const Arguments& a, ProgressLine& progress) {
        return bench::measureLumpCosts(a.seconds, progress.callback());
      });
}

}  // namespace palpate::app
