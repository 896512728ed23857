#include "view/viewer/editing/rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "palpate/mesh/triangle_mesh.h"
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/editing/lump_editor.h"

namespace palpate::viewer {

namespace {

constexpr int kRingPoints = 48;
/// Above the skin, so that it does not seem to sink in, mm.
constexpr double kLiftMm = 0.5;
constexpr double kPointRadiusMm = 2.0;  ///< radius of the ring of a finger without size
constexpr double kNamedPlaceMm = 24.0;  ///< diameter of the ring round a named place: three fingertips wide
constexpr view::Paint kDysfunctionPaint{240, 170, 60, 255};
constexpr view::Paint kLumpRingPaint{170, 135, 255, 255};

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

/// A circle of the map plane, laid on the back of the skin; gaps without skin below.
view::Lines ringOver(const scene::World& world, const Vec2& centre, double radius_mm, double width_px,
                     view::Paint paint, bool dashed) {
  const double top = mesh::boundingBox(world.body->skin).max().z() + 1.0;
  const auto at = [&](int i) {
    const Vec2 rim = centre + radius_mm * onCircle(i);
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

double ringMm(const maps::Dysfunction& item) { return item.radius_mm; }
double ringMm(const scene::LumpSettings& item) { return item.halfAxes().x(); }

/// All items of an editor, and the one that a click would place.
template <class Item>
std::vector<view::Lines> makeItemRings(const PlaceEdit<Item>& edit, const std::optional<SkinPlace>& under,
                                       const scene::World& world, view::Paint paint) {
  constexpr double kGhostShare = 0.6;  // share of the paint's opacity
  std::vector<view::Lines> rings;
  for (std::size_t i = 0; i < edit.items.size(); ++i) {
    const Item& item = edit.items[i];
    const bool selected = edit.editor.selected == static_cast<int>(i);
    rings.push_back(ringOver(world, {item.x_mm, item.y_mm}, ringMm(item), selected ? 3.0 : 1.6, paint, false));
  }
  if (!under) return rings;
  const Vec2 place(under->point.x(), under->point.y());
  if (itemAt(edit.items, place) < 0) {
    const double ghost_mm = ringMm(EditRules<Item>::placed(edit.items));
    rings.push_back(ringOver(world, place, ghost_mm, 1.6, view::faded(paint, kGhostShare), true));
  }
  return rings;
}

}  // namespace

std::vector<view::Lines> fingerRings(const BodyView& seen, const scene::Scene& scene, const Pointer& pointer) {
  std::vector<view::Lines> rings;
  for (std::size_t i = 0; i < kFingers; ++i) {
    const auto& place = pointer.placeOf(i);
    if (!place) continue;
    const double radius = std::max(kPointRadiusMm, fingerRadius(scene, i));
    const double depth = std::clamp(seen.fingers[i].depth_mm, 0.0, 10.0);
    rings.push_back(ringOn(*place, radius, 1.6 + 0.25 * depth, kFingerPaint[i]));
    if (pointer.isAtNamedPlace(i)) rings.push_back(ringOn(*place, kNamedPlaceMm, 2.0, kFingerPaint[i]));
  }
  return rings;
}

std::vector<view::Lines> dysfunctionRings(const DysfunctionEdit& edit, const std::optional<SkinPlace>& under,
                                          const scene::World& world) {
  return makeItemRings(edit, under, world, kDysfunctionPaint);
}

std::vector<view::Lines> lumpRings(const LumpEdit& edit, const std::optional<SkinPlace>& under,
                                   const scene::World& world) {
  return makeItemRings(edit, under, world, kLumpRingPaint);
}

}  // namespace palpate::viewer
