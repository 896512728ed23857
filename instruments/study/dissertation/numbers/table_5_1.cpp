// Three circles, by (5.7) as printed and by the engine. Based on: Ji, dissertation 2008, 5.2, with E28.
#include "dissertation/numbers/table_5_1.h"

#include <fmt/format.h>

#include "palpate/maps/gaussian_interpolation.h"
#include "palpate/maps/literal_interpolation.h"

namespace palpate::study {

std::vector<maps::KeyPoint> table51Keys() {
  std::vector<maps::KeyPoint> keys;
  for (const double y : kTable51Y) {
    maps::KeyPoint& key = keys.emplace_back();
    key.name = fmt::format("E{}", keys.size());
    key.position_mm = Vec2(0.0, y);
    key.ellipse.half_major_mm = kTable51HalfMajor;
  }
  return keys;
}

double naiveHalfMajor(const Vec2& place, double effect_radius_mm) {
  std::vector<double> levels;
  levels.reserve(kTable51Y.size());
  for (const double y : kTable51Y) levels.push_back(maps::effectLevel((place - Vec2(0.0, y)).norm(), effect_radius_mm));
  const std::vector<double> values(levels.size(), kTable51HalfMajor);
  return maps::literalBlend(maps::LiteralWeights::single_effects, levels, values, kTable51Basic)
      .value_or(kTable51Basic);
}

double exactHalfMajor(const Vec2& place, double effect_radius_mm) {
  maps::GaussianBlend<double> blend(kTable51Basic);
  for (const double y : kTable51Y) {
    blend.add(maps::effectLevel((place - Vec2(0.0, y)).norm(), effect_radius_mm), kTable51HalfMajor);
  }
  return blend.result();
}

}  // namespace palpate::study
