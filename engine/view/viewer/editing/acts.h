// The effects of keys and menus on the viewer's state: switches, modes, requests. Pure.
#pragma once

#include "palpate/window/keys.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

/// Performs changes of data, and leaves a request for the rest. Camera moves are requests to the viewer as well.
void perform(window::Action action, ViewerState& viewer);

/// Whether a switch is on, for check marks in menus; false for other actions.
bool isOn(window::Action action, const ViewerState& viewer);

/// The next of 100, 60, 30 and 0 %.
double nextOpacity(double opacity);

}  // namespace palpate::viewer
