// Times the servo loop against the clock: the numbers of `palpate study bench servo`.
#pragma once

#include <string>

#include "cli/simulate/realtime_run.h"

namespace palpate::app {

/// Runs the scene's fingers on their paths, again and again, for `seconds`, as `palpate simulate --realtime` does: the
/// deformation runs beside them at 60 Hz on the calling thread, and samples are taken out (and thrown away) on a third.
RealtimeReport measureServo(const scene::World& world, double seconds, const Progress& progress,
                            const ServoLoop& loop = servo::runPaced);

/// The loop that comes to mind first: std::this_thread::sleep_until before every tick, nothing asked of the system. It
/// makes up for ticks that it slept through; a tick that starts a period or more late counts as an overrun.
servo::LoopReport runSleepUntil(servo::Rig& rig, std::uint64_t ticks, const servo::PacedSettings& settings,
                                servo::LoopLinks& links);

/// "SCHED_FIFO 80" or "SCHED_OTHER": what the loop ran under.
std::string schedulerOf(const servo::PacingGrant& grant);

}  // namespace palpate::app
