// Back end `hand`: a simulated hand on a simulated device (simulated_hand.h), opened by name like any other, so that
// the whole loop runs closed without hardware: headless, the same bits each time, or paced by the clock.
//
//   "hand:stylus_z,touch_x" ─► HandDevice ─► read_tip, write_force ─► servo
//
// The hand is drawn along the finger's path (OpenOptions::tips) by its own arm, so it lags and gives way as a hand
// does; without a path it stays where it was opened. Time passes by the servo's ticks and by nothing else.
#pragma once

#include <string_view>

#include "palpate/device/back_ends.h"
#include "palpate/device/simulated_hand.h"

namespace palpate::device {

/// Choice by the words behind `hand:`.
struct HandChoice {
  HandKind hand = HandKind::stylus_x;
  scene::DeviceModel device = scene::DeviceModel::touch_x;
};

/// "stylus_z,touch_x": a hand and a device, either alone or both, in any order; empty: the choice above. Throws Error
/// for another word, with the nearest.
HandChoice handChoice(std::string_view words);

/// The push of a dead load, N, along -z: into a back that lies under it.
inline constexpr double kDeadLoadN = 1.0;

/// Delay of the simulated device, servo ticks.
inline constexpr int kHandDelayTicks = 1;

Probe probeHand(const OpenOptions& options);

/// The device owns its hand: copies of it are the same one. Axes and scale are without meaning: it lives in the body
/// frame.
Device openHand(const OpenOptions& options);

}  // namespace palpate::device
