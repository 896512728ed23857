// A finger whose haptic detecting box follows late, and how often it gets through the skin (3.3.3, E12).
//
//   stroke ─► stepHdb, tick by tick ─► a tick without contact is judged by the height of the skin above its tip
#pragma once

#include <memory>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/hdb/hdb_candidates.h"

namespace palpate::study {

struct LateBoxResult {
  int strokes = 0;
  int punctured = 0;         ///< strokes in which the tip was inside the body and nothing held it
  double mean_listed = 0.0;  ///< triangles in the box's list, of the ticks in contact

  double puncturedShare() const { return strokes > 0 ? static_cast<double>(punctured) / strokes : 0.0; }
};

/// Every stroke starts with a new finger and ends at its puncture. `box` says how large the box is and after how many
/// ticks it follows; the phase differs from stroke to stroke.
LateBoxResult strokeWithLateBox(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                                const std::vector<std::vector<Vec3>>& strokes,
                                const contact::FingerSettings& finger = {});

}  // namespace palpate::study
