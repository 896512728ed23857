// `palpate devices`: every device that palpate knows, whether it is available, why not, and how good it is.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/devices/devices_report.h"
#include "cli/devices/identify_run.h"
#include "cli/kit/device_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "cli/own/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/device/mouse_finger.h"

namespace palpate::app {

namespace {

struct DevicesOptions {
  std::vector<std::string> names;  ///< empty: all
  double seconds = 1.0;
  bool doctor = false;
  bool identify = false;
  bool realtime = false;
  bool json = false;
};

std::vector<std::string> wantedNames(const DevicesOptions& options) {
  return options.names.empty() ? device::backEndNames() : options.names;
}

void measure(const std::string& words, const DevicesOptions& options, const Progress& progress,
             DeviceFinding& finding) {
  try {
    const device::Device device = device::openNamed(words, {});
    if (!device.capabilities.takes_force) {
      finding.why_nothing = "it does not render forces";
      return;
    }
    finding.capabilities = device.capabilities;
    finding.measured = measureDevice(device, options.seconds, progress);
  } catch (const Error& error) {
    finding.not_measured = error.what();
  }
}

DeviceFinding examineDevice(const std::string& words, const DevicesOptions& options, const Progress& progress) {
  device::MouseLink window;  // `palpate run` has one
  device::OpenOptions opening;
  opening.mouse = &window;
  const device::DeviceName name = device::deviceNamed(words);
  opening.which = name.which;
  DeviceFinding finding;
  finding.back_end = name.back_end;
  finding.probe = name.back_end->probe(opening);
  const bool hardware = !finding.probe.looked_for.empty() || name.back_end->name == "hand";
  if (!options.doctor) {
    finding.why_nothing = "not asked for: --doctor measures";
    return finding;
  }
  if (finding.probe.available && hardware) {
    measure(words, options, progress, finding);
  } else {
    finding.why_nothing = !finding.probe.available ? "it is not here" : "it is not hardware; its values are in memory";
  }
  return finding;
}

void runIdentify(const DevicesOptions& options) {
  if (options.names.size() > 1) throw Error("--identify: one device at a time");
  ProgressLine progress;
  IdentifySettings settings;
  if (!options.names.empty()) settings.device = options.names.front();
  settings.json = options.json;
  settings.realtime = options.realtime;
  const Identified found = identifyDevice(settings, progress.display());
  progress.clear();
  fmt::print("{}", options.json ? jsonDump(toJson(found), 2) + "\n" : textOf(found));
}

void runDevices(const DevicesOptions& options) {
  const FinishesInOrder in_order;
  ProgressLine progress;
  Json json = Json::array();
  std::string text;
  bool all_here = true;
  for (const std::string& words : wantedNames(options)) {
    throwIfInterrupted();
    const DeviceFinding finding = examineDevice(words, options, progress.display());
    all_here = all_here && finding.probe.available && finding.not_measured.empty();
    json.push_back(toJson(finding));
    text += textOf(finding, options.doctor);
  }
  progress.clear();
  fmt::print("{}", options.json ? jsonDump(json, 2) + "\n" : text);
  if (!options.names.empty() && !all_here) throw ExitWith(1);
}

}  // namespace

void addDevicesCommand(Command& app) {
  Command* command = app.add_subcommand("devices", "List haptic devices and say why unavailable ones cannot be opened");
  command->group("Touch");
  const auto options = std::make_shared<DevicesOptions>();
  addDeviceOption(*command, options->names, "Check only this device; exit code 1 when it is unavailable");
  command->add_flag(
      "--doctor", options->doctor,
      "List everything that was searched for; open available devices without force and measure rate, delay and jitter");
  command->add_flag("--identify", options->identify,
                    "Swing one released device with a soft spring and print its mass, damping, friction and delay");
  command->add_flag("--realtime", options->realtime,
                    "With --identify: run a simulated device in real time, like a real one");
  addSetting(*command, "--seconds", options->seconds, between(0.1, 60.0, "s"),
             "Time for which --doctor measures a device");
  command->add_flag("--json", options->json, "Print a list of objects instead of the text");
  command->callback([=] { options->identify ? runIdentify(*options) : runDevices(*options); });
}

}  // namespace palpate::app
