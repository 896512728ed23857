// Shear of a block of skin before one of its triangles folds: tested for whole blocks, so that triangles are looked at
// only where one might.
//
// A displacement u = p(x) b, p no steeper than s per mm, makes the corners of a triangle follow a plane whose slope is
// at most s / cos(w / 2), w the widest angle, since each edge keeps to s; and at most s + m g, m the largest second
// derivative of p and g = r + 2 a b / (a + b + c), r the radius through the corners and a, b the longer two sides. The
// triangle turns over no sooner than that slope times the part of b in its plane reaches 1. A press has no part in the
// plane of a triangle that it meets head on: hence the cone of normals. Where that does not settle it, what the
// displacement leaves of the area at a vertex does (DeformedBlock::area), since the slope of a triangle is within m g
// of that at each of its corners. Based on: Shewchuk, "What is a good linear finite element?", 2002, for g (1.0 r is
// reached by every triangle and 2 r by needles); the rest own.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/aligned.h"
#include "palpate/base/vec.h"

namespace palpate::deform {

struct Skin;

/// Bounds for all triangles at the vertices of a block.
struct FoldBound {
  Vec3f axis = Vec3f::Zero();  ///< mean of their normals; zero if undefined
  float cos_cone = -1.0f;      ///< cosine of the widest angle between axis and normals
  float gradient_mm = 0.0f;    ///< g: how far a triangle's slope may be from the true one, over the second derivative
  float spread = 0.0f;         ///< the largest 1 / cos(widest angle / 2): 1.15 for equal sides, 1.41 for a right angle
  float longest_mm = 0.0f;     ///< longest of their edges
};

/// A bound a block, and for each vertex (padded to whole blocks) the largest g of its triangles and how far the normal
/// of one is from its own, as vectors. Triangles without area do not count: they cannot fold.
void setFoldBounds(Skin& skin);

/// Largest shear by contacts: sums over them of the largest displacement per mm of skin.
struct ShearBound {
  double press = 0.0;
  double drag = 0.0;
  // The largest second derivatives, 1/mm, likewise.
  double press_bend = 0.0;
  double drag_bend = 0.0;
  Vec3 towards = Vec3::Zero();  ///< the direction of the press; zero for several
  bool is_one = true;           ///< only one contact
};

/// Blocks of less spread (FoldBound) keep all their triangles up, whatever these face: a test for whole tiles.
double certainSpread(const ShearBound& shear) noexcept;

/// True unless it is certain that no triangle of the block folds.
bool mayFold(const FoldBound& block, const ShearBound& shear) noexcept;

/// Vertices of a block at which a triangle may fold, knowing the area left at each (DeformedBlock::area).
/// All that move of a triangle that folds are among them.
std::uint64_t doubtfulVertices(const Skin& skin, Index block, const ShearBound& shear, const float* area) noexcept;

/// For each vertex (padded to whole blocks), should it stay: the largest motion of the vertices joined to it, so that
/// no triangle at it folds and none of them moves by more than 0.4 of the way to it. 0 where a triangle has no area.
AlignedVector<float> roomBesideStaying(const Skin& skin);

}  // namespace palpate::deform
