// What the keys and menus do to the session: switches, modes, requests. Pure.
#pragma once

#include "palpate/window/keys.h"
#include "view/viewer/state/session.h"

namespace palpate::viewer {

/// Does what changes data only, and leaves a request for the rest. Camera moves are requests to the viewer as well.
void perform(window::Action action, Session& session);

/// Whether a switch is on, for check marks in menus; false for actions that are no switches.
bool isOn(window::Action action, const Session& session);

/// The next of 100, 60, 30 and 0 %.
double nextOpacity(double opacity);

}  // namespace palpate::viewer
