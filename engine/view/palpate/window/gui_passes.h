// Cuts the events of one frame into passes of the gui. Dear ImGui sees one state of keys, buttons and cursor per pass:
// a key that goes down and up in between, or a click before the cursor moves on, would be lost when frames are slow.
//
//   events of a frame ─► guiPasses ─► Gui::begin (one pass) ─► panels ─► Gui::end, and the next
#pragma once

#include <span>
#include <vector>

#include "palpate/window/input.h"

namespace palpate::window {

/// Even a frame of a second has fewer; further ones share the last pass.
inline constexpr std::size_t kMaxGuiPasses = 64;

/// In order, together all events; at least one pass, which may be empty.
std::vector<std::span<const InputEvent>> guiPasses(std::span<const InputEvent> events);

}  // namespace palpate::window
