// What is known while dysfunctions are edited: which one is selected, and how they were before the gesture under way.
// Plain data; the gestures are in dysfunction_editor.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/body/torso.h"
#include "palpate/maps/stiffness_map.h"
#include "view/viewer/state/requests.h"

namespace palpate::viewer {

struct Editor {
  bool active = false;
  int selected = -1;                                          ///< index of a dysfunction, or none
  std::optional<std::vector<maps::Dysfunction>> before = {};  ///< while one is dragged
};

/// All that an edit touches: the scene's dysfunctions, the editor, and the way to say what changed.
struct DysfunctionEdit {
  std::vector<maps::Dysfunction>& items;
  Editor& editor;
  Asks& asks;
  std::span<const body::SkinLandmark> landmarks = {};  ///< of the body: places get words
};

}  // namespace palpate::viewer
