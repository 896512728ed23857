// Placing, moving, sizing and deleting things of the body by hand, every gesture one step that can be undone
// (edit_history.h). The same gestures for every kind of thing; EditRules has the differences. Pure.
//
//   mouse ─ Input ─► Command ─ applyEdit ─┐
//   panel, keys ──────────────────────────┴─► items of the scene ─ UiOutput::changed ─► a world with other tissue
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/base/vec.h"
#include "palpate/body/places.h"
#include "palpate/window/input.h"
#include "view/viewer/state/editor.h"

namespace palpate::viewer {

/// A kind of thing has these as static functions:
///   Item placed(const std::vector<Item>& items)              a new one, next to the existing ones
///   double reachMm(const Item& item)                          grabbing distance
///   void resize(Item& item, double notches)                   by the wheel
///   void strengthen(Item& item, double notches)               by Shift and the wheel
///   std::string nameOf(const std::vector<Item>& items, int index)    for the text of a step
template <class Item>
struct EditRules;

template <class Item>
Item* selectedItem(const PlaceEdit<Item>& edit) {
  const int i = edit.editor.selected;
  return i >= 0 && i < static_cast<int>(edit.items.size()) ? &edit.items[static_cast<std::size_t>(i)] : nullptr;
}

template <class Item>
std::string nameOfSelected(const PlaceEdit<Item>& edit) {
  return EditRules<Item>::nameOf(edit.items, edit.editor.selected);
}

/// The thing at a place of the map plane: the one whose centre is nearest among those that reach it; -1 for none.
template <class Item>
int itemAt(const std::vector<Item>& items, const Vec2& place) {
  int best = -1;
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double away = std::hypot(items[i].x_mm - place.x(), items[i].y_mm - place.y());
    if (away <= EditRules<Item>::reachMm(items[i]) && away < nearest) {
      nearest = away;
      best = static_cast<int>(i);
    }
  }
  return best;
}

/// Leaves the editor; also cancels the current gesture.
template <class Item>
void stopEditing(const PlaceEdit<Item>& edit) {
  PlaceEditor<Item>& editor = edit.editor;
  editor.active = false;
  if (!editor.before) return;
  edit.items = std::move(*std::exchange(editor.before, std::nullopt));
  editor.selected = std::min(editor.selected, static_cast<int>(edit.items.size()) - 1);
  edit.output.changed |= kMapChange;
}

/// Adds a new one there, selected.
template <class Item>
Item& placeNew(const PlaceEdit<Item>& edit, const Vec2& place) {
  Item placed = EditRules<Item>::placed(edit.items);
  placed.x_mm = place.x();
  placed.y_mm = place.y();
  edit.items.push_back(std::move(placed));
  edit.editor.selected = static_cast<int>(edit.items.size()) - 1;
  edit.output.changed |= kMapChange;
  return edit.items.back();
}

template <class Item>
void placeAt(const PlaceEdit<Item>& edit, const body::NamedPlace& place) {
  placeNew(edit, Vec2(place.point.x(), place.point.y())).at = place.name;
  edit.output.step = trf("place {}", nameOfSelected(edit));
}

/// Names its place where the body has names, to the whole millimetre.
template <class Item>
void namePlace(Item& item, std::span<const body::SkinLandmark> landmarks) {
  item.at = body::makePlaceName(landmarks, Vec2(item.x_mm, item.y_mm));
  if (item.at.empty()) return;
  const Vec3 point = body::placeNamed(landmarks, item.at).point;
  item.x_mm = point.x();
  item.y_mm = point.y();
}

template <class Item>
void deleteSelected(const PlaceEdit<Item>& edit) {
  if (selectedItem(edit) == nullptr) return;
  edit.output.step = trf("delete {}", nameOfSelected(edit));
  edit.items.erase(edit.items.begin() + edit.editor.selected);
  edit.editor.selected = -1;
  edit.output.changed |= kMapChange;
}

// ---- gestures

template <class Item>
void grabAt(const PlaceEdit<Item>& edit, const Vec2& place) {
  edit.editor.before = edit.items;
  edit.editor.selected = itemAt(edit.items, place);
  if (edit.editor.selected < 0) placeNew(edit, place);
}

template <class Item>
void moveSelected(const PlaceEdit<Item>& edit, const Vec2& place) {
  Item* item = selectedItem(edit);
  if (item == nullptr) return;
  item->x_mm = place.x();
  item->y_mm = place.y();
  item->at.clear();  // a name would put it back
  edit.output.changed |= kMapChange;
}

/// One turn of the wheel is one gesture.
template <class Item>
void changeSelected(const PlaceEdit<Item>& edit, const char* verb, void (*change)(Item&, double), double notches) {
  Item* item = selectedItem(edit);
  if (item == nullptr) return;
  change(*item, notches);
  edit.output.changed |= kMapChange;
  edit.output.step = fmt::format("{} {}", verb, nameOfSelected(edit));
}

/// Handles editor commands of the input rules; `place` is the skin under the cursor, in the map plane. False for
/// others.
template <class Item>
bool applyEdit(const window::Command& command, const std::optional<Vec2>& place, const PlaceEdit<Item>& edit) {
  using Kind = window::Command::Kind;
  switch (command.kind) {
    case Kind::edit_grab:
      if (place) grabAt(edit, *place);
      return true;
    case Kind::edit_move:
      if (place) moveSelected(edit, *place);
      return true;
    case Kind::edit_drop:
      if (Item* item = selectedItem(edit)) namePlace(*item, edit.landmarks);
      edit.editor.before.reset();
      edit.output.step = trf("place {}", nameOfSelected(edit));
      return true;
    case Kind::edit_size:
      changeSelected(edit, "resize", &EditRules<Item>::resize, command.amount);
      return true;
    case Kind::edit_strength:
      changeSelected(edit, "change", &EditRules<Item>::strengthen, command.amount);
      return true;
    default:
      return false;
  }
}

}  // namespace palpate::viewer
