// Steps of 1, 2 and 5 times a power of ten, with slack for the rounding of logarithms.
#include "palpate/view/overlays/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/language.h"

namespace palpate::view {

namespace {

/// Forgives the rounding of logarithms and of multiples.
constexpr double kSlack = 1e-9;

}  // namespace

double roundStepUp(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - kSlack)) return factor * power;
  }
  return 10.0 * power;
}

double roundStepDown(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * power <= most * (1.0 + kSlack)) return factor * power;
  }
  return power;
}

std::vector<double> roundMarks(double low, double high, int most) {
  if (!(high > low)) return {low};
  for (double step = roundStepUp((high - low) / most);; step = roundStepUp(step * 1.5)) {
    const double first = std::ceil(low / step - kSlack);
    const double last = std::floor(high / step + kSlack);
    const int count = static_cast<int>(last - first) + 1;
    if (count > most) continue;
    if (count < 2) return {low, high};
    std::vector<double> marks;
    for (int i = 0; i < count; ++i) marks.push_back((first + i) * step);
    return marks;
  }
}

std::string markText(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - kSlack)), 0, 6);
  const double rounded = std::abs(value) < 0.5 * step * kSlack ? 0.0 : value;
  std::string text = fmt::format("{:.{}f}", WrittenNumber{rounded}, decimals);
  if (text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

}  // namespace palpate::view
