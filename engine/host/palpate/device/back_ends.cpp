// The table of back ends. Cold path.
#include "palpate/device/back_ends.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/detail/each_back_end.h"
#include "palpate/device/detail/remote_device.h"
#include "palpate/device/hand_device.h"

namespace palpate::device {

namespace {

constexpr std::array kBackEnds = {
    BackEnd{"mouse", "the pointer over the skin in the window", probeMouse, openMouse, 2.0, true},
    BackEnd{"script", "the paths of a scene's fingers", probeScript, openScript, 2.0, true},
    BackEnd{"playback", "a trajectory or a recorded run: playback:FILE", probePlayback, openPlayback},
    BackEnd{"hand", "a simulated hand on a simulated device: hand:stylus_z,touch_x", probeHand, openHand, 2.0, true},
    BackEnd{"openhaptics", "Touch, Omni, Desktop, Premium: the maker's libHD", probeOpenHaptics, openOpenHaptics},
    BackEnd{"forcedimension", "omega, delta, sigma, Falcon: the maker's libdhd", probeForceDimension,
            openForceDimension},
    BackEnd{"haply", "Inverse3, Minverse: the maker's Inverse Service", probeHaply, openHaply},
    BackEnd{"plugin", "a plugin for any other device: plugin:FILE[:WHICH]", probePlugin, openPlugin},
    BackEnd{"remote", "another program on this machine, by datagrams", probeRemote, openRemote, 60.0},
};

}  // namespace

DeviceFrame frameOf(const OpenOptions& options, std::string_view usual_axes, double unit_mm) {
  return {axesNamed(options.axes.empty() ? usual_axes : options.axes), unit_mm * options.scale, options.origin_mm};
}

std::span<const BackEnd> backEnds() { return kBackEnds; }

std::vector<std::string> backEndNames() {
  std::vector<std::string> names;
  for (const BackEnd& back_end : kBackEnds) names.emplace_back(back_end.name);
  return names;
}

const BackEnd& backEndNamed(std::string_view name) {
  for (const BackEnd& back_end : kBackEnds) {
    if (back_end.name == name) return back_end;
  }
  throw Error(unknownName("device", name, "", backEndNames()));
}

DeviceName deviceNamed(std::string_view words) {
  const std::size_t colon = words.find(':');
  if (colon == std::string_view::npos) return {&backEndNamed(words), {}};
  return {&backEndNamed(words.substr(0, colon)), std::string(words.substr(colon + 1))};
}

DeviceName deviceNamedInFile(std::string_view words) {
  DeviceName name = deviceNamed(words);
  if (name.back_end->name == "plugin" && !isPluginOfFolders(name.which)) {
    throw Error(
        fmt::format("'{}' was not opened: files may name only plugins in a folder of PALPATE_DEVICE_PLUGINS; open it "
                    "with --device if you trust it",
                    oneLine(words)));
  }
  return name;
}

Device openNamed(std::string_view words, OpenOptions options) {
  const DeviceName name = deviceNamed(words);
  options.which = name.which;
  Device device = name.back_end->open(options);
  const auto since = Clock::now();
  while (!device.read_tip(0).allFinite()) {
    if (device.exchange) device.exchange();
    if (options.give_up != nullptr && options.give_up->load()) throw Error(device.name + ": cancelled");
    if (secondsSince(since) > name.back_end->pose_wait_s) {
      const std::string why = device.explain ? device.explain() : std::string();
      throw Error(fmt::format("{}: no position received within {} s{}{}", device.name, name.back_end->pose_wait_s,
                              why.empty() ? "" : ": ", why));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return device;
}

std::string probeFailureText(const BackEnd& back_end, const Probe& probe) {
  const std::string remedy = probe.remedy.empty() ? "" : fmt::format("; {}", probe.remedy);
  return fmt::format("{}: {}{}", back_end.name, probe.reason, remedy);
}

std::string describe(const Device& device) {
  const Capabilities& able = device.capabilities;
  std::string text = device.name;
  if (!able.model.empty()) text += ", " + able.model;
  if (able.max_force_n > 0.0) text += fmt::format(", at most {:.2f} N", able.max_force_n);
  return text;
}

std::vector<std::string> reviveDevices(std::span<const Device> devices) {
  std::vector<std::string> troubles;
  for (const Device& device : devices) {
    const std::string trouble = device.explain ? device.explain() : std::string();
    if (trouble.empty()) continue;
    if (device.revive && device.revive()) continue;
    troubles.push_back(device.name + ": " + trouble);
  }
  return troubles;
}

}  // namespace palpate::device
