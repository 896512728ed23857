// A run against the clock: the servo on a thread of its own, the writer on another, and on this one the deformation
// that a display would draw sixty times a second.
#pragma once

#include <functional>
#include <string>

#include "cli/simulate/simulation.h"
#include "palpate/servo/loop.h"

namespace palpate::app {

/// A loop on the calling thread as servo thread: servo::runPaced, or another to compare it with.
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

// Times the servo loop against the clock: the numbers of `palpate study bench servo`.

/// Runs the scene's fingers on their paths, again and again, for `seconds`, like `palpate simulate --realtime`: the
/// deformation runs at 60 Hz on the calling thread, and samples are consumed (and dropped) on a third.
RealtimeReport measureServo(const scene::World& world, double seconds, const Progress& progress,
                            const ServoLoop& loop = servo::runPaced);

/// The naive loop: std::this_thread::sleep_until before every tick, no request to the system. It
/// makes up for ticks that it slept through; a tick that starts a period or more late counts as an overrun.
servo::LoopReport runSleepUntil(servo::Rig& rig, std::uint64_t ticks, const servo::PacedSettings& settings,
                                servo::LoopLinks& links);

/// "SCHED_FIFO 80" or "SCHED_OTHER": the loop's scheduler.
std::string describeScheduler(const servo::PacingGrant& grant);

}  // namespace palpate::app
