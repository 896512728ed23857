// Prediction of a site from its neighbours: a plane, or with many neighbours a bent surface, through their values.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::measure {

struct Neighbour {
  Vec2 offset = Vec2::Zero();  ///< sites from the predicted one
  Vec2 value = Vec2::Zero();
};

struct Trend {
  Vec2 value = Vec2::Zero();  ///< at the site
  Mat2 slope = Mat2::Zero();  ///< d value / d site
};

/// None where the neighbours lie in one line. From `bent_from` neighbours on it is quadratic.
std::optional<Trend> fitTrend(const std::vector<Neighbour>& neighbours, std::size_t bent_from = 12);

}  // namespace palpate::measure
