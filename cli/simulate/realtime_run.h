// A run against the clock: the servo on a thread of its own, the writer on another, and on this one the deformation
// that a display would draw sixty times a second.
#pragma once

#include <functional>

#include "cli/simulate/simulation.h"
#include "palpate/servo/sample_drain.h"

namespace palpate::app {

/// What turns the calling thread into a servo thread: servo::runPaced, or a loop to compare it with.
using ServoLoop = std::function<servo::LoopReport(servo::Rig& rig, std::uint64_t ticks,
                                                  const servo::PacedSettings& settings, servo::LoopLinks& links)>;

struct RealtimeReport {
  servo::LoopReport loop;
  DisplayReport display;
};

/// `sink` gets every sample, on a thread of its own; it may throw. A signal ends the run early and properly.
RealtimeReport runRealtime(const scene::World& world, servo::Rig& rig, std::uint64_t ticks,
                           const servo::SampleDrain::Sink& sink, const Progress& progress,
                           const ServoLoop& loop = servo::runPaced);

}  // namespace palpate::app
