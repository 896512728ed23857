// A double of a maker who writes a plugin (palpate_device.h): two simulated devices and their faults. With
// PALPATE_DOUBLE_AT_ONCE it answers the servo itself, and drops a force that is not renewed; else it is asked by a
// thread. A refusal of DoubleControl is a table that will not do.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <limits>
#include <thread>

#include "host/tests/device/doubles/double_control.h"
#include "palpate/device/palpate_device.h"

using palpate::doubles::DoubleControl;
using palpate::doubles::DoubleDevice;

namespace {

#ifdef PALPATE_DOUBLE_AT_ONCE
constexpr bool kAtOnce = true;
#else
constexpr bool kAtOnce = false;
#endif
constexpr double kCallS = kAtOnce ? 0.001 : 0.0005;
constexpr double kUnitM = 0.001;

struct Own {
  DoubleControl control;
  std::array<int, 2> silent_ticks{};
};

Own& own() {
  static Own* const only = [] {
    auto* made = new Own;
    palpate::doubles::readSettings(made->control);
    made->control.tick = [] {
      for (std::size_t i = 0; i < 2; ++i) {
        if (++own().silent_ticks[i] <= 2) continue;
        for (auto& force : own().control.devices[i].force) force = 0.0;
      }
    };
    return made;
  }();
  return *only;
}

void say(const char* words, char* room, std::uint32_t bytes) { std::strncpy(room, words, bytes); }

std::size_t indexOf(palpate_device_handle device) {
  return static_cast<std::size_t>(static_cast<DoubleDevice*>(device) - own().control.devices.data());
}

bool answers(const DoubleDevice& device) {
  if (own().control.slow_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(own().control.slow_us));
  return device.connected && device.error == 0;
}

int probe(const char*, char* reason, std::uint32_t reason_room, char* remedy, std::uint32_t remedy_room) {
  if (own().control.refusal == 0 && own().control.count > 0) return PALPATE_DEVICE_OK;
  say("nothing is plugged in", reason, reason_room);
  say("plug it in", remedy, remedy_room);
  return PALPATE_DEVICE_ERROR;
}

palpate_device_handle open(const char* which, char* reason, std::uint32_t room) {
  say("all devices are in use or gone", reason, room);
  for (std::size_t i = 0; i < static_cast<std::size_t>(own().control.count); ++i) {
    DoubleDevice& device = own().control.devices[i];
    const bool meant = *which == '\0' || std::strcmp(which, i == 0 ? "first" : "second") == 0;
    if (!meant || !device.connected || device.open || own().control.refusal != 0) continue;
    device.open = true;
    return &device;
  }
  return nullptr;
}

void close(palpate_device_handle handle) {
  auto& device = *static_cast<DoubleDevice*>(handle);
  for (auto& force : device.force) force = 0.0;
  device.open = false;
}

int capabilities(palpate_device_handle, palpate_device_capabilities* able) {
  if (able->size < sizeof(*able)) return PALPATE_DEVICE_ERROR;
  able->flags = kAtOnce ? PALPATE_DEVICE_ANSWERS_AT_ONCE : 0;
  able->max_force_n = 4.0;
  able->rate_hz = 1000.0;
  for (int axis = 0; axis < 3; ++axis) {
    able->reach_min_mm[axis] = -100.0;
    able->reach_max_mm[axis] = 100.0;
  }
  say("double of a plugin", able->model, sizeof(able->model));
  say("1.0", able->version, sizeof(able->version));
  return PALPATE_DEVICE_OK;
}

int read(palpate_device_handle handle, palpate_device_reading* reading) {
  auto& device = *static_cast<DoubleDevice*>(handle);
  if (!answers(device)) return PALPATE_DEVICE_ERROR;
  device.frames = device.frames + 1;
  if (own().control.stands) return PALPATE_DEVICE_NOT_YET;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reading->tip_mm[axis] = device.place[axis];
    reading->velocity_mm_s[axis] = device.speed[axis];
  }
  if (device.gives_no_number) reading->tip_mm[2] = std::numeric_limits<double>::quiet_NaN();
  reading->buttons = device.buttons;
  return PALPATE_DEVICE_OK;
}

int write(palpate_device_handle handle, const double force_n[3]) {
  auto& device = *static_cast<DoubleDevice*>(handle);
  if (!answers(device)) return PALPATE_DEVICE_ERROR;
  for (std::size_t axis = 0; axis < 3; ++axis) device.force[axis] = force_n[axis];
  own().silent_ticks[indexOf(handle)] = 0;
  palpate::doubles::move(device, kCallS, kUnitM);
  return PALPATE_DEVICE_OK;
}

/// Fills its room to the last byte, without the NUL that it should have.
void explain(palpate_device_handle, char* text, std::uint32_t room) {
  const char words[] = "the double was told to fail ";
  for (std::uint32_t i = 0; i < room; ++i) text[i] = words[i % (sizeof(words) - 1)];
}

}  // namespace

extern "C" {

DoubleControl* palpateDouble() { return &own().control; }

const palpate_device_table* palpate_device_plugin(std::uint32_t) {
  static palpate_device_table table;
  table = {sizeof(table), PALPATE_DEVICE_VERSION, "double", "a double", probe,  open,
           close,         capabilities,           read,     write,      explain};
  if (own().control.refusal == 2) return nullptr;
  if (own().control.refusal == 3) table.version = 99;
  if (own().control.refusal == 4) table.size = 16;
  if (own().control.refusal == 5) table.read = nullptr;
  return &table;
}

}  // extern "C"
