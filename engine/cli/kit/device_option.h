// --device: devices that move the fingers instead of the scene's paths or the mouse.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/kit/options.h"
#include "palpate/device/back_ends.h"
#include "palpate/scene/scene.h"

namespace palpate::app {

/// Adds --device NAME[:WHICH], once for each finger; an unknown name is a usage error. `names` must outlive
/// the command.
Option* addDeviceOption(Command& command, std::vector<std::string>& names, const std::string& help);

/// Adds --unsafe-stiffness (scene::SafetySettings::unsafe_stiffness), for commands in which users decide about their
/// own hands: no training, no server.
void addUnsafeStiffness(Command& command, bool& unsafe);

/// Prints the safety warnings of a run before a hand is on the device, on stderr, one per line.
void printUnsafeNotes(std::span<const std::string> notes);

/// Opens them in order, device i by `fingers[i]`. Throws Error with the reason for one that does not open, and for more
/// devices than fingers.
std::vector<device::Device> openDevices(std::span<const std::string> names,
                                        std::span<const device::OpenOptions> fingers);

/// Places a device as the scene says, else where the finger's path begins; one that gives places of the body stays
/// unchanged, and so does a simulated hand, which is drawn along that path.
device::Device placedDevice(const device::Device& device, const std::string& words, std::size_t finger,
                            const Vec3& path_begins, const scene::Scene& scene);

}  // namespace palpate::app
