#include "palpate/window/gui_passes.h"

#include <algorithm>
#include <array>
#include <optional>

namespace palpate::window {

namespace {

/// State of a pass so far.
struct Pass {
  std::vector<Key> keys = {};  ///< pressed or released
  std::array<bool, kButtons> buttons{};
  bool edits = false;  ///< a key that edits text was pressed
  std::optional<Vec2> clicked_at = {};
};

/// Letters come as text; a field handles one of the others per pass. Shift, Ctrl and Alt only modify them.
bool edits(Key key) {
  constexpr int kFirstUnprinted = 256;
  constexpr int kFirstModifier = 340;
  const int code = static_cast<int>(key);
  return code >= kFirstUnprinted && code < kFirstModifier;
}

bool hasPlace(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  return event.kind == Kind::move || event.kind == Kind::button || event.kind == Kind::scroll;
}

/// The pass cannot hold this event besides its earlier ones.
bool conflicts(const Pass& pass, const InputEvent& event) {
  using Kind = InputEvent::Kind;
  if (hasPlace(event) && pass.clicked_at && *pass.clicked_at != event.at) return true;
  if (event.kind == Kind::button) return pass.buttons[static_cast<std::size_t>(event.button)];
  if (event.kind == Kind::text) return pass.edits;
  if (event.kind != Kind::key) return false;
  return std::ranges::find(pass.keys, event.key) != pass.keys.end() || (event.down && pass.edits && edits(event.key));
}

void add(Pass& pass, const InputEvent& event) {
  using Kind = InputEvent::Kind;
  if (event.kind == Kind::button) {
    pass.buttons[static_cast<std::size_t>(event.button)] = true;
    pass.clicked_at = event.at;
  }
  if (event.kind != Kind::key) return;
  pass.keys.push_back(event.key);
  pass.edits = pass.edits || (event.down && edits(event.key));
}

}  // namespace

std::vector<std::span<const InputEvent>> guiPasses(std::span<const InputEvent> events) {
  std::vector<std::span<const InputEvent>> passes;
  std::size_t first = 0;
  Pass pass;
  for (std::size_t i = 0; i < events.size() && passes.size() + 1 < kMaxGuiPasses; ++i) {
    if (conflicts(pass, events[i])) {
      passes.push_back(events.subspan(first, i - first));
      first = i;
      pass = {};
    }
    add(pass, events[i]);
  }
  passes.push_back(events.subspan(first));
  return passes;
}

}  // namespace palpate::window
