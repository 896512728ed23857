// State of editing on the body: the selected item, and the items before the current gesture. Plain data; the gestures
// are in place_editor.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/body/torso.h"
#include "palpate/maps/stiffness_map.h"
#include "palpate/scene/scene.h"
#include "view/viewer/state/requests.h"

namespace palpate::viewer {

template <class Item>
struct PlaceEditor {
  bool active = false;
  int selected = -1;                             ///< index of an item, or none
  std::optional<std::vector<Item>> before = {};  ///< while one is dragged
};
using Editor = PlaceEditor<maps::Dysfunction>;
using LumpEditor = PlaceEditor<scene::LumpSettings>;

/// Everything that an edit touches: items of the scene, their editor, and the report of changes.
template <class Item>
struct PlaceEdit {
  std::vector<Item>& items;
  PlaceEditor<Item>& editor;
  UiOutput& output;
  std::span<const body::SkinLandmark> landmarks = {};  ///< the body's: places get names
};
using DysfunctionEdit = PlaceEdit<maps::Dysfunction>;
using LumpEdit = PlaceEdit<scene::LumpSettings>;

}  // namespace palpate::viewer
