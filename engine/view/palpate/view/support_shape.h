// The support of a body that lies or sits: a padded slab with soft edges, as wide as a palpation table, or a stool's
// seat. Plain data; no GL.
#pragma once

#include <optional>
#include <vector>

#include "palpate/scene/world.h"

namespace palpate::view {

/// A rounded rectangle in the plane of its top, and how thick it is.
struct SupportSlab {
  Vec3 middle;  ///< middle of the top, mm; a fraction of a mm outside the body
  Vec3 up;      ///< unit, towards the body
  Vec3 along;   ///< unit
  Vec2 half;    ///< half its extent across and along
  double corner_mm = 0.0;
  double edge_mm = 0.0;  ///< radius of the rounded edge
  double thickness_mm = 0.0;

  Vec3 across() const { return along.cross(up); }
  Eigen::AlignedBox3d box() const;
};

/// Empty for a body that neither lies nor sits.
std::optional<SupportSlab> supportSlab(const scene::World& world);

struct SupportVertex {
  Vec3f place;
  Vec3f normal;
  float sky;  ///< share that the body leaves: 1 all, 0 nothing
};

struct SupportShape {
  std::vector<SupportVertex> vertices;
  std::vector<Triangle> triangles;
};

/// Closed, outward. Load time: some hundredths of a second, for the shade below the body.
SupportShape supportShape(const SupportSlab& slab, const scene::World& world);

}  // namespace palpate::view
