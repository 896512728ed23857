// Section, steps and turns are taken at eight phases of the vertices: a step of the array may fall between them.
// Look-ups are timed on scattered ratios that stay in the first cache with the array. Based on: see array_quality.h.
#include "dissertation/profile/array_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/vec.h"
#include "palpate/tissue/profile.h"

namespace palpate::study {

tissue::ProfileCurve arrayProfile(int entries, tissue::TableLookup lookup) {
  tissue::ProfileSettings settings;
  settings.kind = tissue::ProfileKind::table;
  settings.rim = tissue::ProfileRim::step;
  settings.table_entries = static_cast<std::size_t>(entries);
  settings.lookup = lookup;
  return tissue::ProfileCurve(settings);
}

tissue::ProfileCurve closedProfile() {
  tissue::ProfileSettings settings;
  settings.rim = tissue::ProfileRim::step;
  return tissue::ProfileCurve(settings);
}

double worstArrayError(int entries, tissue::TableLookup lookup) {
  constexpr double kDepth = 10.0;  // mm, (4.15)
  constexpr int kSamples = 100'000;
  const tissue::ProfileCurve array = arrayProfile(entries, lookup);
  const tissue::ProfileCurve curve = closedProfile();
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double q = static_cast<double>(i) / kSamples;
    worst = std::max(worst, std::abs(array.at(q).value - curve.at(q).value));
  }
  return kDepth * worst;
}

namespace {

// Where the vertices are relative to the finger, as shares of their spacing: steps of an array may fall between them.
constexpr int kPhases = 8;

std::vector<double> heights(const tissue::ProfileCurve& curve, const SkinSection& section, double phase) {
  std::vector<double> z;
  for (double r = phase * section.spacing_mm; r < section.radius_mm; r += section.spacing_mm) {
    z.push_back(-section.depth_mm * curve.at(r / section.radius_mm).value);
  }
  return z;
}

// The surface turns by this much at vertex i.
double turnDeg(const std::vector<double>& z, std::size_t i, double spacing_mm) {
  return kDegPerRad * (std::atan2(z[i + 1] - z[i], spacing_mm) - std::atan2(z[i] - z[i - 1], spacing_mm));
}

// Excess of `z` over the curve's own `exact`.
void collectWorst(const std::vector<double>& z, const std::vector<double>& exact, double spacing_mm,
                  ArrayQuality& worst) {
  for (std::size_t i = 1; i + 1 < z.size(); ++i) {
    const double step = (z[i + 1] - z[i]) - (exact[i + 1] - exact[i]);
    worst.step_mm = std::max(worst.step_mm, std::abs(step));
    worst.second_difference_mm = std::max(worst.second_difference_mm, std::abs(z[i + 1] - 2.0 * z[i] + z[i - 1]));
    worst.turn_deg = std::max(worst.turn_deg, std::abs(turnDeg(z, i, spacing_mm) - turnDeg(exact, i, spacing_mm)));
  }
}

std::vector<double> storedCurve(int entries) {
  std::vector<double> table;
  for (int i = 0; i < entries; ++i) table.push_back(halfGaussian(i / (entries - 1.0)));
  return table;
}

// The fastest of several runs over the same scattered ratios.
template <class Curve>
double bestNanoseconds(const Curve& curve, bool quick) {
  constexpr std::size_t kRatios = 4096;  // 32 kB, with the array in the first level cache
  const int passes = quick ? 2 : 50;
  const int runs = quick ? 2 : 9;
  Random random(4);
  std::vector<double> ratios(kRatios);
  for (double& q : ratios) q = random.uniform();
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    double sum = 0.0;
    const auto start = Clock::now();
    for (int pass = 0; pass < passes; ++pass) {
      for (const double q : ratios) sum += curve(q);
    }
    const double spent_ns = nanosecondsSince(start);
    volatile double keep = sum;  // the work must not be left out
    static_cast<void>(keep);
    best = std::min(best, spent_ns / static_cast<double>(passes * ratios.size()));
  }
  return best;
}

}  // namespace

ArrayQuality arrayQuality(int entries, tissue::TableLookup lookup, const SkinSection& section) {
  const tissue::ProfileCurve array = arrayProfile(entries, lookup);
  const tissue::ProfileCurve curve = closedProfile();
  ArrayQuality worst{.entries = entries, .error_mm = section.depth_mm / 10.0 * worstArrayError(entries, lookup)};
  for (int phase = 0; phase < kPhases; ++phase) {
    const double shift = static_cast<double>(phase) / kPhases;
    collectWorst(heights(array, section, shift), heights(curve, section, shift), section.spacing_mm, worst);
  }
  return worst;
}

ArrayQuality curveQuality(const SkinSection& section) {
  const std::vector<double> z = heights(closedProfile(), section, 0.0);
  ArrayQuality own;
  collectWorst(z, std::vector<double>(z.size(), 0.0), section.spacing_mm, own);
  own.step_mm = 0.0;
  return own;
}

double convergenceSlope(std::span<const ArrayQuality> sweep) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(sweep.size());
  for (const ArrayQuality& one : sweep) {
    const double log_entries = std::log(one.entries);
    const double log_error = std::log(one.error_mm);
    x += log_entries / n;
    y += log_error / n;
    xx += log_entries * log_entries / n;
    xy += log_entries * log_error / n;
  }
  return (xy - x * y) / (xx - x * x);
}

double lookupNanoseconds(int entries, tissue::TableLookup lookup, bool quick) {
  const std::vector<double> table = storedCurve(entries);
  const double last = entries - 1.0;
  if (lookup == tissue::TableLookup::nearest) {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): q >= 0, and std::lround must not be timed
    return bestNanoseconds([&](double q) { return table[static_cast<std::size_t>(last * q + 0.5)]; }, quick);
  }
  return bestNanoseconds(
      [&](double q) {
        const double place = last * q;
        const auto i = static_cast<std::size_t>(place);
        return table[i] + (place - static_cast<double>(i)) * (table[i + 1] - table[i]);
      },
      quick);
}

double closedFormNanoseconds(bool quick) {
  return bestNanoseconds([](double q) { return tissue::profile(q); }, quick);
}

}  // namespace palpate::study
