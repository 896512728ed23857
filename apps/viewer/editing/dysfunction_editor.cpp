#include "apps/viewer/editing/dysfunction_editor.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::viewer {

namespace {

constexpr int kPoints = 48;
/// Above the skin, so that it does not seem to sink in, mm.
constexpr double kLiftMm = 0.5;
constexpr double kPointRadiusMm = 2.0;  ///< of the ring of a finger without size
constexpr std::array<view::Paint, kFingers> kFingerPaint = {{{110, 165, 255, 230}, {255, 120, 105, 230}}};
constexpr view::Paint kDysfunctionPaint{240, 170, 60, 255};
constexpr view::Paint kGhostPaint{240, 170, 60, 150};

Vec2 onCircle(int i) {
  const double angle = 2.0 * std::numbers::pi * i / kPoints;
  return {std::cos(angle), std::sin(angle)};
}

view::Lines ringOn(const SkinPlace& place, double radius, double width_px, view::Paint paint) {
  const Vec3 u = place.normal.unitOrthogonal();
  const Vec3 v = place.normal.cross(u);
  std::vector<Vec3> path;
  for (int i = 0; i <= kPoints; ++i) {
    const Vec2 rim = radius * onCircle(i);
    path.emplace_back(place.point + kLiftMm * place.normal + rim.x() * u + rim.y() * v);
  }
  view::Lines ring{width_px, {}};
  ring.addPath(path, paint);
  return ring;
}

/// A circle of the map plane, laid on the back of the skin; gaps where there is no skin below.
view::Lines ringOver(const scene::World& world, const maps::Dysfunction& item, double width_px, view::Paint paint,
                     bool dashed) {
  const double top = mesh::boundingBox(world.skin).max().z() + 1.0;
  const auto at = [&](int i) {
    const Vec2 rim = Vec2(item.x_mm, item.y_mm) + item.radius_mm * onCircle(i);
    return view::skinAlong(world.surface, {Vec3(rim.x(), rim.y(), top), -Vec3::UnitZ()});
  };
  view::Lines ring{width_px, {}};
  for (int i = 0; i < kPoints; ++i) {
    if (dashed && i % 2 == 1) continue;
    const auto from = at(i);
    const auto to = at(i + 1);
    if (from && to) ring.add(from->point + kLiftMm * from->normal, to->point + kLiftMm * to->normal, paint);
  }
  return ring;
}

}  // namespace

std::vector<view::Lines> fingerRings(const Session& session, const Pointer& pointer) {
  std::vector<view::Lines> rings;
  for (std::size_t i = 0; i < kFingers; ++i) {
    const auto& place = pointer.placeOf(i);
    if (!place) continue;
    const double radius = std::max(kPointRadiusMm, fingerRadius(session, i));
    const double depth = std::clamp(session.fingers[i].depth_mm, 0.0, 10.0);
    rings.push_back(ringOn(*place, radius, 1.6 + 0.25 * depth, kFingerPaint[i]));
  }
  return rings;
}

std::vector<view::Lines> dysfunctionRings(const Session& session, const Pointer& pointer, const scene::World& world) {
  std::vector<view::Lines> rings;
  const auto& items = session.scene.dysfunctions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool selected = session.editor.selected == static_cast<int>(i);
    rings.push_back(ringOver(world, items[i], selected ? 3.0 : 1.6, kDysfunctionPaint, false));
  }
  const auto& place = pointer.placeOf(session.active_finger);
  if (!place) return rings;
  maps::Dysfunction ghost;
  ghost.x_mm = place->point.x();
  ghost.y_mm = place->point.y();
  if (dysfunctionAt(session, {ghost.x_mm, ghost.y_mm}) < 0) {
    rings.push_back(ringOver(world, ghost, 1.6, kGhostPaint, true));
  }
  return rings;
}

namespace {

using Kind = window::Command::Kind;

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

bool applyEdit(const window::Command& command, const std::optional<Vec2>& place, Session& session) {
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
