#include "palpate/training/psychometric.h"

#include <array>
#include <cmath>
#include <numbers>

namespace palpate::training {

namespace {

/// Numbers of places whose ideal observer is kept; others are computed on request.
constexpr int kKeptChoices = 40;

/// Where an observer whose d' grows with the change is right half of the time, guesses taken off, and how steep it is
/// around there.
struct IdealObserver {
  double d_prime = 0.0;  ///< at F = 1/2
  double slope = 0.0;    ///< slope of the Weibull that takes as long from F = 1/4 to 3/4
};

/// How often the place with `d_prime` feels strongest among `choices`, and the derivative.
struct RightAndRise {
  double right = 0.0;
  double rise = 0.0;
};

/// The integral of phi(x - d') Phi(x)^(choices - 1): the rule of equal steps is exact to rounding for such bells.
RightAndRise idealRight(double d_prime, int choices) {
  constexpr double kReach = 8.5;  // bell's half width, sd: its tail beyond is below 1e-16
  constexpr double kStep = 0.25;
  constexpr int kSteps = static_cast<int>(2.0 * kReach / kStep);
  RightAndRise sum;
  for (int i = 0; i <= kSteps; ++i) {
    const double from_centre = -kReach + kStep * i;
    const double bell = std::exp(-0.5 * from_centre * from_centre) * kStep / std::sqrt(2.0 * std::numbers::pi);
    const double others_below = std::pow(standardNormalBelow(d_prime + from_centre), choices - 1);
    sum.right += bell * others_below;
    sum.rise += bell * from_centre * others_below;
  }
  return sum;
}

/// d' at which F is `share`; Newton's way from `near`, on a curve that bends once.
double dPrimeAt(double share, int choices, double near) {
  const double guess = 1.0 / choices;
  const double wanted = guess + (1.0 - guess) * share;
  constexpr int kIterations = 8;
  double d_prime = near;
  for (int i = 0; i < kIterations; ++i) {
    const RightAndRise at = idealRight(d_prime, choices);
    d_prime -= (at.right - wanted) / at.rise;
  }
  return d_prime;
}

IdealObserver computeIdeal(int choices) {
  const double half = dPrimeAt(0.5, choices, 0.95 + 0.42 * std::log(0.5 * choices));
  const double quarter = dPrimeAt(0.25, choices, half);
  const double three_quarters = dPrimeAt(0.75, choices, half);
  // -ln(1 - F) grows by slope * ln(change ratio), in logarithms: from ln(4/3) to ln 4.
  const double weibull_rise = std::log(std::log(4.0) / std::log(4.0 / 3.0));
  return {half, weibull_rise / std::log(three_quarters / quarter)};
}

IdealObserver idealAmong(int choices) {
  static const std::array<IdealObserver, kKeptChoices + 1> kept = [] {
    std::array<IdealObserver, kKeptChoices + 1> all{};
    for (int i = 2; i <= kKeptChoices; ++i) all[static_cast<std::size_t>(i)] = computeIdeal(i);
    return all;
  }();
  return choices <= kKeptChoices ? kept[static_cast<std::size_t>(choices)] : computeIdeal(choices);
}

}  // namespace

double standardNormalBelow(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double standardNormalQuantile(double share) {
  double low = -8.0;
  double high = 8.0;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (standardNormalBelow(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double probabilityCorrect(const Psychometric& function, double change) {
  if (!(change > 0.0)) return function.guess;
  const double felt =
      1.0 - std::exp(-std::numbers::ln2 * std::exp(function.slope * std::log(change / function.threshold)));
  return function.guess + (1.0 - function.guess - function.lapse) * felt;
}

double idealSlope(int choices) { return idealAmong(choices).slope; }

double thresholdFactor(int choices, int reference) {
  return idealAmong(choices).d_prime / idealAmong(reference).d_prime;
}

}  // namespace palpate::training
