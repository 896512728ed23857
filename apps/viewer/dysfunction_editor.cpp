#include "apps/viewer/dysfunction_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace palpate::viewer {

namespace {

using Kind = view::Command::Kind;

constexpr double kSizePerNotch = 1.08;
constexpr double kPercentPerNotch = 5.0;
constexpr double kLeastRadiusMm = 2.0;
constexpr double kMostRadiusMm = 200.0;

maps::Dysfunction* selected(Session& session) {
  const int i = session.editor.selected;
  auto& items = session.scene.dysfunctions;
  return i >= 0 && i < static_cast<int>(items.size()) ? &items[static_cast<std::size_t>(i)] : nullptr;
}

std::string nameOfSelected(const Session& session) {
  return fmt::format("dysfunction {}", session.editor.selected + 1);
}

void grab(Session& session, const Vec2& place) {
  beginEdit(session);
  session.editor.selected = dysfunctionAt(session, place);
  if (session.editor.selected >= 0) return;
  maps::Dysfunction placed;
  placed.x_mm = place.x();
  placed.y_mm = place.y();
  session.scene.dysfunctions.push_back(placed);
  session.editor.selected = static_cast<int>(session.scene.dysfunctions.size()) - 1;
  session.changed |= kMapChange;
}

void moveTo(Session& session, const Vec2& place) {
  maps::Dysfunction* item = selected(session);
  if (item == nullptr) return;
  item->x_mm = place.x();
  item->y_mm = place.y();
  session.changed |= kMapChange;
}

/// A turn of the wheel is a gesture of its own.
template <class Change>
void changeSelected(Session& session, const char* verb, const Change& change) {
  maps::Dysfunction* item = selected(session);
  if (item == nullptr) return;
  beginEdit(session);
  change(*item);
  session.changed |= kMapChange;
  commitEdit(session, fmt::format("{} {}", verb, nameOfSelected(session)));
}

}  // namespace

void startEditing(Session& session) { session.editor.active = true; }

void stopEditing(Session& session) {
  setDysfunctions(session, session.editor.history.abandon(dysfunctionsOf(session)));
  session.editor.active = false;
}

void beginEdit(Session& session) { session.editor.history.begin(dysfunctionsOf(session)); }

void commitEdit(Session& session, const std::string& words) {
  session.editor.history.commit(dysfunctionsOf(session), words);
}

int dysfunctionAt(const Session& session, const Vec2& place) {
  int best = -1;
  double nearest = 1e300;
  const auto& items = session.scene.dysfunctions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double away = std::hypot(items[i].x_mm - place.x(), items[i].y_mm - place.y());
    if (away <= items[i].radius_mm && away < nearest) {
      nearest = away;
      best = static_cast<int>(i);
    }
  }
  return best;
}

bool applyEdit(const view::Command& command, const std::optional<Vec2>& place, Session& session) {
  switch (command.kind) {
    case Kind::edit_grab:
      if (place) grab(session, *place);
      return true;
    case Kind::edit_move:
      if (place) moveTo(session, *place);
      return true;
    case Kind::edit_drop:
      commitEdit(session, "place " + nameOfSelected(session));
      return true;
    case Kind::edit_size:
      changeSelected(session, "resize", [&](maps::Dysfunction& item) {
        item.radius_mm =
            std::clamp(item.radius_mm * std::pow(kSizePerNotch, command.amount), kLeastRadiusMm, kMostRadiusMm);
      });
      return true;
    case Kind::edit_strength:
      changeSelected(session, "change", [&](maps::Dysfunction& item) {
        item.change_percent = std::clamp(item.change_percent + kPercentPerNotch * command.amount, -100.0, 1000.0);
      });
      return true;
    default:
      return false;
  }
}

void deleteSelected(Session& session) {
  if (selected(session) == nullptr) return;
  beginEdit(session);
  const std::string words = "delete " + nameOfSelected(session);
  session.scene.dysfunctions.erase(session.scene.dysfunctions.begin() + session.editor.selected);
  session.editor.selected = -1;
  session.changed |= kMapChange;
  commitEdit(session, words);
}

void undo(Session& session) {
  auto& history = session.editor.history;
  if (!history.canUndo()) return session.report(Severity::info, "Nothing to undo");
  session.report(Severity::info, "Undo: " + history.undoWords());
  setDysfunctions(session, history.undo(dysfunctionsOf(session)));
}

void redo(Session& session) {
  auto& history = session.editor.history;
  if (!history.canRedo()) return session.report(Severity::info, "Nothing to redo");
  session.report(Severity::info, "Redo: " + history.redoWords());
  setDysfunctions(session, history.redo(dysfunctionsOf(session)));
}

}  // namespace palpate::viewer
