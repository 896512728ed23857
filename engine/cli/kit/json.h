// Common JSON of the commands.
#pragma once

#include <optional>
#include <string>

#include "palpate/base/json.h"
#include "palpate/base/vec.h"
#include "palpate/servo/histogram.h"

namespace palpate::app {

/// For people and programs, with a line end. Text of a user's file that is not UTF-8 gets U+FFFD; plain dump throws.
inline std::string jsonText(const Json& json) { return jsonDump(json, 2) + "\n"; }

/// [x, y, z]; mm for a place, unit length for a direction.
inline Json vectorJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// null: the number does not exist, which is not the same as 0.
template <class Number>
Json orNull(const std::optional<Number>& number) {
  return number ? Json(*number) : Json(nullptr);
}

/// Makes a JSON list by applying `make` to each item.
template <class List, class Make>
Json listJson(const List& list, const Make& make) {
  Json json = Json::array();
  for (const auto& each : list) json.push_back(Json(make(each)));
  return json;
}

/// {p50, p99, p99_9, max}, us.
inline Json percentilesJson(const servo::DurationPercentiles& p) {
  return {{"p50", p.p50_us}, {"p99", p.p99_us}, {"p99_9", p.p99_9_us}, {"max", p.max_us}};
}

}  // namespace palpate::app
