// Inside or outside: how often a surface winds round a point.
#pragma once

#include "palpate/tree/triangle_tree.h"

namespace palpate::tree {

/// What the surface below each child of a node looks like from afar: one small plate with its area and facing. Fills
/// TriangleTree::far_plates; called by buildTriangleTree.
void fillFarPlates(TriangleTree& tree);

/// The generalised winding number: 1 inside a closed surface and 0 outside of it (negative in a part that is inside
/// out, more than 1 where bodies overlap, in between where a sheet is open). Within 0.05 of the exact sum of solid
/// angles for bodies; a point on the surface is in between. About 1 us at 3,000 triangles and 3 us at 1,000,000.
double windingNumber(const TriangleTree& tree, const Vec3& point) noexcept;

}  // namespace palpate::tree
