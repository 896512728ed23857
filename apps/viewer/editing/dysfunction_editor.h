// Placing, moving, sizing and deleting dysfunctions, every gesture one step that can be undone. Pure.
#pragma once

#include <vector>

#include "apps/viewer/editing/pointer.h"
#include "apps/viewer/session.h"
#include "palpate/view/lines.h"
#include "palpate/window/input.h"

namespace palpate::viewer {

// Rings on the skin that belong to the window, not to the picture: where each finger would press, and in the editor
// where the dysfunctions are. In space, so that both eyes of a stereo picture see them where they are.

/// A ring under each finger that has been over the skin, as large as the finger, tilted with the skin; thicker the
/// deeper it presses.
std::vector<view::Lines> fingerRings(const Session& session, const Pointer& pointer);

/// The rims of the dysfunctions, laid on the skin; the selected one bold. Where the pointer is on free skin, dashed:
/// the one that a click would place.
std::vector<view::Lines> dysfunctionRings(const Session& session, const Pointer& pointer, const scene::World& world);

void startEditing(Session& session);
/// Also gives up the gesture under way.
void stopEditing(Session& session);

/// Editor commands of the input rules; `place` is the skin under the cursor, in the map plane. False for others.
bool applyEdit(const window::Command& command, const std::optional<Vec2>& place, Session& session);

void deleteSelected(Session& session);
void undo(Session& session);
void redo(Session& session);

/// The dysfunction at a place of the map plane: the one whose centre is nearest among those that reach it; -1 for none.
int dysfunctionAt(const Session& session, const Vec2& place);

/// Around a change by a widget or a gesture: remember, then make one step of it.
void beginEdit(Session& session);
void commitEdit(Session& session, const std::string& words);

}  // namespace palpate::viewer
