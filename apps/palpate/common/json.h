// How the commands spell what they found in JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "palpate/base/vec.h"

namespace palpate::app {

/// [x, y, z]; mm for a place, unit length for a direction.
inline nlohmann::ordered_json vectorJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// null says that there is no such number, not that it is zero.
template <class Number>
nlohmann::ordered_json orNull(const std::optional<Number>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

}  // namespace palpate::app
