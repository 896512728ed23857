// The dissertation's own forms of Gaussian radial interpolation, kept to reproduce its results; the engine's is
// gaussian_interpolation.h.
//
// All of them blend the single effects V_i = base (1 - a_i) + v_i a_i of (5.4) with weights that are a fraction of two
// sums over the effect levels a_i. They differ in the numerators:
//   single_effects    a_i                            (5.7): misses the keys, the text's Fig 5.9
//   products          a_i prod_{j != i} (1 - a_j)    (5.16) with E26: exact at every key, Fig 5.10
//   printed_products  a_i prod_{j != 1} (1 - a_j)    (5.16) as printed: the weights do not sum to 1, and at every key
//                                                    but the first the result is 0
// Where the denominator is 0 the fraction has no value (E27): empty. Products cost O(n^2).
// Based on: Ji, dissertation 2008, section 5.2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "palpate/base/gaussian.h"

namespace palpate::maps {

enum class LiteralWeights : std::uint8_t { single_effects, products, printed_products };

/// Effect level from the text's table of 700 entries, the nearest one: entry i is exp(-pi (1.4 i / 699)^2).
/// Within 1/1398 of the effect radius of a key the level is 1, so two keys may both claim the place (E27).
inline double tabulatedEffectLevel(double distance_mm, double effect_radius_mm) {
  constexpr double kLastEntry = 699.0;
  if (distance_mm == 0.0) return 1.0;
  if (!(distance_mm <= effect_radius_mm)) return 0.0;
  return halfGaussian(std::round(distance_mm / effect_radius_mm * kLastEntry) / kLastEntry);
}

/// The factor of key point `i`; `level(j)` gives a_j.
template <class Level>
double literalNumerator(LiteralWeights form, std::size_t i, std::size_t keys, const Level& level) {
  double numerator = level(i);
  if (form == LiteralWeights::single_effects) return numerator;
  const std::size_t omitted = form == LiteralWeights::products ? i : 0;  // E26: printed j != 1
  for (std::size_t j = 0; j < keys && numerator != 0.0; ++j) {
    if (j != omitted) numerator *= 1.0 - level(j);
  }
  return numerator;
}

/// The denominators are printed right.
template <class Level>
double literalDenominator(LiteralWeights form, std::size_t keys, const Level& level) {
  const LiteralWeights right = form == LiteralWeights::single_effects ? form : LiteralWeights::products;
  double sum = 0.0;
  for (std::size_t k = 0; k < keys; ++k) sum += literalNumerator(right, k, keys, level);
  return sum;
}

/// The blend at a place; `level(i)` in [0, 1] and `value(i)` are called for the key points 0 to keys - 1. Value is
/// double or a fixed-size vector. Empty where the printed fraction is 0/0: out of all reach, on coincident keys, and
/// where the product of many (1 - a_j) falls below the smallest double.
template <class Value, class Level, class KeyValue>
std::optional<Value> literalBlend(LiteralWeights form, std::size_t keys, const Level& level, const KeyValue& value,
                                  const Value& base) {
  const double denominator = literalDenominator(form, keys, level);
  if (!(denominator > 0.0)) return std::nullopt;
  Value sum = base * 0.0;
  for (std::size_t i = 0; i < keys; ++i) {
    const double weight = literalNumerator(form, i, keys, level) / denominator;
    if (weight > 0.0) sum += weight * Value(base * (1.0 - level(i)) + value(i) * level(i));
  }
  return sum;
}

/// The same for lists of levels and values, as many of the one as of the other.
inline std::optional<double> literalBlend(LiteralWeights form, std::span<const double> levels,
                                          std::span<const double> values, double base) {
  const std::size_t keys = std::min(levels.size(), values.size());
  return literalBlend<double>(
      form, keys, [&](std::size_t i) { return levels[i]; }, [&](std::size_t i) { return values[i]; }, base);
}

}  // namespace palpate::maps
