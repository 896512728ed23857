// Placing, moving, sizing and deleting dysfunctions, every gesture one step that can be undone. Pure.
#pragma once

#include "apps/viewer/session.h"
#include "palpate/view/input.h"

namespace palpate::viewer {

void startEditing(Session& session);
/// Also gives up the gesture under way.
void stopEditing(Session& session);

/// Editor commands of the input rules; `place` is the skin under the cursor, in the map plane. False for others.
bool applyEdit(const view::Command& command, const std::optional<Vec2>& place, Session& session);

void deleteSelected(Session& session);
void undo(Session& session);
void redo(Session& session);

/// The dysfunction at a place of the map plane: the one whose centre is nearest among those that reach it; -1 for none.
int dysfunctionAt(const Session& session, const Vec2& place);

/// Around a change by a widget or a gesture: remember, then make one step of it.
void beginEdit(Session& session);
void commitEdit(Session& session, const std::string& words);

}  // namespace palpate::viewer
