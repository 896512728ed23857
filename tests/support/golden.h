// Golden files: numbers worked out by an independent reference, never by this code (tests/data/golden; each file
// carries a note with its conventions).
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "palpate/base/vec.h"
#include "support/places.h"

namespace palpate::test {

/// The file tests/data/golden/<name>.json.
inline nlohmann::json golden(const std::string& name) {
  std::ifstream file(support::testData() / "golden" / (name + ".json"));
  if (!file) throw std::runtime_error("golden file missing: " + name);
  return nlohmann::json::parse(file);
}

/// The list `key` of the file, by value: `golden(name)[key]` in a range-for would be a list that is gone before the
/// first round, and the test would check nothing. Throws if the list is missing or empty.
inline nlohmann::json goldenRows(const std::string& name, const std::string& key) {
  nlohmann::json rows = golden(name).at(key);
  if (!rows.is_array() || rows.empty()) throw std::runtime_error("golden list empty: " + name + " " + key);
  return rows;
}

inline Vec2 vec2(const nlohmann::json& v) { return {v.at(0).get<double>(), v.at(1).get<double>()}; }
inline Vec3 vec3(const nlohmann::json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

}  // namespace palpate::test
