// One servo tick: every finger reads its device, touches the surface, and sends a safe force back.
//
// The paced loop and the headless one both call this, so what a script feels is what a hand feels.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/device/device.h"
#include "palpate/servo/hdb_fingers.h"
#include "palpate/servo/limiter.h"
#include "palpate/trace/sample.h"

namespace palpate::servo {

/// One finger: its settings, its device and what it remembers from tick to tick.
struct FingerChain {
  contact::FingerSettings contact_settings;
  LimiterSettings limiter_settings;
  device::Device device;
  contact::FingerState contact;
  hdb::HdbFingerState hdb;  ///< in place of `contact` where the rig has HDB fingers
  LimiterState limiter;
};

/// Everything a servo thread touches. The surface must outlive it; nobody else may change the chains while a loop runs.
struct Rig {
  const contact::Surface* surface = nullptr;
  double tick_s = 0.001;
  std::vector<FingerChain> fingers;
  /// Contact against the triangles of the detecting box only; null: against the whole surface.
  std::unique_ptr<HdbFingers> hdb;
  /// Where rebuilt partitions come from while the loop runs; may be null. Must outlive the loop.
  Handover<HdbFingers>* new_hdb = nullptr;
};

/// What happened to the loop before this tick.
enum class LoopEvent : std::uint8_t { none, stalled };

/// Runs tick number `tick` for all fingers and writes one sample each; `samples` has as many places as there are
/// fingers. No allocation, lock or exception, given a device that keeps its word.
void runTick(Rig& rig, std::uint64_t tick, LoopEvent event, std::span<trace::Sample> samples) noexcept;

}  // namespace palpate::servo
