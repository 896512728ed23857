// A list of the triangles around the proxy that stays valid while the proxy moves a little: the dissertation's fourth
// piece of future work.
//
// The query is made for a box somewhat larger than the haptic detecting box, and made again only when the detecting box
// leaves it. In between a tick costs one comparison of boxes. The list always holds every triangle that the detecting
// box meets, and some more from the margin.
#pragma once

#include <cstdint>

#include "palpate/hdb/haptic_box.h"

namespace palpate::hdb {

/// Margin of the queried box beyond the detecting box on each side, as a share of its edge. An eighth makes the list
/// about half as long again on a surface; a finger at 200 mm/s with a box of 100 mm refreshes it 16 times a second.
inline constexpr double kCoherentMargin = 0.125;

struct CoherentList {
  TriangleHits hits;  ///< `hits.ranges` are the list
  Box3 covered;       ///< the queried box; empty before the first time
  std::uint64_t refreshes = 0;

  /// Room for any list of this partition; forgets the present one. Call it again for another partition.
  void prepareFor(const Partition& partition);
};

/// Makes the list hold what `box` meets. True when it had to be queried again. Allocates nothing after prepareFor.
bool follow(CoherentList& list, const Partition& partition, const Box3& box, double margin = kCoherentMargin) noexcept;

}  // namespace palpate::hdb
