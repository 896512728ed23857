// Steps of 1, 2 or 5 times a power of ten, the largest number of ticks that an axis has room for.
//
// Based on: Heckbert, "Nice numbers for graph labels", Graphics Gems, 1990.
#include "report/charts/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/language.h"

namespace palpate::figures {

namespace {

constexpr std::array kNice{1.0, 2.0, 5.0};
// Share of a step by which a number may miss a tick through rounding.
constexpr double kSlack = 1e-9;

std::vector<Tick> linearTicks(const Range& range, int most) {
  const double step = niceStep(range.to - range.from, most);
  const double first = std::ceil(range.from / step - kSlack);
  const double last = std::floor(range.to / step + kSlack);
  std::vector<Tick> ticks;
  for (double i = first; i <= last; ++i) ticks.push_back({i * step, tickText(i * step, step)});
  return ticks;
}

// Numbers 1, 2 and 5 times a power of ten within the range, or the powers alone.
std::vector<double> logarithmicPlaces(const Range& range, bool powers_only) {
  std::vector<double> places;
  const int last = static_cast<int>(std::ceil(std::log10(range.to)));
  for (int power = static_cast<int>(std::floor(std::log10(range.from))); power <= last; ++power) {
    for (const double factor : kNice) {
      const double place = factor * std::pow(10.0, power);
      const bool inside = place >= range.from * (1.0 - kSlack) && place <= range.to * (1.0 + kSlack);
      if (inside && (!powers_only || factor == 1.0)) places.push_back(place);
    }
  }
  return places;
}

std::vector<Tick> logarithmicTicks(const Range& range, int most) {
  std::vector<double> places = logarithmicPlaces(range, false);
  if (places.size() > static_cast<std::size_t>(most)) places = logarithmicPlaces(range, true);
  const std::size_t stride = std::max<std::size_t>(1, (places.size() + most - 1) / static_cast<std::size_t>(most));
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < places.size(); i += stride) ticks.push_back({places[i], tickText(places[i], places[i])});
  return ticks;
}

Range logarithmicRange(const Range& data) {
  const double below = std::pow(10.0, std::floor(std::log10(data.from)));
  const double above = std::pow(10.0, std::floor(std::log10(data.to)));
  Range range{below, above};
  for (const double factor : kNice) {
    if (factor * below <= data.from * (1.0 + kSlack)) range.from = factor * below;
  }
  for (const double factor : {10.0, 5.0, 2.0, 1.0}) {
    if (factor * above >= data.to * (1.0 - kSlack)) range.to = factor * above;
  }
  if (range.from == range.to) range.to *= 10.0;
  return range;
}

}  // namespace

double niceStep(double length, int most) {
  const double wanted = length / std::max(most, 1);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : kNice) {
    if (factor * power >= wanted * (1.0 - kSlack)) return factor * power;
  }
  return 10.0 * power;
}

Range niceRange(const Range& data, Scale scale, int most) {
  if (scale == Scale::logarithmic) return logarithmicRange(data);
  if (data.from == data.to) {
    const double room = data.from == 0.0 ? 1.0 : 0.5 * std::abs(data.from);
    return {data.from - room, data.to + room};
  }
  const double step = niceStep(data.to - data.from, most);
  return {step * std::floor(data.from / step + kSlack), step * std::ceil(data.to / step - kSlack)};
}

std::vector<Tick> niceTicks(const Range& range, Scale scale, int most) {
  return scale == Scale::logarithmic ? logarithmicTicks(range, most) : linearTicks(range, most);
}

std::string tickText(double value, double step) {
  if (value == 0.0 || std::abs(value) < kSlack * step) return "0";
  const bool long_digits = std::abs(value) >= 1e7 || step < 1e-4;
  if (long_digits) return fmt::format("{:g}", WrittenNumber{value});
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + kSlack)));
  return fmt::format("{:.{}f}", WrittenNumber{value}, decimals);
}

}  // namespace palpate::figures
