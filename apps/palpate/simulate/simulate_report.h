// What a simulation tells its user: a summary for people, the same as JSON for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/palpate/simulate/simulation.h"

namespace palpate::app {

/// Keys carry their units; docs/simulate.md lists them.
nlohmann::ordered_json reportOf(const SimulationResult& result);

/// Some twenty lines, fit for a terminal of 100 columns.
std::string summaryOf(const SimulationResult& result);

}  // namespace palpate::app
