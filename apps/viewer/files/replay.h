// Stepping through what was touched while the picture is frozen: a picture or a tick back or forth, or as it was. Pure.
#pragma once

#include "apps/viewer/plots/touch_history.h"
#include "apps/viewer/session.h"

namespace palpate::viewer {

/// A step of the arrow keys and of the buttons: one picture at sixty a second.
inline constexpr double kReplayStepS = 1.0 / 60.0;

/// Freezes or goes on. Frozen, the newest moment is shown.
void freeze(Session& session, bool frozen);

/// Moves what is shown, within what there is; playing stops.
void stepReplay(Session& session, double seconds);
/// One tick, forth or back.
void stepTick(Session& session, bool forth);
/// True if the action is a step of a frozen session; then it was done.
bool replayKey(window::Action action, bool fine, Session& session);

/// Once a frame: notes what there is to look at and lets time pass when it plays.
void advanceReplay(Session& session, const TouchHistory& history, double elapsed_s);

}  // namespace palpate::viewer
