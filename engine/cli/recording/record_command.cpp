// `palpate recording new`: palpates with devices, without a window, until the user ends it; every tick goes into a
// recording.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "cli/kit/device_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/simulate_options.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/system/process.h"
#include "palpate/device/device_profile.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/recorder.h"
#include "palpate/servo/device_limits.h"

namespace palpate::app {

namespace {

struct RecordArguments {
  SimulateOptions input;
  std::vector<std::string> devices;
  std::filesystem::path out;
  std::string notes;
  std::string tags;
  bool overwrite = false;
  bool json = false;
};

/// Lines of the standard input as they come, without waiting for them.
class Lines {
 public:
  /// The text typed before an Enter, if any.
  std::optional<std::string> popLine() {
    while (const std::optional<char> letter = system::typedLetter(open_)) {
      if (*letter == '\n') return std::exchange(line_, {});
      if (*letter != '\r') line_ += *letter;
    }
    return std::nullopt;
  }

 private:
  std::string line_;
  bool open_ = true;
};

/// Fingers without a device follow the scene's paths.
std::vector<device::Device> devicesFor(const RecordArguments& arguments, const scene::World& world,
                                       const device::FingerPaths& paths) {
  std::vector<device::OpenOptions> fingers(paths.tips.size());
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    fingers[i].tips = paths.tips[i];
    fingers[i].tick_s = 1.0 / world.scene.ticks_per_s;
  }
  std::vector<device::Device> devices = openDevices(arguments.devices, fingers);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    devices[i] = placedDevice(devices[i], arguments.devices[i], i, paths.tips[i]->front(), world.scene);
  }
  for (std::size_t i = devices.size(); i < fingers.size(); ++i) {
    devices.push_back(device::scriptedDevice(world.scene.fingers[i].name, paths.tips[i]));
  }
  return devices;
}

device::DeviceProfile profileFor(const RecordArguments& arguments, const scene::World& world,
                                 const std::vector<device::Device>& devices) {
  std::vector<device::Capabilities> able;
  for (std::size_t i = 0; i < arguments.devices.size(); ++i) able.push_back(devices[i].capabilities);
  const device::DeviceProfile profile = device::profileOf(world.scene.safety.device, able);
  servo::requireStable(profile, world.scene.safety, 1.0 / world.scene.ticks_per_s);
  return profile;
}

/// The limits of the weakest device hold for all fingers.
engine::ServoPlan planFor(const std::shared_ptr<const scene::World>& world, const device::DeviceProfile& profile) {
  engine::ServoPlan plan = engine::servoPlan(world, engine::fingerSettings(world->scene));
  plan.limiter = servo::limiterSettings(*world, profile);
  return plan;
}

engine::RecorderSettings recorderSettings(const RecordArguments& arguments, const scene::World& world,
                                          const std::vector<device::Device>& devices) {
  engine::RecorderSettings settings;
  settings.file = arguments.out;
  settings.header = engine::recordingHeader(world.scene.ticks_per_s);
  settings.header.notes = arguments.notes.empty() ? world.scene.title : arguments.notes;
  settings.header.tags = arguments.tags;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    settings.fingers.push_back(engine::recordingFinger(world.scene.fingers[i].name, devices[i]));
  }
  return settings;
}

std::string formatStatus(const engine::RecorderState& state, const servo::TickSamples& felt,
                         const scene::Scene& scene) {
  std::string text = fmt::format("{:.1f} s", state.seconds);
  for (std::size_t i = 0; i < felt.size(); ++i) {
    text += fmt::format(", {} {:.2f} N {:.1f} mm", scene.fingers[i].name, felt[i].contact.force.norm(),
                        felt[i].contact.depth_mm);
  }
  if (state.dropped > 0) text += fmt::format(", {} samples dropped", state.dropped);
  return text;
}

