// A recording felt again: the recorded poses through the recorded scene, compared with the recorded samples, bit for
// bit.
//
//   RecordingReader ─ tick ─► touch, limiter ─► samples ─ compared ─► ReplayReport
//
// The inputs of a tick are in its sample: the tip that was used, whether the finger had been put elsewhere, and what
// the limiter reported about the device. So contact, contact force, limiter and the force sent to the device are all
// computed again, by the code that computed them first.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/world.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::engine {

/// The first place where the replay differs from the record.
struct ReplayDifference {
  std::uint64_t tick = 0;
  std::string finger;
  std::string field;  ///< field in trace::sampleColumns
  std::string recorded;
  std::string replayed;
};

struct ReplayReport {
  std::uint64_t ticks = 0;      ///< samples that were compared
  std::uint64_t different = 0;  ///< those that differ
  double build_s = 0.0;         ///< time spent on building the worlds
  std::optional<ReplayDifference> first_difference;
  std::vector<std::string> notes;  ///< a world that is not the recorded one, and so on
  std::uint64_t unproven = 0;      ///< samples that were not compared: time before them is missing from the recording
  std::vector<std::string> gaps;   ///< where, in words
  bool identical() const { return ticks > 0 && different == 0 && notes.empty(); }
};

struct ReplaySettings {
  trace::TickSpan span;          ///< compared span
  std::filesystem::path folder;  ///< where the files that the scene names lie now; empty: where they lay
  /// Gets each world with its number in the recording, before the first tick in it.
  std::function<void(std::uint32_t number, const std::shared_ptr<const scene::World>& world)> entered = {};
};

/// Gets the samples of the replay, tick by tick, those of the span.
using ReplaySink = std::function<void(std::span<const trace::Sample>)>;

/// Feels the recording from its beginning to the end of the span and compares the ticks of the span. Throws Error for a
/// scene that can no longer be built.
ReplayReport replay(trace::RecordingReader& recording, const ReplaySettings& settings = {}, const ReplaySink& sink = {},
                    const Progress& progress = {});

/// The world of a recording, built from the scene's files in this folder. Throws Error.
std::shared_ptr<const scene::World> builtWorld(const trace::RecordingWorld& recorded,
                                               const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace palpate::engine
