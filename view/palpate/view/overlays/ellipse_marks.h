// Deformation ellipses as outlines that lie on the skin and move with it.
#pragma once

#include <optional>
#include <vector>

#include "palpate/contact/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// A place of the skin that moves with it: a triangle and the weights of its corners.
struct SkinSpot {
  Triangle vertices{};
  Vec3f weights = Vec3f::Zero();
};

/// Where a segment first enters the skin at rest.
std::optional<SkinSpot> spotBetween(const contact::Surface& surface, const Vec3& from, const Vec3& to);

inline Vec3 placeOf(const SkinSpot& spot, const DrawnSkin& skin) {
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < 3; ++i) place += static_cast<double>(spot.weights[i]) * skin.at(spot.vertices[i]);
  return place;
}

/// Outlines as far as they lie over the skin: pieces of a closed curve.
using Outline = std::vector<std::vector<SkinSpot>>;

/// The ellipse round `centre` in the plane square to `normal` (unit), seen along it onto the skin.
Outline outlineOf(const scene::World& world, const maps::SurfaceEllipse& ellipse, const Vec3& centre,
                  const Vec3& normal);

/// Of the map's key points, seen along z as the map is. Costs some 0.1 ms an ellipse: keep them.
std::vector<Outline> keyOutlines(const scene::World& world);

void addOutline(const Outline& outline, const DrawnSkin& skin, Paint paint, Lines& lines);

/// The regions that a finger's normal and tangential part move.
void addContactEllipses(const scene::World& world, const contact::FingerOutput& contact, const DrawnSkin& skin,
                        Lines& lines);

}  // namespace palpate::view
