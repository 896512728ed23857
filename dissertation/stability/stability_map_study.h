// `palpate study stability --map`: what the product allows at every rate and delay, and what random systems do there.
#pragma once

#include <vector>

#include "lab/loops/stability_map.h"
#include "report/page/study_page.h"

namespace palpate::study {

/// Of all cells, and of those where a session may start.
struct StabilityMapTotals {
  std::size_t cells = 0;
  std::size_t allowed = 0;
  std::size_t oscillates_bare = 0;
  std::size_t oscillates_controlled = 0;
  std::size_t controlled_above_bare = 0;  ///< cells
  std::size_t oscillates_allowed = 0;     ///< controlled
  double port_energy_allowed_mj_max = 0.0;
};

StabilityMapTotals totalsOf(const std::vector<lab::StabilityCell>& cells);

StudyPage stabilityMapPage(const lab::StabilityMapPlan& plan, const std::vector<lab::StabilityCell>& cells);

/// Quick: two rates, three delays, two systems a cell.
StudyPage studyStabilityMap(const StudySettings& settings);

}  // namespace palpate::study
