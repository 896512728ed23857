// The doubles of the makers' libraries as a test finds them: the file to open, and what is said to it.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "host/tests/device/doubles/double_control.h"
#include "host/tests/device/doubles/haply_double.h"
#include "support/places.h"

namespace palpate::doubles {

/// "openhaptics", "openhaptics_old", "openhaptics_needing", "forcedimension", "forcedimension_old", "plugin",
/// "plugin_at_once", "openxr"; of "haply" where its service is.
inline std::string libraryOf(const std::string& kind) {
  if (kind == "haply") return haplyWords();
  std::string name = kind.starts_with("openhaptics") ? "libHD.so" : "libdhd.so";
  if (kind.starts_with("plugin")) name = "libdouble.so";
  if (kind == "openxr") name = "libopenxr_loader.so";
  return support::buildFolder().string() + "/tests/doubles/" + kind + "/" + name;
}

/// The control of a double that this process has open, or opens hereby.
inline DoubleControl& controlOf(const std::string& kind) {
  if (kind == "haply") return haplyControl();
  void* handle = ::dlopen(libraryOf(kind).c_str(), RTLD_LAZY | RTLD_GLOBAL);
  if (handle == nullptr) {
    ADD_FAILURE() << ::dlerror();
    std::abort();
  }
  auto* control = reinterpret_cast<ControlFunction*>(::dlsym(handle, "palpateDouble"));
  return *control();
}

/// As it was when it was loaded, to be turned by hand.
inline void reset(DoubleControl& control) {
  for (DoubleDevice& device : control.devices) {
    for (std::size_t axis = 0; axis < 3; ++axis) device.place[axis] = device.speed[axis] = device.force[axis] = 0.0;
    device.pinned = device.connected = true;
    device.gives_no_number = false;
    device.error = device.buttons = 0;
    device.calibration = 0x5000;
    device.frames = 0;
  }
  control.count = 2;
  control.by_hand = true;
  control.stands = false;
  control.slow_us = 0;
  control.refusal = 0;
  control.major = 3;
  control.minor = 5;
  control.stray_calls = 0;
}

}  // namespace palpate::doubles
