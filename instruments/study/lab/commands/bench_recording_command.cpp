// `palpate study bench recording`: what recording costs the servo, how large a recording is, how fast it is felt again
// and found a place in.
#include <cstdlib>

#include "cli/kit/number_option.h"
#include "cli/kit/simulate_options.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/recording_run.h"
#include "palpate/base/error.h"

namespace palpate::app {

namespace {

struct RecordingArguments {
  SimulateOptions input;
  bench::RecordingRunSettings run;
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

Json measureRecordings(const RecordingArguments& arguments, ProgressLine& progress) {
  const auto world = scene::build(sceneOfTwo(arguments.input), progress.callback());
  bench::RecordingRunSettings settings = arguments.run;
  const ScratchFolder scratch(settings.folder.empty() ? std::filesystem::temp_directory_path() : settings.folder);
  settings.folder = scratch.path();
  return bench::measureRecording(*world, device::pathsOf(*world), settings, progress.callback());
}

void addRecordingOptions(Command& command, RecordingArguments& a) {
  addInputOptions(command, a.input);
  addSetting(command, "--seconds", a.run.seconds, between(1.0, 36000.0, "s"), "Duration to record and replay");
  addSetting(command, "--hours", a.run.long_hours, between(0.01, 100.0, "h"),
             "Length of the recording to search; two fingers take about 0.1 GB per hour");
  command.add_option("--folder", a.run.folder,
                     "Folder for the temporary files (default: the system's temporary folder)");
}

}  // namespace

void addBenchRecordingCommand(Command& parent) {
  addBench(parent, "recording", "Time recording, replay and search: cost per tick, bytes, speed", addRecordingOptions,
           measureRecordings);
}

}  // namespace palpate::app
