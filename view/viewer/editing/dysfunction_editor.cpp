#include "view/viewer/editing/dysfunction_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/body/places.h"

namespace palpate::viewer {

namespace {

using Kind = window::Command::Kind;

constexpr double kSizePerNotch = 1.08;
constexpr double kPercentPerNotch = 5.0;
constexpr double kMinRadiusMm = 2.0;
constexpr double kMaxRadiusMm = 200.0;

maps::Dysfunction* selected(const DysfunctionEdit& edit) {
  const int i = edit.editor.selected;
  auto& items = edit.items;
  return i >= 0 && i < static_cast<int>(items.size()) ? &items[static_cast<std::size_t>(i)] : nullptr;
}

std::string nameOfSelected(const DysfunctionEdit& edit) { return trf("dysfunction {}", edit.editor.selected + 1); }

void grab(const DysfunctionEdit& edit, const Vec2& place) {
  edit.editor.before = edit.items;
  edit.editor.selected = dysfunctionAt(edit.items, place);
  if (edit.editor.selected >= 0) return;
  maps::Dysfunction placed;
  placed.x_mm = place.x();
  placed.y_mm = place.y();
  edit.items.push_back(placed);
  edit.editor.selected = static_cast<int>(edit.items.size()) - 1;
  edit.asks.changed |= kMapChange;
}

void moveTo(const DysfunctionEdit& edit, const Vec2& place) {
  maps::Dysfunction* item = selected(edit);
  if (item == nullptr) return;
  item->x_mm = place.x();
  item->y_mm = place.y();
  item->at.clear();  // words would put it back
  edit.asks.changed |= kMapChange;
}

/// A turn of the wheel is a gesture of its own.
template <class Change>
void changeSelected(const DysfunctionEdit& edit, const char* verb, const Change& change) {
  maps::Dysfunction* item = selected(edit);
  if (item == nullptr) return;
  change(*item);
  edit.asks.changed |= kMapChange;
  edit.asks.step = fmt::format("{} {}", verb, nameOfSelected(edit));
}

}  // namespace

void placeAt(const DysfunctionEdit& edit, const body::NamedPlace& place) {
  maps::Dysfunction placed;
  placed.at = place.name;
  placed.x_mm = place.point.x();
  placed.y_mm = place.point.y();
  edit.items.push_back(placed);
  edit.editor.selected = static_cast<int>(edit.items.size()) - 1;
  edit.asks.changed |= kMapChange;
  edit.asks.step = trf("place {}", nameOfSelected(edit));
}

void stopEditing(const DysfunctionEdit& edit) {
  Editor& editor = edit.editor;
  editor.active = false;
  if (!editor.before) return;
  edit.items = std::move(*std::exchange(editor.before, std::nullopt));
  editor.selected = std::min(editor.selected, static_cast<int>(edit.items.size()) - 1);
  edit.asks.changed |= kMapChange;
}

int dysfunctionAt(const std::vector<maps::Dysfunction>& items, const Vec2& place) {
  int best = -1;
  double nearest = 1e300;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double away = std::hypot(items[i].x_mm - place.x(), items[i].y_mm - place.y());
    if (away <= items[i].radius_mm && away < nearest) {
      nearest = away;
      best = static_cast<int>(i);
    }
  }
  return best;
}

bool applyEdit(const window::Command& command, const std::optional<Vec2>& place, const DysfunctionEdit& edit) {
  switch (command.kind) {
    case Kind::edit_grab:
      if (place) grab(edit, *place);
      return true;
    case Kind::edit_move:
      if (place) moveTo(edit, *place);
      return true;
    case Kind::edit_drop:
      if (maps::Dysfunction* item = selected(edit)) putIntoWords(*item, edit.landmarks);
      edit.editor.before.reset();
      edit.asks.step = trf("place {}", nameOfSelected(edit));
      return true;
    case Kind::edit_size:
      changeSelected(edit, "resize", [&](maps::Dysfunction& item) {
        item.radius_mm =
            std::clamp(item.radius_mm * std::pow(kSizePerNotch, command.amount), kMinRadiusMm, kMaxRadiusMm);
      });
      return true;
    case Kind::edit_strength:
      changeSelected(edit, "change", [&](maps::Dysfunction& item) {
        item.change_percent = std::clamp(item.change_percent + kPercentPerNotch * command.amount, -100.0, 1000.0);
      });
      return true;
    default:
      return false;
  }
}

void putIntoWords(maps::Dysfunction& item, std::span<const body::SkinLandmark> landmarks) {
  item.at = body::placeWords(landmarks, Vec2(item.x_mm, item.y_mm));
  if (item.at.empty()) return;
  const Vec3 point = body::placeNamed(landmarks, item.at).point;
  item.x_mm = point.x();
  item.y_mm = point.y();
}

void deleteSelected(const DysfunctionEdit& edit) {
  if (selected(edit) == nullptr) return;
  edit.asks.step = trf("delete {}", nameOfSelected(edit));
  edit.items.erase(edit.items.begin() + edit.editor.selected);
  edit.editor.selected = -1;
  edit.asks.changed |= kMapChange;
}

}  // namespace palpate::viewer
