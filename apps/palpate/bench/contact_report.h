// What `palpate bench contact` prints of a run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/runs/contact_run.h"
#include "bench/runs/hdb_run.h"

namespace palpate::app {

nlohmann::ordered_json jsonOf(const bench::ContactFigures& figures);
std::string textOf(const bench::ContactFigures& figures);

/// With the detecting box's own figures.
nlohmann::ordered_json jsonOf(const bench::HdbFigures& figures);
std::string textOf(const bench::HdbFigures& figures);

}  // namespace palpate::app
