// A place on the skin at rest: the one type for it outside the tick, for drawing, editing, measuring and teaching.
//
// The source of a place defines its triangle index: a record of the contact surface's tree, or a triangle of the mesh.
// Inside the tick it is contact::SurfacePoint, which knows on what feature of its triangle it lies and computes the
// normal only where it is needed.
#pragma once

#include "palpate/base/vec.h"

namespace palpate {

/// Plain data. Value-initialised it is nowhere.
struct SkinPlace {
  /// A point on the skin, mm.
  Vec3 point = Vec3::Zero();
  /// Unit, towards the outside; of the triangle or smoothed, depending on the source.
  Vec3 normal = Vec3::UnitZ();
  /// kNoIndex where the source knows none.
  Index triangle = kNoIndex;
};

}  // namespace palpate
