// `palpate simulate`: palpates a scene without a device and writes what was felt.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/device_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/results_folder.h"
#include "cli/kit/simulate_options.h"
#include "cli/own/commands.h"
#include "cli/simulate/simulation.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_file.h"

namespace palpate::app {

namespace {

void runSimulate(const SimulateOptions& options) {
  const FinishesInOrder in_order;
  ProgressLine progress;
  const scene::Scene scene = sceneFor(options);
  const ResultsFolder results = resultsFolder(options.out, options.overwrite);
  requireWritableFolder(results.folder);
  SimulationResult result = simulate(
      scene, {results.folder, options.realtime, options.devices, options.recording, options.pictures, options.plot},
      progress.display());
  progress.clear();
  result.preset = options.preset;
  result.files.emplace_back("report.json");
  const std::string json = jsonDump(reportJson(result), 2) + "\n";
  writeFile(result.folder / "report.json", json);
  removeEarlier(results, result.files);
  fmt::print("{}", options.json ? json : formatSummary(result));
}

void addOutputOptions(Command& command, SimulateOptions& options) {
  command.add_option("-o,--out", options.out,
                     "Output folder for forces.csv, forces.png, surfaces (PLY), pictures.png and report.json (default: "
                     "results, or the next free results-N)");
  command.add_flag("--overwrite", options.overwrite, "Replace an earlier run in the folder");
  command.add_flag("--realtime", options.realtime,
                   "Run the servo loop in real time, deform at 60 Hz alongside, and report the servo's lateness");
  command.add_flag(
      "--session", options.recording,
      "Write run.session, with every tick bit for bit, for `palpate recording replay` (docs/reference/recordings.md)");
  command.add_flag("--pictures,!--no-pictures", options.pictures, "Write pictures.png, pictures of the run (default)");
  command.add_flag("--plot,!--no-plot", options.plot, "Write forces.png: force, depth and lag over time (default)");
  command.add_flag("--json", options.json, "Print the report as JSON instead of the summary");
}

}  // namespace

void addSimulateCommand(Command& app) {
  Command* command = app.add_subcommand("simulate", "Palpate a body without a device and write the forces");
  command->group("Touch");
  const auto options = std::make_shared<SimulateOptions>();
  const auto keys = std::make_shared<bool>(false);
  addInputOptions(*command, *options);
  addShapeOptions(*command, *options);
  addSecondsOption(*command, *options);
  addDeviceOption(*command, options->devices,
                  "Device for the first finger; repeat for the second. Its origin is the start of the finger's path. "
                  "Hardware requires --realtime");
  addUnsafeStiffness(*command, options->unsafe_stiffness);
  addOutputOptions(*command, *options);
  command->add_flag("--keys", *keys, "Print every key of scene files (Markdown) and exit");
  command->callback([=] {
    options->radius_given = command->count("--radius-mm") > 0;
    if (*keys) {
      fmt::print("{}", scene::keysAsMarkdown());
    } else {
      runSimulate(*options);
    }
  });
}

}  // namespace palpate::app
