// Fits of several depths -> the form that serves them all, the shapes of a table, one curve for all of them.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "palpate/base/elementary.h"
#include "palpate/tissue/fitting/profile_fit.h"

namespace palpate::tissue {

namespace {

constexpr double kSummedRadiusMm = 40.0;
constexpr std::size_t kProfileKnots = 41;
constexpr double kNearlyAsGood = 1.05;
constexpr double kMinRegionMm = 1.0;

/// Straight between the radii; 0 beyond them.
double sampled(const std::vector<double>& radii, const std::vector<double>& values, double radius) {
  const auto above = std::ranges::upper_bound(radii, radius);
  if (above == radii.end()) return radius == radii.back() ? values.back() : 0.0;
  const auto i = static_cast<std::size_t>(above - radii.begin());
  const double share = (radius - radii[i - 1]) / (radii[i] - radii[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

/// Twice where a half Gaussian as wide at half its height would have ended: there bulges have ended too.
double rimRadius(const std::vector<double>& radii, const std::vector<double>& down) {
  constexpr double kHalvesToRim = 6.0;
  std::size_t half = 1;
  while (half + 1 < radii.size() && down[half] > 0.5) ++half;
  const double fall = down[half - 1] - down[half];
  const double share = fall > 0.0 ? std::clamp((down[half - 1] - 0.5) / fall, 0.0, 1.0) : 1.0;
  const double radius = radii[half - 1] + share * (radii[half] - radii[half - 1]);
  return std::clamp(kHalvesToRim * radius, kMinRegionMm, std::max(kMinRegionMm, radii.back()));
}

/// The straight line of rims over depths; level where they do not grow.
void findRegion(const std::vector<double>& rims, std::span<const PressedShape> shapes, SharedProfile& shared) {
  const auto count = static_cast<double>(rims.size());
  double mean_rim = 0.0;
  double mean_depth = 0.0;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    mean_rim += rims[i] / count;
    mean_depth += shapes[i].depth_mm / count;
  }
  double across = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    across += (shapes[i].depth_mm - mean_depth) * (rims[i] - mean_rim);
    square += elementary::square(shapes[i].depth_mm - mean_depth);
  }
  const double most = (mean_rim - kMinRegionMm) / mean_depth;
  shared.radius_per_depth = square > 0.0 ? std::clamp(across / square, 0.0, std::max(0.0, most)) : 0.0;
  shared.radius_mm = mean_rim - shared.radius_per_depth * mean_depth;
}

double regionRadius(const SharedProfile& shared, const PressedShape& shape) {
  return shared.radius_mm + shared.radius_per_depth * shape.depth_mm;
}

/// The mean of all shapes, taken down to 0 at the rim.
void findKnots(const std::vector<double>& radii, std::span<const PressedShape> shapes, SharedProfile& shared) {
  for (std::size_t j = 0; j < kProfileKnots; ++j) {
    const double q = static_cast<double>(j) / static_cast<double>(kProfileKnots - 1);
    double value = 0.0;
    for (const PressedShape& shape : shapes) value += sampled(radii, shape.down, q * regionRadius(shared, shape));
    shared.knots.push_back({q, value / static_cast<double>(shapes.size())});
  }
  const double rest = shared.knots.back().value;
  for (ProfileKnot& knot : shared.knots) knot.value -= rest * knot.q * knot.q;
  shared.knots.front().value = 1.0;
  shared.knots.back().value = 0.0;
}

double residualRms(const std::vector<double>& radii, std::span<const PressedShape> shapes,
                   const SharedProfile& shared) {
  std::vector<double> q;
  std::vector<double> values;
  for (const ProfileKnot& knot : shared.knots) {
    q.push_back(knot.q);
    values.push_back(knot.value);
  }
  double squares = 0.0;
  double area = 0.0;
  for (const PressedShape& shape : shapes) {
    for (std::size_t i = 1; i < radii.size() && radii[i] <= kSummedRadiusMm; ++i) {
      const double ring = radii[i] * (radii[i] - radii[i - 1]);
      squares += ring * elementary::square(sampled(q, values, radii[i] / regionRadius(shared, shape)) - shape.down[i]);
      area += ring;
    }
  }
  return area > 0.0 ? std::sqrt(squares / area) : 0.0;
}

}  // namespace

ProfileForm bestForm(std::span<const std::vector<ProfileFit>> fits) {
  std::array<double, kProfileForms.size()> squares{};
  for (const std::vector<ProfileFit>& of_depth : fits) {
    for (std::size_t f = 0; f < of_depth.size(); ++f) squares.at(f) += elementary::square(of_depth[f].unseen_rms);
  }
  const double least = *std::ranges::min_element(squares);
  // They are in the order of their numbers.
  const auto first =
      std::ranges::find_if(squares, [&](double value) { return value <= kNearlyAsGood * kNearlyAsGood * least; });
  return kProfileForms.at(static_cast<std::size_t>(first - squares.begin()));
}

std::vector<double> tableRadii(double to_mm) {
  std::vector<double> radii;
  for (double r = 0.0; r < to_mm; r += r < kSummedRadiusMm ? 0.5 : 2.0) radii.push_back(r);
  radii.push_back(to_mm);
  return radii;
}

PressedShape shapeOf(const ProfileFit& fit, const std::vector<double>& radii_mm) {
  PressedShape shape{.depth_mm = fit.depth_mm, .surface_mm = fit.surface_mm, .down = {}, .outward = {}};
  for (const double radius : radii_mm) {
    shape.down.push_back(downShare(fit, radius));
    shape.outward.push_back(outwardShare(fit, radius));
  }
  return shape;
}

SharedProfile sharedProfile(const std::vector<double>& radii_mm, std::span<const PressedShape> shapes) {
  SharedProfile shared;
  std::vector<double> rims;
  for (const PressedShape& shape : shapes) rims.push_back(rimRadius(radii_mm, shape.down));
  findRegion(rims, shapes, shared);
  findKnots(radii_mm, shapes, shared);
  shared.rms = residualRms(radii_mm, shapes, shared);
  return shared;
}

}  // namespace palpate::tissue