/// Handles marks, devices that reconnect and a line of status, until the end. Returns the number of marks.
std::size_t waitForRecordingEnd(engine::ServoThread& servo, engine::Recorder& recorder,
                                const std::vector<device::Device>& devices, double seconds, const scene::Scene& scene) {
  constexpr std::chrono::milliseconds kLook{20};
  constexpr int kLooksPerTending = 50;  // one second: a driver may be slow
  const bool terminal = system::isStderrTerminal();
  Lines lines;
  std::size_t marks = 0;
  if (terminal) say("Enter sets a mark (with what was typed before it), Ctrl+C ends the recording\n");
  for (int look = 1;; ++look) {
    const engine::RecorderState state = recorder.state();
    if (endingSignal() != 0 || !state.failure.empty() || state.seconds >= seconds) break;
    if (const auto line = lines.popLine()) {
      recorder.mark(line->empty() ? fmt::format("mark {}", marks + 1) : *line);
      ++marks;
    }
    if (look % kLooksPerTending == 0) {
      for (const std::string& trouble : device::reviveDevices(devices)) say("\n" + trouble + "\n");
    }
    if (terminal && look % 10 == 0) say("\r\x1b[K" + formatStatus(state, servo.contacts(), scene));
    trace::Sample sample;
    while (servo.pop(sample)) {
    }
    std::this_thread::sleep_for(kLook);
  }
  if (terminal) say("\r\x1b[K");
  return marks;
}

void runRecord(const RecordArguments& arguments) {
  if (!arguments.overwrite && std::filesystem::exists(arguments.out)) {
    throw Error::inFile(arguments.out.string(), "already exists; use another name, or --overwrite");
  }
  ProgressLine progress;
  const auto world = scene::build(sceneFor(arguments.input), progress.callback());
  progress.clear();
  const FinishesInOrder in_order;
  const device::FingerPaths paths = device::pathsOf(*world);
  const std::vector<device::Device> devices = devicesFor(arguments, *world, paths);
  const double scripted_s = static_cast<double>(paths.ticks) / world->scene.ticks_per_s;
  const double for_ever = arguments.devices.empty() ? scripted_s : std::numeric_limits<double>::infinity();
  const device::DeviceProfile profile = profileFor(arguments, *world, devices);
  const std::vector<std::string> notes =
      servo::safetyNotes(world->scene.safety, profile, 1.0 / world->scene.ticks_per_s);
  printUnsafeNotes(notes);
  engine::ServoThread servo(planFor(world, profile), devices);
  const StoppedBySignal stopped(servo.emergencyStop());
  engine::Recorder recorder(servo, recorderSettings(arguments, *world, devices));
  const std::size_t marks = waitForRecordingEnd(
      servo, recorder, devices, arguments.input.seconds > 0.0 ? arguments.input.seconds : for_ever, world->scene);
  const servo::LoopReport loop = servo.stop();
  recorder.finish(endingSignal() == 0 ? "done" : nameOfSignal(endingSignal()));
  const trace::RecordingReader recording(arguments.out);
  if (arguments.json) {
    Json json = {{"file", arguments.out.string()}};
    json.update(factsJson(recording.facts()));
    json["safety_notes"] = notes;
    json["marks"] = marks;
    json["overruns"] = loop.overruns;
    json["stalls"] = loop.stalls;
    fmt::print("{}\n", jsonDump(json, 2));
    return;
  }
  fmt::print("{}\n  {}; {} marks, {} deadlines missed\n", arguments.out.string(), recordingLine(recording.facts()),
             marks, loop.overruns);
  for (const std::string& note : notes) fmt::print("  note  {}\n", note);
}

}  // namespace

void addRecordCommand(Command& recording) {
  const auto arguments = std::make_shared<RecordArguments>();
  RecordArguments& a = *arguments;
  Command& command =
      *recording.add_subcommand("new", "Record palpation with devices in real time, without a window, until Ctrl+C");
  addInputOptions(command, a.input);
  addNumber(command, "--seconds", a.input.seconds, above(0.0, 864000.0, "s"),
            "Duration of the recording (default: until Ctrl+C; without a device, until the last path has ended)");
  addDeviceOption(command, a.devices, "Device for the first finger, in place of its path; repeat for the next");
  addUnsafeStiffness(command, a.input.unsafe_stiffness);
  namesFileToWrite(command.add_option("-o,--out", a.out, "Recording file to write"))->required();
  command.add_flag("--overwrite", a.overwrite, "Replace an existing recording of that name");
  command.add_option("--notes", a.notes, "Description in one sentence (default: the scene's title)");
  command.add_option("--tags", a.tags, "Search words, separated by spaces");
  command.add_flag("--json", a.json, "Print one JSON object at the end");
  command.callback([arguments, &command] {
    arguments->input.radius_given = command.count("--radius-mm") > 0;
    runRecord(*arguments);
  });
}

}  // namespace palpate::app
