// Marks that show what the skin does: how its places move, its normals, the rings of neighbours round a contact.
#pragma once

#include "palpate/scene/world.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/lines.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

/// Arrows from rest to where the skin is, one in each cube of `spacing_mm` that moved.
void addDisplacements(const scene::World& world, const DrawnSkin& skin, double spacing_mm, Lines& lines);

/// Normals of 5 mm, of at most about `most` vertices, evenly spread over the skin.
void addNormals(const DrawnSkin& skin, Index most, Lines& lines);

/// The edges within each of the first `rings` rings of neighbour nodes round a triangle; the triangle is ring 0.
void addRings(const scene::World& world, const DrawnSkin& skin, Index triangle, int rings, Lines& lines);

/// The cut through a finger's contact, rest and deformed.
void addSection(const scene::World& world, const DrawnSkin& skin, const contact::FingerOutput& contact, Lines& lines);

}  // namespace palpate::view
