// White noise on a lattice, blurred by a Gaussian: at each place the sum over the lattice points around it, divided by
// the root of the sum of the squared weights, which makes the variance 1 everywhere. Noise blurred by exp(-2 (r / L)^2)
// correlates as exp(-(r / L)^2). A lattice of 2/3 L is fine enough that it is not seen: the sum of squared weights
// ripples by 1 %, and that is divided out.
//
// The noise of a lattice point comes from its integer place and the seed by whole numbers alone, the same on every
// machine. Built once a world, some 1 us a vertex.
//
// Based on: process convolution (Higdon 1998) for the field; Vigna's splitmix64 for the noise.
#include "palpate/maps/natural_variation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/random.h"

namespace palpate::maps {

namespace {

/// Lattice points an axis that reach a place; the weight of the next one is exp(-8).
constexpr int kReach = 6;
/// Lattice points before the one just below the place.
constexpr int kBefore = kReach / 2 - 1;
constexpr double kStepOfLength = 2.0 / 3.0;

/// A deviation farther out than this many standard deviations, one place in 400, counts as this one.
constexpr double kFarthest = 3.0;

/// Mean 0, variance 1, within +-3.5: four uniform numbers of 16 bits.
double noiseAt(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) noexcept {
  const auto mixed = [](std::uint64_t before, std::int64_t number) {
    return Random(before ^ static_cast<std::uint64_t>(number)).bits();
  };
  const std::uint64_t bits = mixed(mixed(mixed(seed, x), y), z);
  std::uint64_t sum = 0;
  for (int shift = 0; shift < 64; shift += 16) sum += (bits >> shift) & 0xffffu;
  constexpr double kMean = 2.0 * 65535.0;
  constexpr double kDeviation = 37837.22;  // sqrt(4 (65536^2 - 1) / 12)
  return (static_cast<double>(sum) - kMean) / kDeviation;
}

/// The first lattice point that reaches a place along one axis, and the weights from there on.
struct Axis {
  std::int64_t first = 0;
  std::array<double, kReach> weights{};
};

Axis axisAt(double place_steps) noexcept {
  constexpr double kRate = 2.0 * kStepOfLength * kStepOfLength;
  const double below = std::floor(place_steps);
  Axis axis;
  axis.first = static_cast<std::int64_t>(below) - kBefore;
  for (std::size_t i = 0; i < axis.weights.size(); ++i) {
    const double away = below - kBefore + static_cast<double>(i) - place_steps;
    axis.weights[i] = elementary::exp(-kRate * away * away);
  }
  return axis;
}

double squares(const Axis& axis) noexcept {
  double sum = 0.0;
  for (const double weight : axis.weights) sum += weight * weight;
  return sum;
}

/// Mean 0, variance 1.
double fieldAt(const Vec3& place_steps, std::uint64_t seed) noexcept {
  const std::array<Axis, 3> axes = {axisAt(place_steps.x()), axisAt(place_steps.y()), axisAt(place_steps.z())};
  double sum = 0.0;
  for (int x = 0; x < kReach; ++x) {
    for (int y = 0; y < kReach; ++y) {
      double row = 0.0;
      for (int z = 0; z < kReach; ++z) {
        row += axes[2].weights[static_cast<std::size_t>(z)] *
               noiseAt(seed, axes[0].first + x, axes[1].first + y, axes[2].first + z);
      }
      sum += axes[0].weights[static_cast<std::size_t>(x)] * axes[1].weights[static_cast<std::size_t>(y)] * row;
    }
  }
  return sum / std::sqrt(squares(axes[0]) * squares(axes[1]) * squares(axes[2]));
}

}  // namespace

std::vector<double> variationAt(std::span<const Vec3> places_mm, const NaturalVariation& variation) {
  std::vector<double> factors(places_mm.size(), 1.0);
  if (!(variation.variation > 0.0)) return factors;
  const double steps_per_mm = 1.0 / (kStepOfLength * variation.length_mm);
  const std::uint64_t seed = Random(variation.seed).bits();
  // For a log-normal number of mean 1: its logarithm's variance, and half of that off its mean.
  const double variance = elementary::log1p(variation.variation * variation.variation);
  const double deviation = std::sqrt(variance);
  for (std::size_t i = 0; i < places_mm.size(); ++i) {
    const double field = std::clamp(fieldAt(steps_per_mm * places_mm[i], seed), -kFarthest, kFarthest);
    factors[i] = elementary::exp(deviation * field - 0.5 * variance);
  }
  return factors;
}

void applyVariation(std::span<const Vec3> positions, const NaturalVariation& variation,
                    std::span<double> stiffness_n_per_mm) {
  if (!(variation.variation > 0.0)) return;
  const std::vector<double> factors = variationAt(positions, variation);
  for (std::size_t i = 0; i < factors.size(); ++i) stiffness_n_per_mm[i] *= factors[i];
}

}  // namespace palpate::maps
