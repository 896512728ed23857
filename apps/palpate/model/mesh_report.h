// A validation report as a person reads it and as a script reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "palpate/mesh/validate.h"

namespace palpate::app {

std::string textOf(const mesh::ValidationReport& report);
nlohmann::ordered_json jsonOf(const mesh::ValidationReport& report);

}  // namespace palpate::app
