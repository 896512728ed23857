// How a finger of the HDB source looks for the triangles that it may touch (hdb_candidates.h).
#pragma once

#include <cstdint>
#include <optional>

#include "palpate/base/vec.h"
#include "palpate/partition/literal_traversal.h"

namespace palpate::contact {

/// What the detecting box gives.
enum class HdbQuery : std::uint8_t {
  leaves,     ///< all triangles of the leaves that it meets: the dissertation's haptic process
  triangles,  ///< the triangles that it meets
  coherent    ///< those and some from a margin, listed anew only when the box leaves the margin (future work 4)
};

struct HdbSettings {
  Vec3 edges_mm = Vec3::Zero();  ///< of the detecting box
  HdbQuery query = HdbQuery::leaves;
  std::optional<partition::LiteralTraversal> literal;  ///< for HdbQuery::leaves only
  /// Ticks that the box stays where it is before it follows the proxy; the dissertation's box moved once a frame of the
  /// haptic scene, some 20 to 100 ticks.
  std::uint32_t ticks_per_refresh = 1;
};

}  // namespace palpate::contact
