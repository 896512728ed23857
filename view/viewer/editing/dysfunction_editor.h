// Placing, moving, sizing and deleting dysfunctions, every gesture one step that can be undone (edit_history.h).
// Pure.
//
//   mouse ─ Input ─► Command ─ applyEdit ─┐
//   panel, keys ──────────────────────────┴─► the scene's dysfunctions ─ Asks::changed ─► a world with another map
#pragma once

#include <optional>

#include "palpate/base/vec.h"
#include "palpate/body/places.h"
#include "palpate/window/input.h"
#include "view/viewer/state/editor.h"

namespace palpate::viewer {

/// Leaves the editor; also gives up the gesture under way.
void stopEditing(const DysfunctionEdit& edit);

/// Editor commands of the input rules; `place` is the skin under the cursor, in the map plane. False for others.
bool applyEdit(const window::Command& command, const std::optional<Vec2>& place, const DysfunctionEdit& edit);

/// Its place is said in words where the body has names, and is there to the whole millimetre.
void putIntoWords(maps::Dysfunction& item, std::span<const body::SkinLandmark> landmarks);

/// A new one at a named place, selected.
void placeAt(const DysfunctionEdit& edit, const body::NamedPlace& place);

void deleteSelected(const DysfunctionEdit& edit);

/// The dysfunction at a place of the map plane: the one whose centre is nearest among those that reach it; -1 for none.
int dysfunctionAt(const std::vector<maps::Dysfunction>& items, const Vec2& place);

}  // namespace palpate::viewer
