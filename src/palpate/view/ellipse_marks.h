// Deformation ellipses as outlines that lie on the skin and move with it.
#pragma once

#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/lines.h"
#include "palpate/view/skin_spot.h"

namespace palpate::view {

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
