#include "view/viewer/editing/pointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/mesh/triangle_mesh.h"
#include "view/viewer/editing/dysfunction_editor.h"

namespace palpate::viewer {

namespace {

constexpr int kRingPoints = 48;
/// Above the skin, so that it does not seem to sink in, mm.
constexpr double kLiftMm = 0.5;
constexpr double kPointRadiusMm = 2.0;  ///< of the ring of a finger without size
constexpr view::Paint kDysfunctionPaint{240, 170, 60, 255};
constexpr view::Paint kGhostPaint{240, 170, 60, 150};

Vec2 onCircle(int i) {
  const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
  return {std::cos(angle), std::sin(angle)};
}

view::Lines ringOn(const SkinPlace& place, double radius, double width_px, view::Paint paint) {
  const Vec3 u = place.normal.unitOrthogonal();
  const Vec3 v = place.normal.cross(u);
  std::vector<Vec3> path;
  for (int i = 0; i <= kRingPoints; ++i) {
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
  const double top = mesh::boundingBox(world.body->skin).max().z() + 1.0;
  const auto at = [&](int i) {
    const Vec2 rim = Vec2(item.x_mm, item.y_mm) + item.radius_mm * onCircle(i);
    return view::skinAlong(world.surface, {Vec3(rim.x(), rim.y(), top), -Vec3::UnitZ()});
  };
  view::Lines ring{width_px, {}};
  for (int i = 0; i < kRingPoints; ++i) {
    if (dashed && i % 2 == 1) continue;
    const auto from = at(i);
    const auto to = at(i + 1);
    if (from && to) ring.add(from->point + kLiftMm * from->normal, to->point + kLiftMm * to->normal, paint);
  }
  return ring;
}

}  // namespace

std::vector<view::Lines> fingerRings(const ViewerState& viewer, const Pointer& pointer) {
  std::vector<view::Lines> rings;
  for (std::size_t i = 0; i < kFingers; ++i) {
    const auto& place = pointer.placeOf(i);
    if (!place) continue;
    const double radius = std::max(kPointRadiusMm, fingerRadius(viewer.scene, i));
    const double depth = std::clamp(viewer.fingers[i].depth_mm, 0.0, 10.0);
    rings.push_back(ringOn(*place, radius, 1.6 + 0.25 * depth, kFingerPaint[i]));
  }
  return rings;
}

std::vector<view::Lines> dysfunctionRings(const ViewerState& viewer, const Pointer& pointer,
                                          const scene::World& world) {
  std::vector<view::Lines> rings;
  const auto& items = viewer.scene.dysfunctions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool selected = viewer.editor.selected == static_cast<int>(i);
    rings.push_back(ringOver(world, items[i], selected ? 3.0 : 1.6, kDysfunctionPaint, false));
  }
  const auto& place = pointer.placeOf(viewer.active_finger);
  if (!place) return rings;
  maps::Dysfunction ghost;
  ghost.x_mm = place->point.x();
  ghost.y_mm = place->point.y();
  if (dysfunctionAt(items, {ghost.x_mm, ghost.y_mm}) < 0) {
    rings.push_back(ringOver(world, ghost, 1.6, kGhostPaint, true));
  }
  return rings;
}

}  // namespace palpate::viewer
