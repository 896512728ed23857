// Mouse: the link that a window fills. Script: tips in memory. Playback: a file -> one tip a tick, in the
// body frame as it was written. Cold paths.
#include "palpate/base/path_text.h"
#include "palpate/device/detail/each_back_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/device/trajectory.h"
#include "palpate/trace/forces_table.h"

namespace palpate::device {

namespace {

Probe missing(std::string reason, std::string remedy) {
  Probe probe;
  probe.reason = std::move(reason);
  probe.remedy = std::move(remedy);
  return probe;
}

Probe here(std::string what) {
  Probe probe;
  probe.available = true;
  probe.devices.push_back(std::move(what));
  return probe;
}

/// "run/forces.csv:left" -> file and finger. A colon that belongs to the file's name stays in it.
std::pair<std::filesystem::path, std::string> fileAndFinger(const std::string& which) {
  const std::size_t colon = which.rfind(':');
  std::error_code error;
  if (colon == std::string::npos || std::filesystem::exists(pathOf(which), error)) return {pathOf(which), {}};
  return {which.substr(0, colon), which.substr(colon + 1)};
}

Trajectory toTrajectory(const trace::RecordedFinger& finger) { return {finger.time_s, finger.tip}; }

Trajectory recordedPath(const std::filesystem::path& file, const std::string& wanted) {
  const std::vector<trace::RecordedFinger> fingers = trace::readForcesTable(file);
  if (wanted.empty()) return toTrajectory(fingers.front());
  std::vector<std::string> names;
  for (const trace::RecordedFinger& finger : fingers) {
    if (finger.name == wanted) return toTrajectory(finger);
    names.push_back(finger.name);
  }
  throw Error::inFile(file.string(), unknownName("finger", wanted, "", names));
}

/// Decides by the header: a table of forces names its fingers.
Trajectory pathIn(const std::string& which) {
  const auto [file, finger] = fileAndFinger(which);
  if (!finger.empty()) return recordedPath(file, finger);
  try {
    return readTrajectory(file);
  } catch (const Error& no_trajectory) {
    try {
      return recordedPath(file, finger);
    } catch (const Error&) {
      throw no_trajectory;
    }
  }
}

}  // namespace

Probe probeMouse(const OpenOptions& options) {
  if (options.mouse != nullptr) return here("the pointer of the window");
  return missing("a mouse needs a window that shows the skin", "palpate run");
}

Device openMouse(const OpenOptions& options) {
  if (options.mouse == nullptr) throw Error(probeFailureText(backEndNamed("mouse"), probeMouse(options)));
  return mouseDevice("mouse", *options.mouse);
}

Probe probeScript(const OpenOptions& options) {
  if (options.tips == nullptr || !options.tips->empty()) return here("the fingers' paths of a scene");
  return missing("the path has no position", "give the finger steps or a trajectory (docs/reference/scene-files.md)");
}

Device openScript(const OpenOptions& options) { return scriptedDevice("script", options.tips); }

Probe probePlayback(const OpenOptions& options) {
  if (options.which.empty()) return here("any trajectory or recorded table of forces: playback:FILE");
  try {
    return here(fmt::format("{}, {} positions", options.which, pathIn(options.which).size()));
  } catch (const Error& error) {
    return missing(error.what(), "name a trajectory (t_s,x_mm,y_mm,z_mm) or a forces.csv, followed by :FINGER");
  }
}

Device openPlayback(const OpenOptions& options) {
  if (options.which.empty()) throw Error("playback: no file; name one as playback:FILE");
  return scriptedDevice(
      "playback", std::make_shared<const std::vector<Vec3>>(resampled(pathIn(options.which), options.tick_s).tip_mm));
}

}  // namespace palpate::device
