// Every way to come by a device, by name: what each looks for, why it is not there and what mends that, and opening it.
//
//   backEnds() ─ probe ─► Probe (palpate devices)        open ─► Device (device.h) ─► servo
//
// A back end is a row of a table: a name, a line about it and two functions.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/device/device.h"

namespace palpate::device {

struct MouseLink;

/// Device to open and options; a back end uses what concerns it.
struct OpenOptions {
  /// One of several: a name as the driver knows it (OpenHaptics), an index from 0 (Force Dimension), the file of a
  /// recording (playback) or of a plugin. Empty: the first.
  std::string which;
  /// The file of the vendor's library, instead of the names that are tried, or where its service is (haply). Empty:
  /// the back end's environment variable, or those names.
  std::string library;
  std::string axes;               ///< device_frame.h's words; empty: as the back end knows its devices
  Vec3 origin_mm = Vec3::Zero();  ///< where the device's own origin lies in the body frame
  double scale = 1.0;             ///< mm of the body per mm of the device's motion
  double tick_s = 0.001;          ///< servo's tick
  /// False: a blocking driver gets no thread, Device::exchange is called instead, once a driver's tick.
  bool own_thread = true;
  const std::atomic<bool>* give_up = nullptr;     ///< true: stop waiting for the first position
  std::shared_ptr<const std::vector<Vec3>> tips;  ///< tips of `script`
  MouseLink* mouse = nullptr;                     ///< link of `mouse`; must outlive the device
  std::filesystem::path system_root = "/";        ///< where /sys and /dev are looked for
};

/// One thing that was looked for.
struct LookedFor {
  std::string what;
  std::string where;
  bool found = false;
  std::string words;  ///< the loader's, the driver's or the system's own; may be empty
};

struct Probe {
  bool available = false;  ///< it would open now
  std::string reason;      ///< why not; empty when available
  std::string remedy;      ///< how to fix that; empty when available
  std::string version;     ///< driver's version, where one was found
  std::vector<LookedFor> looked_for;
  std::vector<std::string> devices;  ///< those that would open, in their makers' words
  /// Problems of other devices that would not open, while one would.
  std::vector<std::string> troubles = {};
};

struct BackEnd {
  std::string_view name;
  std::string_view about;
  /// Looks without keeping anything open. Never throws for missing parts.
  Probe (*probe)(const OpenOptions& options);
  /// Throws Error with the reason.
  Device (*open)(const OpenOptions& options);
  double pose_wait_s = 2.0;  ///< longest wait for its first position
  /// It is of this program alone: neither a driver, nor another program, nor a file.
  bool is_inside = false;
};

std::span<const BackEnd> backEnds();

std::vector<std::string> backEndNames();

/// Throws Error for a name that no back end has, with the nearest.
const BackEnd& backEndNamed(std::string_view name);

/// "openhaptics" or "openhaptics:Left Device": a back end, and which of its devices.
struct DeviceName {
  const BackEnd* back_end = nullptr;
  std::string which;
};

/// Throws Error like backEndNamed.
DeviceName deviceNamed(std::string_view words);

/// Names that a file (a scene, a recording) may use: every device, but a plugin only as it lies in one of the folders
/// of PALPATE_DEVICE_PLUGINS, since no file may choose which code runs. Throws Error with the reason, and like
/// backEndNamed.
DeviceName deviceNamedInFile(std::string_view words);

/// Opens the device of these words (deviceNamed) and waits until it has a position: a servo that starts without one
/// starts in the middle of a body. Throws Error with the reason, also when no position comes in time.
Device openNamed(std::string_view words, OpenOptions options);

/// The probe's reason and remedy as one line.
std::string probeFailureText(const BackEnd& back_end, const Probe& probe);

/// "openhaptics, PHANTOM Omni, at most 3.30 N"
std::string describe(const Device& device);

/// Devices that were lost and can be found again are; returns the faults of the others, in words. For a thread that may
/// wait, about once a second.
std::vector<std::string> reviveDevices(std::span<const Device> devices);

}  // namespace palpate::device
