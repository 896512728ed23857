// One servo tick: every finger reads its device, touches the surface, and sends a safe force back.
//
// The paced loop and the headless one both call this, so what a script feels is what a hand feels.
#pragma once

#include <span>
#include <vector>

#include "palpate/device/device.h"
#include "palpate/servo/emergency_stop.h"
#include "palpate/servo/finger_solver.h"
#include "palpate/servo/limiter.h"
#include "palpate/trace/sample.h"

namespace palpate::servo {

/// One finger: what it touches, its settings, its device and what it remembers from tick to tick.
struct FingerChain {
  FingerSolver solver;
  contact::FingerSettings contact_settings;
  LimiterSettings limiter_settings;
  device::Device device;
  contact::FingerState contact;
  LimiterState limiter;
  std::uint32_t forgot = 0;  ///< trace::ForgetBits since the last tick, which reports and clears them
};

/// The finger was put elsewhere: it forgets what it touched.
void forgetTouch(FingerChain& finger) noexcept;

/// Puts a device in the finger's hand. One that takes no forces closes no loop.
void giveDevice(FingerChain& finger, device::Device device);

/// The same in a running loop, in exchange for the device before, which gets zero force; touch and limiter start again.
/// Allocates and frees nothing.
void exchangeDevice(FingerChain& finger, device::Device& device) noexcept;

/// Everything a servo thread touches. Only it may change it while a loop runs.
struct Rig {
  double tick_s = 0.001;
  std::vector<FingerChain> fingers;
  EmergencyStop* emergency_stop = nullptr;  ///< owned by the loop's caller; may be null
  std::uint32_t world = 0;                  ///< counts the worlds that were exchanged; part of every sample
};

/// Parts of a rig; each vector has an entry a finger.
struct RigParts {
  FingerSolvers solvers;
  std::vector<contact::FingerSettings> fingers;
  std::vector<device::Device> devices;
  LimiterSettings limiter;
  double tick_s = 0.001;  ///< in place of the settings' own: catch-up, ramps and limits are per second
};

Rig rigOf(RigParts parts);

/// Event in the loop before this tick.
enum class LoopEvent : std::uint8_t { none, stalled };

/// Runs tick number `tick` for all fingers and writes one sample each; `samples` has as many places as there are
/// fingers. No allocation, lock or exception, given a device that keeps its word.
void runTick(Rig& rig, std::uint64_t tick, LoopEvent event, std::span<trace::Sample> samples) noexcept;

}  // namespace palpate::servo
