// `palpate study bench recording`: what recording costs the servo, how large a recording is, how fast it is felt again
// and found a place in.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/simulate_options.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/servo_costs.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

struct RecordingArguments {
  SimulateOptions input;
  bench::RecordingRunSettings run;
  bool json = false;
};

/// A temporary folder, removed at the end whatever happens.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& beside) {
    std::string pattern = (beside / "palpate_bench_session_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw Error::inFile(beside.string(), "cannot be written to");
    folder_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The default scene's finger twice: two hands.
scene::Scene sceneOfTwo(const SimulateOptions& input) {
  scene::Scene scene = sceneFor(input);
  if (scene.fingers.size() != 1) return scene;
  scene.fingers.push_back(scene.fingers.front());
  scene.fingers.back().name += "_2";
  return scene;
}

void runRecordingBench(const RecordingArguments& arguments) {
  ProgressLine progress;
  const auto world = scene::build(sceneOfTwo(arguments.input), progress.callback());
  bench::RecordingRunSettings settings = arguments.run;
  const ScratchFolder scratch(settings.folder.empty() ? std::filesystem::temp_directory_path() : settings.folder);
  settings.folder = scratch.path();
  const bench::RecordingRun run =
      bench::measureRecording(*world, device::pathsOf(*world), settings, progress.callback());
  progress.clear();
  const Json json = {{"fingers", run.fingers},
                     {"record_us_per_tick", run.record_us_per_tick},
                     {"tick_us", run.tick_us},
                     {"record_ratio", run.record_us_per_tick / run.tick_us},
                     {"blocks", run.blocks},
                     {"bytes_per_tick", run.bytes_per_tick},
                     {"write_mb_per_s", run.write_mb_per_s},
                     {"write_times_real_time", run.write_times_real_time},
                     {"replay_times_real_time", run.replay_times_real_time},
                     {"identical", run.identical},
                     {"long_hours", run.long_hours},
                     {"long_mb", run.long_mb},
                     {"open_s", run.open_s},
                     {"seek_s", run.seek_s},
                     {"dropped", run.dropped}};
  std::string text = fmt::format(
      "recording      {:.3f} us of the {:.3f} us of a tick of {} fingers (median of {} blocks), {} samples dropped\n",
      run.record_us_per_tick, run.tick_us, run.fingers, run.blocks, run.dropped);
  text += fmt::format("file           {:.0f} bytes a tick, {:.3f} MB a second; written {:.0f} times as fast as felt\n",
                      run.bytes_per_tick, run.write_mb_per_s, run.write_times_real_time);
  text += fmt::format("replay         {:.0f} times real time, {}\n", run.replay_times_real_time,
                      run.identical ? "every bit the same" : "DIFFERENT");
  text += fmt::format("search         {:.2f} h, {:.0f} MB: open {:.1f} ms, open and find {:.1f} ms (worst of 20)\n",
                      run.long_hours, run.long_mb, 1e3 * run.open_s, 1e3 * run.seek_s);
  printReport(json, text, arguments.json);
}

}  // namespace

void addBenchRecordingCommand(Command& parent) {
  const auto arguments = std::make_shared<RecordingArguments>();
  Command& command =
      *parent.add_subcommand("recording", "Time recording, replay and search: cost per tick, bytes, speed");
  addInputOptions(command, arguments->input);
  addSetting(command, "--seconds", arguments->run.seconds, between(1.0, 36000.0, "s"), "Duration to record and replay");
  addSetting(command, "--hours", arguments->run.long_hours, between(0.01, 100.0, "h"),
             "Length of the recording to search; two fingers take about 0.1 GB per hour");
  command.add_option("--folder", arguments->run.folder,
                     "Folder for the temporary files (default: the system's temporary folder)");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments, &command] {
    arguments->input.radius_given = command.count("--radius-mm") > 0;
    runRecordingBench(*arguments);
  });
}

}  // namespace palpate::app
