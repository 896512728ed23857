// The contact radius grows as the root of the depth, so that is what it runs straight over.
#include "palpate/tissue/pressure_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/vec.h"

namespace palpate::tissue {

namespace {

constexpr double kMnPerN = 1e3;
/// The fingertip ends at its equator.
constexpr double kWidestShare = 0.99;

PressurePattern mixed(const PressurePattern& a, const PressurePattern& b, double share) noexcept {
  return {a.contact_radius_mm + share * (b.contact_radius_mm - a.contact_radius_mm),
          a.exponent + share * (b.exponent - a.exponent)};
}

std::vector<double> squareRoots(std::span<const double> depths_mm) {
  std::vector<double> roots;
  for (const double depth : depths_mm) roots.push_back(std::sqrt(depth));
  return roots;
}

/// Patterns at increasing depths, given by their roots; from no radius at no depth, and constant beyond the last.
PressurePattern patternAt(std::span<const double> roots, std::span<const PressurePattern> patterns,
                          double depth_mm) noexcept {
  if (!(depth_mm > 0.0)) return {};
  const double root = std::sqrt(depth_mm);
  if (root >= roots.back()) return patterns.back();
  const auto after = static_cast<std::size_t>(std::upper_bound(roots.begin(), roots.end(), root) - roots.begin());
  if (after == 0) return mixed({0.0, patterns[0].exponent}, patterns[0], root / roots[0]);
  const double from = roots[after - 1];
  return mixed(patterns[after - 1], patterns[after], (root - from) / (roots[after] - from));
}

}  // namespace

PressureForm::PressureForm(std::span<const WeightedField> fields, double indenter_radius_mm)
    : indenter_radius_mm_(indenter_radius_mm) {
  if (fields.empty()) throw Error("pressure: the press field is missing");
  const auto longest =
      std::ranges::max_element(fields, {}, [](const WeightedField& one) { return one.field->depths_mm.back(); });
  roots_ = squareRoots(longest->field->depths_mm);
  for (const double depth : longest->field->depths_mm) {
    PressurePattern& sum = patterns_.emplace_back();
    for (const WeightedField& one : fields) {
      const PressurePattern pattern = patternAt(squareRoots(one.field->depths_mm), one.field->patterns, depth);
      sum.contact_radius_mm += one.share * pattern.contact_radius_mm;
      sum.exponent += one.share * pattern.exponent;
    }
  }
}

PressurePattern PressureForm::at(double depth_mm, double finger_mm) const noexcept {
  PressurePattern pattern = patternAt(roots_, patterns_, depth_mm);
  pattern.contact_radius_mm =
      std::min(pattern.contact_radius_mm * std::sqrt(finger_mm / indenter_radius_mm_), kWidestShare * finger_mm);
  return pattern;
}

namespace {

/// A ball needs no cube root, which would be a tenth of what a bump costs.
double radiusOf(const LumpShape& lump) noexcept {
  const auto& [across, other, into] = lump.half_axes_mm;
  return across == other && across == into ? across : lump.radiusMm();
}

}  // namespace

PressurePattern overLumps(PressurePattern pattern, double widening) noexcept {
  constexpr double kWidening = 0.1;
  constexpr double kMax = 0.3;
  pattern.contact_radius_mm *= 1.0 + kWidening * std::clamp(widening, 0.0, kMax);
  return pattern;
}

double wideningOf(const LumpShape& lump, double skin_mm) noexcept {
  constexpr double kFromMm = 5.0;
  const double radius_mm = radiusOf(lump);
  if (!(radius_mm > kFromMm)) return 0.0;
  const double large = std::min((radius_mm - kFromMm) / 3.0, 1.0);
  const double deep = std::clamp((lump.depth_mm - skin_mm - 1.0) / 3.0, 0.0, 1.0);
  return large * deep;
}

double pressureAt(const PressurePattern& pattern, double force_n, double radius_mm) noexcept {
  const double share = radius_mm / pattern.contact_radius_mm;
  if (!(share < 1.0)) return 0.0;
  const double middle = kMnPerN * force_n * (pattern.exponent + 1.0) /
                        (std::numbers::pi * pattern.contact_radius_mm * pattern.contact_radius_mm);
  return middle * elementary::pow(1.0 - share * share, pattern.exponent);
}

double bumpWidth(const LumpShape& lump, double skin_mm, double depth_mm) noexcept {
  return std::max(0.8, 0.66 + 0.78 * radiusOf(lump) + 0.92 * (lump.depth_mm - skin_mm) - 0.12 * depth_mm);
}

double bumpAt(double distance_mm, double width_mm) noexcept {
  const double wide = 1.0 + distance_mm * distance_mm / (width_mm * width_mm);
  return 1.0 / (wide * wide * std::sqrt(wide));
}

namespace {

/// The mean of K over a circle round a point `offset_mm` from the foot, by the middles of 16 arcs of its half.
double meanBump(double radius_mm, double offset_mm, double width_mm) noexcept {
  constexpr std::size_t kArcs = 16;
  double sum = 0.0;
  for (std::size_t i = 0; i < kArcs; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(kArcs);
    const Vec2 at(offset_mm + radius_mm * elementary::cos(angle), radius_mm * elementary::sin(angle));
    sum += bumpAt(at.norm(), width_mm);
  }
  return sum / static_cast<double>(kArcs);
}

}  // namespace

double bumpBase(const PressurePattern& pattern, double offset_mm, double width_mm) noexcept {
  return kBumpBase * meanBump(0.5 * pattern.contact_radius_mm, offset_mm, width_mm);
}

}  // namespace palpate::tissue
