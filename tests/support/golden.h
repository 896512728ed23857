// Golden files: numbers worked out by an independent reference, never by this code (tests/data/golden; each file
// carries a note with its conventions).
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "palpate/base/vec.h"

namespace palpate::test {

/// The file tests/data/golden/<name>.json.
inline nlohmann::json golden(const std::string& name) {
  std::ifstream file(std::string(PALPATE_TEST_DATA) + "/golden/" + name + ".json");
  if (!file) throw std::runtime_error("golden file missing: " + name);
  return nlohmann::json::parse(file);
}

inline Vec2 vec2(const nlohmann::json& v) { return {v.at(0).get<double>(), v.at(1).get<double>()}; }
inline Vec3 vec3(const nlohmann::json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

}  // namespace palpate::test
