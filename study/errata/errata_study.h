// `palpate study errata`: what each erratum changes on a scene, in numbers.
//
// The scene runs once as it is (corrected) and once more for every other reading, with that reading alone; forces,
// proxies and deformed skins are compared tick by tick and picture by picture.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene.h"

namespace palpate::study {

struct ErratumEffect {
  scene::ErratumText text;
  std::string reading;    ///< what was set, as it stands in a scene file; empty: nothing to switch, nothing measured
  double force_n = 0.0;   ///< largest difference of a finger's force
  double proxy_mm = 0.0;  ///< largest difference of a proxy
  std::size_t lost_ticks = 0;  ///< ticks of a finger that touches in one of the two runs only
  /// Of the triangles that meet the detecting box, the most that its leaves lack at any picture; 0 without a partition.
  double missed_percent = 0.0;
  double skin_mm = 0.0;         ///< largest difference of a vertex
  double skin_rms_mm = 0.0;     ///< over all vertices that move in one of the two, all pictures together
  double strain_percent = 0.0;  ///< largest difference
  double moved_ratio = 1.0;     ///< moved vertices of this reading over those of the corrected one
};

/// The effect of every erratum, E1 first, and of all switches together as number 0 in front. Takes a few seconds a
/// row. Errata of the partition are measured with the contact source "hdb" (and point fingers) on both sides, in the
/// tree they speak of. Throws Error for a scene that cannot be built.
std::vector<ErratumEffect> studyErrata(const scene::Scene& scene, const Progress& progress = {});

}  // namespace palpate::study
