// The pressure under the fingers of a recording, taxel by taxel. A recording does not hold it: the ticks are felt
// again, and each pattern is made of the felt contact, so it has the bits that it had while it was recorded.
//
//   RecordingReader ─ replay ─► samples, worlds ─ FeltPressure ─► kPa of each finger, tick by tick
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/contact/pressure_field.h"
#include "palpate/engine/recording_replay.h"

namespace palpate::engine {

struct RecordedPressure {
  std::size_t taxels = 0;  ///< along a side
  /// Per finger the ticks of the span one after the other, `taxels` rows of as many, kPa, rounded to float.
  std::vector<std::vector<float>> kpa;
  ReplayReport replay;  ///< how far the replay equals the recording
};

/// Pressures in the settings' span. Holds all of it in memory: 4 taxels a side make 64 bytes a tick. Throws Error for
/// an invalid pad, for tissue that has no field, and as replay does.
RecordedPressure recordedPressure(trace::RecordingReader& recording, const ReplaySettings& settings,
                                  const contact::PressurePad& pad, const Progress& progress = {});

}  // namespace palpate::engine
