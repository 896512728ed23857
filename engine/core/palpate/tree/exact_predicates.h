// Exact answers to "on which side?" questions, for any finite double coordinates.
//
// A contact may start only by an event that neither rounding nor scale can hide: these predicates are why a segment
// aimed exactly at an edge, a vertex or along a plane is never lost between two triangles. The exact branch is rare
// (some tens of calls in 20,000 ticks), uses no heap and no absolute tolerance.
//
// Exact as long as products of three coordinates neither overflow nor underflow: magnitudes of 1e-90 to 1e90, or zero.
//
// Based on: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates" (1997).
#pragma once

#include "palpate/base/vec.h"

namespace palpate::tree {

/// Sign of det(b - a, c - a, d - a): +1 when d lies in front of the counter-clockwise triangle (a, b, c), -1 behind it,
/// 0 exactly on its plane. The sign is exact.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

/// Whether the segment from -> to passes the triangle (a, b, c) from its front to its back.
///
/// Half open: `from` on the plane counts as front, `to` on the plane too, so a point that stops exactly on a surface
/// enters with its next move and not never. Edges and corners belong to every triangle that has them, so there is
/// overlap but no gap. A triangle without area is never crossed.
bool crossesFrontToBack(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to) noexcept;

}  // namespace palpate::tree
