#include "palpate/training/group_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "palpate/training/psychometric.h"

namespace palpate::training {

namespace {

/// A group of people who are all alike has no narrower spread than this, in ln T: the steps below stay finite.
constexpr double kMinSpread = 0.03;
constexpr int kMaxSteps = 400;
constexpr double kSettled = 1e-7;  ///< step in ln T below which the fit has settled

/// A normal of ln T, fitted to likelihoods.
struct FittedNormal {
  double mean = 0.0;
  double sd = 0.3;
  double error_of_mean = 0.0;
};

/// Mean and variance of one person's ln T under the normal.
struct MeanAndVariance {
  double mean = 0.0;
  double variance = 0.0;
};

/// Shares of a normal in the cells around the places: right however narrow it is.
std::vector<double> computeCellShares(const FittedNormal& normal, const std::vector<double>& places) {
  const double cell = places[1] - places[0];
  std::vector<double> shares;
  shares.reserve(places.size());
  double below = standardNormalBelow((places.front() - 0.5 * cell - normal.mean) / normal.sd);
  for (const double place : places) {
    const double up_to = standardNormalBelow((place + 0.5 * cell - normal.mean) / normal.sd);
    shares.push_back(up_to - below);
    below = up_to;
  }
  return shares;
}

MeanAndVariance personUnder(const std::vector<double>& shares, const ThresholdLikelihood& told) {
  double all = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double weight = shares[i] * told.values[i];
    all += weight;
    first += weight * told.places[i];
    second += weight * told.places[i] * told.places[i];
  }
  if (!(all > 0.0)) return {};
  const double mean = first / all;
  return {mean, std::max(0.0, second / all - mean * mean)};
}

FittedNormal fitNormal(std::span<const ThresholdLikelihood> people) {
  const auto size = static_cast<double>(people.size());
  FittedNormal normal;
  for (const ThresholdLikelihood& person : people) {
    const auto most = std::max_element(person.values.begin(), person.values.end()) - person.values.begin();
    normal.mean += person.places[static_cast<std::size_t>(most)] / size;
  }
  double information = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const std::vector<double> shares = computeCellShares(normal, people.front().places);
    double mean = 0.0;
    double missing = 0.0;
    std::vector<MeanAndVariance> each;
    each.reserve(people.size());
    for (const ThresholdLikelihood& person : people) {
      each.push_back(personUnder(shares, person));
      mean += each.back().mean / size;
      missing += each.back().variance;
    }
    double variance = missing / size;
    for (const MeanAndVariance& person : each) variance += (person.mean - mean) * (person.mean - mean) / size;
    const double before = normal.sd * normal.sd;
    information = std::max(size / before - missing / (before * before), 1e-3 * size / before);
    const double sd = std::max(std::sqrt(variance), kMinSpread);
    const double moved = std::abs(mean - normal.mean) + std::abs(sd - normal.sd);
    normal.mean = mean;
    normal.sd = sd;
    if (moved < kSettled) break;
  }
  // The fitted spread leaves one degree of freedom out.
  normal.error_of_mean = std::sqrt(size / (size - 1.0) / information);
  return normal;
}

}  // namespace

double student95(int degrees_of_freedom) {
  const double z = 1.959963985;  // quantile of a normal
  const double n = degrees_of_freedom;
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  const double z7 = z5 * z * z;
  return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n) +
         (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n) +
         (79.0 * z7 * z * z + 776.0 * z7 + 1482.0 * z5 - 1920.0 * z3 - 945.0 * z) / (92160.0 * n * n * n * n);
}

GroupEstimate groupThreshold(std::span<const ThresholdLikelihood> people) {
  GroupEstimate group{.people = static_cast<int>(people.size())};
  if (people.size() < 2) return group;
  const FittedNormal normal = fitNormal(people);
  group.mean_ln = normal.mean;
  group.error_of_mean_ln = normal.error_of_mean;
  group.sd_ln = normal.sd;
  const double variance = normal.sd * normal.sd;
  group.mean = std::exp(normal.mean + 0.5 * variance);
  group.sd = group.mean * std::sqrt(std::expm1(variance));
  // The mean of T depends on the spread too, which is known the worse the fewer people there are.
  const double error_squared = normal.error_of_mean * normal.error_of_mean;
  const double error = std::sqrt(error_squared * (1.0 + 0.5 * variance));
  const double reach = student95(group.people - 1) * error;
  group.low = group.mean * std::exp(-reach);
  group.high = group.mean * std::exp(reach);
  return group;
}

GroupChange groupChange(std::span<const ThresholdLikelihood> people) {
  GroupChange change{.people = static_cast<int>(people.size())};
  if (people.size() < 2) return change;
  const FittedNormal normal = fitNormal(people);
  const double reach = student95(change.people - 1) * normal.error_of_mean;
  change.factor = std::exp(-normal.mean);
  change.low = std::exp(-normal.mean - reach);
  change.high = std::exp(-normal.mean + reach);
  change.sd_ln = normal.sd;
  return change;
}

}  // namespace palpate::training
