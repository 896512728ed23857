// A run against the clock: the servo on a thread of its own, the writer on another, and on this one the deformation
// that a display would draw sixty times a second.
#pragma once

#include "apps/palpate/run_recorder.h"
#include "apps/palpate/simulation.h"

namespace palpate::app {

/// Fills `result.loop` and `result.display`. Ctrl-C ends the run early and properly.
void runRealtime(const scene::World& world, servo::Rig& rig, std::uint64_t ticks, RunRecorder& recorder,
                 SimulationResult& result, const Progress& progress);

}  // namespace palpate::app
