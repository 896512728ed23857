// Parts of a recording in files of other formats: columns for NumPy, the deformed skin at a moment, pictures and sound
// notes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/engine/recorded_pressure.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/trace/forces_csv.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::app {

/// Every column of every finger as an array, "index.tick"; "ticks_per_s". `pressure` of the same span, or null: as
/// "index.pressure_kpa", ticks x taxels x taxels. Rows of all fingers. Throws Error.
std::uint64_t writeNpz(trace::RecordingReader& recording, const trace::TickSpan& span,
                       const std::filesystem::path& file, const engine::RecordedPressure* pressure,
                       const Progress& progress);

/// The same as columns of a table, "pressure_1_1_kpa" the first taxel of the row that is nearest to the head. For the
/// samples of the span in order; `pressure` must outlive it. Empty for null.
trace::MoreColumns pressureColumns(const engine::RecordedPressure* pressure);

/// Writes all but the files that a bundle carries. Makes the folder. Throws Error. Returns the count.
std::uint64_t writeAttachments(trace::RecordingReader& recording, const trace::TickSpan& span,
                               const std::filesystem::path& folder);

/// A world of the recording to view, with all of the recording's fingers; `folder`: of the files that its scene names,
/// empty: the scene's own. Throws Error.
std::shared_ptr<const scene::World> worldToSee(trace::RecordingReader& recording, std::uint32_t number,
                                               const std::filesystem::path& folder,
                                               const std::function<void(scene::Scene&)>& change,
                                               const Progress& progress);

/// The fingers at these times, s, in rising order. Throws Error for one that is not in the recording.
std::vector<servo::TickSamples> recordedFrames(trace::RecordingReader& recording, const std::vector<double>& times_s);

/// Throws Error for fingers on another body than the recorded one: triangles that do not exist.
void requireFitting(const servo::TickSamples& frame, const scene::World& world);

/// The tick at which the fingers press deepest.
std::uint64_t deepestTick(trace::RecordingReader& recording);

}  // namespace palpate::app
