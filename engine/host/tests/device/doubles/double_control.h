// What a test tells a double of a vendor's library, and sees of it: two point masses on motors, and their faults.
//
// A double is a shared library with the vendor's function names. It runs by the clock like the real one, or, once
// `by_hand` is set, only when `tick` is called: then a test counts ticks instead of waiting. Everything is in the
// vendor's own units and axes.
#pragma once

#include <array>
#include <atomic>

namespace palpate::doubles {

struct DoubleDevice {
  std::array<std::atomic<double>, 3> place{};  ///< where the mass is
  std::array<std::atomic<double>, 3> speed{};  ///< a second
  std::array<std::atomic<double>, 3> force{};  ///< that the motors have now, N
  std::atomic<bool> pinned{true};              ///< it stays where the test puts it
  std::atomic<bool> connected{true};
  std::atomic<bool> gives_no_number{false};
  std::atomic<unsigned> error{0};  ///< the vendor's code, reported in every exchange
  std::atomic<unsigned> buttons{0};
  std::atomic<unsigned> calibration{0x5000};
  std::atomic<long> frames{0};
  std::atomic<bool> open{false};
  std::atomic<bool> forces_on{false};
};

struct DoubleControl {
  std::array<DoubleDevice, 2> devices;
  std::atomic<int> count{1};         ///< devices that are plugged in
  std::atomic<bool> by_hand{false};  ///< set before a device is opened
  std::atomic<bool> stands{false};   ///< the driver's loop does not turn: everything it gives is old
  std::atomic<int> slow_us{0};       ///< each exchange takes so much longer
  std::atomic<unsigned> refusal{0};  ///< opening fails with this code of the vendor
  std::atomic<int> major{3};         ///< version of the library or service
  std::atomic<int> minor{5};         ///< likewise, where a test may choose it
  std::atomic<int> stray_calls{0};   ///< for a device that the program does not have open
  void (*tick)() = nullptr;          ///< by hand: one turn of the driver's loop, where it has one
};

/// Every double exports this under the name "palpateDouble".
using ControlFunction = DoubleControl*();

/// A pen's mass, kg, and its bearings' damping, N s/m: what moves an unpinned device.
inline constexpr double kMassKg = 0.045;
inline constexpr double kDampingNsPerM = 0.2;

/// One millisecond or less of the mass under its motors' force; `unit_m` is the vendor's unit of length.
inline void move(DoubleDevice& device, double seconds, double unit_m) {
  if (device.pinned) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double push = device.force[axis] - kDampingNsPerM * device.speed[axis] * unit_m;
    device.speed[axis] = device.speed[axis] + push / kMassKg * seconds / unit_m;
    device.place[axis] = device.place[axis] + device.speed[axis] * seconds;
  }
}

/// Settings for a program that cannot call palpateDouble: PALPATE_DOUBLE="count=2,refusal=1536,major=2".
void readSettings(DoubleControl& control);

}  // namespace palpate::doubles
