// A double of OpenHaptics' libHD: the functions that a back end may call, over two simulated pens on one scheduler of
// 1000 Hz. With PALPATE_DOUBLE_LACKS_FUNCTIONS it lacks some, like a library that is too old; with
// PALPATE_DOUBLE_NEEDS it needs another library, which nobody installs.
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "host/tests/device/doubles/double_control.h"

using palpate::doubles::DoubleControl;
using palpate::doubles::DoubleDevice;

namespace {

using Callback = std::uint32_t (*)(void*);

struct ErrorInfo {
  std::uint32_t code;
  int internal_code;
  std::uint32_t device;
};

constexpr std::uint32_t kInvalid = 0xFFFFFFFFu;
constexpr double kTickS = 0.001;
constexpr double kMetre = 0.001;  // its unit is the millimetre

struct Scheduled {
  Callback callback = nullptr;
  void* data = nullptr;
};

/// The library's own state; errors wait in a row of fixed length, as a tick must not allocate.
struct Library {
  DoubleControl control;
  std::array<ErrorInfo, 32> errors{};
  std::size_t first_error = 0;
  std::size_t last_error = 0;
  std::vector<Scheduled> scheduled;
  std::thread scheduler;
  std::atomic<bool> running{false};
  std::uint32_t current = 0;
};

void turn(Library& library);

Library& library() {
  static Library* const only = [] {
    auto* made = new Library;  // outlives every thread
    palpate::doubles::readSettings(made->control);
    made->control.tick = [] {
      if (library().running && !library().control.stands) turn(library());
    };
    return made;
  }();
  return *only;
}

void report(std::uint32_t code, std::uint32_t device) {
  Library& self = library();
  if (self.last_error - self.first_error == self.errors.size()) return;
  self.errors[self.last_error++ % self.errors.size()] = {code, 0, device};
}

void turn(Library& self) {
  if (self.control.slow_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(self.control.slow_us));
  for (const Scheduled& task : self.scheduled) {
    if (task.callback != nullptr) task.callback(task.data);
  }
}

DoubleDevice& device(std::uint32_t handle) { return library().control.devices[handle < 2 ? handle : 0]; }
DoubleDevice& current() { return device(library().current); }

void countIfStray(std::uint32_t handle) {
  if (handle >= 2 || !device(handle).open) ++library().control.stray_calls;
}

void copyOut(const std::array<std::atomic<double>, 3>& from, double* to) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

}  // namespace

extern "C" {

#ifdef PALPATE_DOUBLE_NEEDS
void palpateMissingLibrary();
void palpateUsesTheMissingLibrary() { palpateMissingLibrary(); }
#endif

DoubleControl* palpateDouble() { return &library().control; }

std::uint32_t hdInitDevice(const char* name) {
  const bool second = name != nullptr && std::strcmp(name, "Phantom2") == 0;
  const bool first =
      name == nullptr || std::strcmp(name, "Default Device") == 0 || std::strcmp(name, "Default PHANToM") == 0;
  const std::uint32_t handle = second ? 1 : 0;
  const std::uint32_t refusal = library().control.refusal;
  std::uint32_t error = 0;
  if (refusal != 0) {
    error = refusal;
  } else if ((!first && !second) || static_cast<int>(handle) >= library().control.count || !device(handle).connected) {
    error = 0x300;
  } else if (device(handle).open) {
    error = 0x301;
  }
  if (error != 0) {
    report(error, kInvalid);
    return kInvalid;
  }
  device(handle).open = true;
  device(handle).forces_on = false;
  library().current = handle;
  return handle;
}

void hdDisableDevice(std::uint32_t handle) {
  countIfStray(handle);
  device(handle).open = false;
}
void hdMakeCurrentDevice(std::uint32_t handle) {
  countIfStray(handle);
  library().current = handle;
}
std::uint32_t hdGetCurrentDevice() { return library().current; }

void hdBeginFrame(std::uint32_t handle) {
  countIfStray(handle);
  library().current = handle;
  DoubleDevice& self = device(handle);
  if (!self.connected) report(0x302, handle);
  if (self.error != 0) report(self.error, handle);
}

void hdEndFrame(std::uint32_t handle) {
  palpate::doubles::move(device(handle), kTickS, kMetre);
  device(handle).frames = device(handle).frames + 1;
}

ErrorInfo hdGetError() {
  Library& self = library();
  if (self.first_error == self.last_error) return {0, 0, kInvalid};
  return self.errors[self.first_error++ % self.errors.size()];
}

const char* hdGetErrorString(std::uint32_t code) { return code == 0x600 ? "HD_INVALID_LICENSE" : ""; }

void hdEnable(std::uint32_t capability) {
  if (capability == 0x4000) current().forces_on = true;
}

void hdGetIntegerv(std::uint32_t parameter, int* value) {
  if (parameter == 0x2000) *value = static_cast<int>(current().buttons.load());
  if (parameter == 0x2600) *value = 1000;
  if (parameter == 0x2555) *value = 4;
}

void hdGetDoublev(std::uint32_t parameter, double* value) {
  constexpr double kReach[6] = {-210, -110, -85, 210, 200, 130};
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  switch (parameter) {
    case 0x2050:
      copyOut(current().place, value);
      if (current().gives_no_number) value[1] = nothing;
      break;
    case 0x2051:
      copyOut(current().speed, value);
      break;
    case 0x2551:
      std::copy(kReach, kReach + 6, value);
      break;
    case 0x2602:
      *value = 0.5;
      break;
    case 0x2603:
      *value = 3.3;
      break;
    case 0x2604:
      *value = 0.88;
      break;
    default:
      report(0x100, library().current);
  }
}

const char* hdGetString(std::uint32_t parameter) { return parameter == 0x2501 ? "PHANTOM Omni" : "3.40"; }

#ifndef PALPATE_DOUBLE_LACKS_FUNCTIONS
void hdSetDoublev(std::uint32_t parameter, const double* value) {
  if (parameter != 0x2700) return;
  for (std::size_t axis = 0; axis < 3; ++axis) current().force[axis] = current().forces_on ? value[axis] : 0.0;
}
void hdUnschedule(unsigned long handle) { library().scheduled[handle].callback = nullptr; }
#endif

std::uint32_t hdCheckCalibration() { return current().calibration; }
void hdUpdateCalibration(std::uint32_t) {
  if (current().calibration == 0x5001) current().calibration = 0x5000;
}

unsigned long hdScheduleAsynchronous(Callback callback, void* data, std::uint16_t) {
  library().scheduled.push_back({callback, data});
  return library().scheduled.size() - 1;
}

void hdStartScheduler() {
  Library& self = library();
  self.running = true;
  if (self.control.by_hand) return;
  self.scheduler = std::thread([&self] {
    for (auto due = std::chrono::steady_clock::now(); self.running;) {
      if (!self.control.stands) turn(self);
      due += std::chrono::milliseconds(1);
      std::this_thread::sleep_until(due);
    }
  });
}

void hdStopScheduler() {
  library().running = false;
  if (library().scheduler.joinable()) library().scheduler.join();
}

}  // extern "C"
