// `palpate study bench lump`: what lumps and pressure pads cost a servo tick.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/lump_costs.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

struct BenchLumpArguments {
  double seconds = 3.0;
  bool json = false;
};

Json lumpCostsJson(const bench::LumpCosts& costs) {
  Json json;
  json["tick_us"] = costs.tick_us;
  json["tick_extra_us"] = {{"1", costs.one_us},
                           {"8", costs.eight_us},
                           {"8_mobile", costs.eight_mobile_us},
                           {"8_and_pad_4", costs.eight_and_pad_us}};
  json["field_us"] = {{"4", costs.field_4_us},
                      {"8", costs.field_8_us},
                      {"16", costs.field_16_us},
                      {"4_of_8_lumps", costs.field_4_of_eight_us}};
  json["allocations"] = costs.allocations ? Json(*costs.allocations) : Json(nullptr);
  json["rounds"] = costs.rounds;
  return json;
}

std::string lumpCostsText(const bench::LumpCosts& costs) {
  std::string text =
      fmt::format("tick         {:.3f} us without lumps; 1 lump {:.3f} us more, 8 lumps {:.3f} us more\n",
                  costs.tick_us, costs.one_us, costs.eight_us);
  text += fmt::format("             8 mobile lumps {:.3f} us more, 8 lumps and a pad of 4 x 4 {:.3f} us more\n",
                      costs.eight_mobile_us, costs.eight_and_pad_us);
  text +=
      fmt::format("pad          4 x 4 {:.3f} us, 8 x 8 {:.3f} us, 16 x 16 {:.3f} us; 4 x 4 over 8 lumps {:.3f} us\n",
                  costs.field_4_us, costs.field_8_us, costs.field_16_us, costs.field_4_of_eight_us);
  return text + fmt::format("allocations  {} in {} rounds\n", countText(costs.allocations), costs.rounds);
}

void runLumpBench(const BenchLumpArguments& arguments) {
  ProgressLine progress;
  const bench::LumpCosts costs = bench::measureLumpCosts(arguments.seconds, progress.callback());
  progress.clear();
  printReport(lumpCostsJson(costs), lumpCostsText(costs), arguments.json);
}

}  // namespace

void addBenchLumpCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "lump", "Time lumps under a finger and the pressure on its pad", runLumpBench);
  addSetting(command, "--seconds", arguments.seconds, between(0.01, 600.0, "s"), "Duration of the measurement");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
