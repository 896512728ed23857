#include "cli/kit/device_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/device/workspace.h"
#include "palpate/servo/device_limits.h"

namespace palpate::app {

Option* addDeviceOption(Command& command, std::vector<std::string>& names, const std::string& help) {
  const auto known = [](const std::string& words) {
    try {
      device::deviceNamed(words);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  return command
      .add_option("--device", names,
                  fmt::format("{}: {}, followed by :WHICH for one of several (docs/reference/devices.md)", help,
                              fmt::join(device::backEndNames(), ", ")))
      ->type_name("NAME[:WHICH]")
      ->check(known)
      ->allow_extra_args(false);  // one at a time: the scene follows
}

void addUnsafeStiffness(Command& command, bool& unsafe) {
  command.add_flag("--unsafe-stiffness", unsafe,
                   "Render the stiffness and force requested by the scene's [safety], beyond what is safe for the "
                   "device (docs/explanation/safety.md)");
}

void printUnsafeNotes(std::span<const std::string> notes) {
  for (const std::string& note : notes) {
    if (note.starts_with(servo::kUnsafeMark)) say("palpate: " + note + "\n");
  }
}

std::vector<device::Device> openDevices(std::span<const std::string> names,
                                        std::span<const device::OpenOptions> fingers) {
  if (names.size() > fingers.size()) {
    throw Error(fmt::format("--device: {} devices for {} finger{}", names.size(), fingers.size(),
                            fingers.size() == 1 ? "" : "s"));
  }
  std::vector<device::Device> devices;
  for (std::size_t i = 0; i < names.size(); ++i) devices.push_back(device::openNamed(names[i], fingers[i]));
  return devices;
}

device::Device placedDevice(const device::Device& device, const std::string& words, std::size_t finger,
                            const Vec3& path_begins, const scene::Scene& scene) {
  const auto settings = device::settingsOf(scene, words, finger).value_or(scene::DeviceSettings{});
  const bool stays = device::givesPlacesOfTheBody(words) || device::deviceNamed(words).back_end->name == "hand";
  const Vec3 origin = stays ? Vec3(Vec3::Zero()) : path_begins;
  const device::Workspace workspace = device::workspaceOf(settings, origin);
  return device::inWorkspace(device, workspace, std::make_shared<device::WorkspaceLink>(workspace));
}

}  // namespace palpate::app
