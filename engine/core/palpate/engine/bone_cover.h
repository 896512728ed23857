// Tissue left between the pressed skin and the bones: measured on the surface that is drawn and the bones that are
// drawn, after the fact.
//
// Knows nothing of layers or of how deep a press may go; it checks whether they keep their promise
// (docs/explanation/tissue.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::engine {

struct BoneCover {
  double least_mm = 0.0;   ///< from a vertex that moved to the nearest bone; below 0: it has sunk in
  Vec3 at = Vec3::Zero();  ///< the vertex now
  Index bone = kNoIndex;   ///< among the body's bones
};

class BoneCoverMeter {
 public:
  /// The world must outlive it.
  explicit BoneCoverMeter(const scene::World& world);
  BoneCoverMeter(const scene::World&&) = delete;

  /// Cover over all vertices that are not at rest; nothing on a body without bones or where none moved. Milliseconds.
  std::optional<BoneCover> of(const deform::DeformedSurface& surface) const;

 private:
  const scene::World& world_;
  std::optional<tree::TriangleTree> bones_;
  std::vector<Index> bone_of_triangle_;
};

/// "3.2 mm of tissue left over left rib 7"
std::string describe(const BoneCover& cover, const scene::World& world);

}  // namespace palpate::engine
