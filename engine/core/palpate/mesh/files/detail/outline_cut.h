// The area within a plane outline -> triangles over its own corners.
//
// Any simple outline, and modellers' form of one with holes: a bridge from the rim to each hole that the outline runs
// to and fro. Corners at one place, corners on another side and sides on top of each other are allowed. O(n log n) for
// n corners. Every decision is an exact sign, so the result is the same with every compiler.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::mesh {

/// Triangles of numbers of corners, counter-clockwise, for an outline that runs counter-clockwise; of corners at one
/// place the first is named. None where two sides cross, or the outline does not run around every place either once or
/// not at all. Coordinates: of magnitude 1e-90 to 1, or zero.
std::optional<std::vector<Triangle>> triangulateOutline(std::span<const Vec2> corners);

}  // namespace palpate::mesh
