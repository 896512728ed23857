// The picture of a run, and its strips: force, depth, lag and others over time, a panel each, and below them when a
// finger stuck or slipped and which status bits were set.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/charts/figure.h"
#include "report/plot/run_strip.h"

namespace palpate::app {

struct ForcesPlot {
  std::string title;
  std::vector<Felt> felts = {Felt::force, Felt::depth, Felt::lag};
  bool states = true;  ///< the panel of states
};

/// One line per finger; the time axis covers all of them. `strips` must have a step at least.
figures::Figure forcesFigure(const ForcesPlot& plot, std::span<const RunStrip> strips);

/// Names of status bits: "at the border", "damped".
struct StatusName {
  std::uint32_t bit = 0;
  std::string_view name;
};
std::span<const StatusName> contactStatusNames();
std::span<const StatusName> safetyStatusNames();

}  // namespace palpate::app
