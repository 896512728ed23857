// The bench that every back end is put on: opened, its hardware's double moved, its forces read, its faults made, one
// tick after the other and by hand.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/tests/device/doubles/double_library.h"
#include "palpate/device/back_ends.h"
#include "palpate/device/mouse_finger.h"
#include "support/temporary_folder.h"

namespace palpate::device {

/// What a maker's library or service is like: its unit, its axes, what its doubles are called.
struct Hardware {
  std::string back_end;
  std::string kind;              ///< of double
  double mm = 1.0;               ///< a unit of it
  Mat3 axes = Mat3::Identity();  ///< body = axes * its own
  bool exchanges = false;        ///< has no loop of its own
  double most_force_n = 0.0;
  unsigned error = 1;  ///< one that is a fault
  /// Its own axes when it has been turned about the vertical: what pointed towards the user points right.
  std::string turned_axes = "z,y,-x";
  bool asks_the_system = false;  ///< an exchange takes memory, locks or sockets: no servo may make one
  int random_ticks = 60000;      ///< as long as a test of random faults may take
};

inline Hardware openHapticsHardware() {
  return {.back_end = "openhaptics", .kind = "openhaptics", .most_force_n = 3.3, .error = 0x304};
}
inline Hardware forceDimensionHardware() {
  Hardware hardware{.back_end = "forcedimension", .kind = "forcedimension", .mm = 1000.0, .exchanges = true};
  hardware.most_force_n = 12.0;
  hardware.axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // right is its y, up its z, towards the user its x
  hardware.turned_axes = "x,z,-y";
  return hardware;
}
inline Hardware haplyHardware() {
  Hardware hardware{.back_end = "haply", .kind = "haply", .mm = 1000.0, .exchanges = true};
  hardware.most_force_n = 5.0;
  hardware.axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // right is its x, up its z, away from the user its y
  hardware.turned_axes = "-y,z,-x";
  hardware.asks_the_system = true;
  hardware.random_ticks = 10000;
  return hardware;
}
inline Hardware pluginHardware() {
  Hardware hardware{.back_end = "plugin", .kind = "plugin", .exchanges = true, .most_force_n = 4.0};
  hardware.asks_the_system = true;
  return hardware;
}
/// A plugin that the servo asks itself.
inline Hardware pluginAtOnceHardware() { return {.back_end = "plugin", .kind = "plugin_at_once", .most_force_n = 4.0}; }
inline Hardware hardwareNamed(const std::string& kind) {
  for (const Hardware& hardware :
       {openHapticsHardware(), forceDimensionHardware(), haplyHardware(), pluginHardware()}) {
    if (hardware.kind == kind) return hardware;
  }
  return pluginAtOnceHardware();
}

/// Two devices of a kind of hardware, turned by hand.
class HardwareBench {
 public:
  explicit HardwareBench(const Hardware& hardware) : hardware_(hardware), control_(doubles::controlOf(hardware.kind)) {
    doubles::reset(control_);
  }

  OpenOptions options() const {
    OpenOptions options;
    options.library = doubles::libraryOf(hardware_.kind);
    options.own_thread = false;
    options.system_root = "/nonexistent";
    return options;
  }
  Device open(const OpenOptions& options) const { return backEndNamed(hardware_.back_end).open(options); }
  Device open() const { return open(options()); }

  doubles::DoubleControl& control() { return control_; }
  doubles::DoubleDevice& hardware(std::size_t i = 0) { return control_.devices[i]; }

  /// Puts the double's device to a place of the body.
  void put(const Vec3& tip_mm, std::size_t i = 0) {
    const Vec3 place = hardware_.axes.transpose() * tip_mm / hardware_.mm;
    for (std::size_t axis = 0; axis < 3; ++axis) control_.devices[i].place[axis] = place[static_cast<long>(axis)];
  }
  /// That the double's motors have now, N in the body frame.
  Vec3 force(std::size_t i = 0) const {
    const auto& force = control_.devices[i].force;
    return hardware_.axes * Vec3(force[0], force[1], force[2]);
  }

  /// What the driver does between two ticks of the servo.
  void turn(std::span<Device* const> devices) {
    if (!hardware_.exchanges) return control_.tick();
    if (hardware_.kind == "haply" && control_.stands) return;  // an answer that does not come
    for (Device* device : devices) {
      for (int i = 0; i < 2; ++i) device->exchange();  // 2000 a second
    }
  }
  void turn(Device& device) {
    Device* const one = &device;
    turn(std::span(&one, 1));
  }

  /// One tick of a servo that answers with this force.
  Vec3 tick(Device& device, const Vec3& answer) {
    const Vec3 tip = device.read_tip(ticks_++);
    device.write_force(answer);
    turn(device);
    return tip;
  }

 private:
  Hardware hardware_;
  doubles::DoubleControl& control_;
  std::uint64_t ticks_ = 0;
};

}  // namespace palpate::device
