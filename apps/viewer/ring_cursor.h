// The ring on the skin where the finger is or would go: as wide as the finger, tilted as the skin, thicker the deeper
// it presses.
#pragma once

#include "apps/viewer/pointer.h"

namespace palpate::viewer {

/// Drawn behind the panels, in a Gui frame that has begun. In stereo modes the ball is cursor enough: a ring drawn by
/// the panels would lie in the plane of the screen.
void ringCursor(const Session& session, const Pointer& pointer, const view::Eyes& eyes);

}  // namespace palpate::viewer
