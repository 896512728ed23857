// Functions behind the rows of back_ends.cpp: how each back end is looked for, and how it is opened.
// docs/reference/devices.md.
#pragma once

#include <string_view>

#include "palpate/device/back_ends.h"
#include "palpate/device/device_frame.h"

namespace palpate::device {

/// Where the options put a device whose unit is `unit_mm` long; `usual_axes` where they name none, of themselves right,
/// up and towards the user: the body frame of a user behind a patient. Throws Error for invalid axes.
DeviceFrame frameOf(const OpenOptions& options, std::string_view usual_axes = "x,y,z", double unit_mm = 1.0);

// Back ends that need nothing but this program (plain_back_ends.cpp).

Probe probeMouse(const OpenOptions& options);
Device openMouse(const OpenOptions& options);

Probe probeScript(const OpenOptions& options);
Device openScript(const OpenOptions& options);

/// A trajectory (t_s,x_mm,y_mm,z_mm), or a recorded table of forces with the name of a finger after a colon.
Probe probePlayback(const OpenOptions& options);
Device openPlayback(const OpenOptions& options);

// Touch, Omni, Desktop and Premium through libHD, opened at run time (openhaptics.cpp).

/// Looks for the library, what it needs, its functions, the device on the bus and the right to open it, and opens it
/// for a moment.
Probe probeOpenHaptics(const OpenOptions& options);
/// Any number of devices; all of them share the library's scheduler, each has its own position and force.
Device openOpenHaptics(const OpenOptions& options);

// Omega, delta, sigma and Falcon through libdhd or libdrd, opened at run time (forcedimension.cpp).

/// Looks for the library, its functions and version, the device on the bus and the right to open it, and opens it for a
/// moment.
Probe probeForceDimension(const OpenOptions& options);
/// With a thread of its own for the exchanges, or without one (OpenOptions::own_thread).
Device openForceDimension(const OpenOptions& options);

// Inverse3 and Minverse through Haply's Inverse Service, by WebSocket (haply.cpp).

/// Looks for the service, its version and its devices; sends nothing that could move one.
Probe probeHaply(const OpenOptions& options);
/// Any number of devices; those of one service share a connection, each has its own position and force.
Device openHaply(const OpenOptions& options);

// Whatever has a plugin (palpate_device.h, plugin.cpp).

/// `which` is its file or its name, with :WHICH for one of several. One plugin, or without a name all of those in the
/// folders of PALPATE_DEVICE_PLUGINS.
Probe probePlugin(const OpenOptions& options);
/// Called by the servo itself if it answers at once, else on its own thread like other hardware.
Device openPlugin(const OpenOptions& options);
/// `which` is the name of a plugin that lies in one of these folders, not a path (plugin_library.cpp).
bool isPluginOfFolders(const std::string& which);

}  // namespace palpate::device
