// A finger's settings as a recording keeps them: every number of its contact and its limiter, and back.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/device/device.h"
#include "palpate/device/device_frame.h"
#include "palpate/scene/world.h"
#include "palpate/servo/limiter.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/recording_writer.h"

namespace palpate::engine {

/// "radius_mm = 8", one per line; numbers read back to the same bits.
std::string asText(const contact::FingerSettings& settings);
std::string asText(const servo::LimiterSettings& settings, bool closes_loop);

/// Keys that the text lacks keep their defaults. Throws Error for an unknown key and for an invalid number.
contact::FingerSettings contactSettingsFrom(const std::string& text);
struct RecordedLimiter {
  servo::LimiterSettings settings;
  bool closes_loop = true;
  bool follows_exchange = false;  ///< servo::Handover::follows; older recordings lack it
};
RecordedLimiter limiterFrom(const std::string& text);
/// A limiter's limits, for people.
std::string describeLimits(const servo::LimiterSettings& limits);

/// The limits that a finger was felt with in a recorded world.
struct FingerLimits {
  std::string finger;
  servo::LimiterSettings limits;
};
/// Limits of the fingers that had any, which the mouse's have not; settings that cannot be read are left out.
std::vector<FingerLimits> limitsIn(const trace::RecordingWorld& world, std::span<const trace::RecordingFinger> fingers);

/// Hash of skin, stiffness and force law: two worlds with the same hash give the same forces.
std::uint64_t hashOf(const scene::World& world);

/// A sentence where the world that was built is not the recorded one; empty: it is.
std::string noteOfAnotherWorld(const trace::RecordingWorld& recorded, std::uint32_t number, const scene::World& world);

/// A finger's settings.
struct FingerSetup {
  contact::FingerSettings contact;
  servo::LimiterSettings limiter;
  bool closes_loop = true;
};
std::vector<FingerSetup> feltWith(const servo::Rig& rig);

/// A world as a recording keeps it, with what each finger is felt with in it.
trace::RecordingWorld recordingWorld(const scene::World& world, std::span<const FingerSetup> fingers);

/// A finger with the device that has it; where `frame` is given, also how the device's space lies in the body.
trace::RecordingFinger recordingFinger(std::string name, const device::Device& device,
                                       const device::DeviceFrame* frame = nullptr);

/// Header of a recording that begins now: this software, this machine (no names of people or computers).
trace::RecordingHeader recordingHeader(double ticks_per_s);

}  // namespace palpate::engine
