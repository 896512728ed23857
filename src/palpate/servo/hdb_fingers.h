// The detecting boxes of a rig's fingers, and how a rebuilt partition reaches them while the loop runs.
//
//   servo::BackgroundBuild ─ partition ─► makeHdbSurface ─► makeHdbFingers ─► Handover ─► next tick
//
// Everything that a tick needs is made beside the loop, also the room for its lists; the tick swaps one pointer, and
// what it puts down is freed beside the loop again.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "palpate/base/handover.h"
#include "palpate/hdb/hdb_finger.h"

namespace palpate::servo {

/// One box a finger of the rig, in its order.
using HdbFingers = std::vector<hdb::HdbCandidates>;

inline std::unique_ptr<HdbFingers> makeHdbFingers(const std::shared_ptr<const hdb::HdbSurface>& surface,
                                                  std::size_t fingers) {
  auto boxes = std::make_unique<HdbFingers>();
  boxes->reserve(fingers);
  for (std::size_t i = 0; i < fingers; ++i) boxes->emplace_back(surface);
  return boxes;
}

}  // namespace palpate::servo
