// Based on: Eshelby, "The determination of the elastic field of an ellipsoidal inclusion", 1957, for a ball; the ends
// of the saturation are fitted to finite elements (docs/explanation/lumps.md).
#include "palpate/tissue/lump_saturation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/number_range.h"

namespace palpate::tissue {

namespace {

constexpr NumberRange kHalfAxes{0.5, 40.0};
constexpr NumberRange kRatios{0.2, 1000.0};
constexpr NumberRange kLumpModuli{0.1, 1e6};
constexpr NumberRange kEdges{0.0, 1.0};
constexpr double kUnderSkinMm = 0.5;
constexpr double kOverBoneMm = 1.0;
/// Below it the saturation turns steep: a place so much softer than its layer counts as this.
constexpr double kSoftest = 0.2;

/// Fitted: how far from skin, bone or a stiffer layer a lump still relaxes, in lump radii; and the share of it that a
/// stiffer layer takes.
constexpr double kNearRadii = 0.205;
constexpr double kStifferLayer = 0.25;
constexpr double kLeastSigma = 0.1;
/// A layer this much stiffer than the lump's own counts as stiffer.
constexpr double kStiffer = 1.2;

void inRange(const NumberRange& range, double value, const char* name, const char* unit) {
  if (range.holds(value)) return;
  throw Error(fmt::format("lump: {} = {}", name, outOfRange(fmt::format("{}", value), range, unit)));
}

std::size_t layerAt(const LayerStack& stack, double depth_mm) {
  double bottom = 0.0;
  for (std::size_t i = 0; i < stack.layers.size(); ++i) {
    bottom += stack.layers[i].thickness_mm;
    if (depth_mm < bottom) return i;
  }
  return stack.layers.size() - 1;
}

double ease(double gap_mm, double radius_mm) {
  const double radii = std::max(0.0, gap_mm) / radius_mm;
  return radii / (radii + kNearRadii);
}

double sigmaOf(const LumpShape& lump, const LayerStack& stack) {
  const double radius = lump.radiusMm();
  const std::size_t centre = layerAt(stack, lump.centreMm());
  const double young = stack.layers[centre].young_kpa;
  double stiffer = 1.0;
  double top = 0.0;
  for (std::size_t i = 0; i < stack.layers.size(); ++i) {
    if (i > centre && stack.layers[i].young_kpa > kStiffer * young) {
      stiffer -=
          kStifferLayer * (1.0 - young / stack.layers[i].young_kpa) * (1.0 - ease(top - lump.bottomMm(), radius));
      break;
    }
    top += stack.layers[i].thickness_mm;
  }
  const double skin = ease(lump.depth_mm - stack.layers.front().thickness_mm, radius);
  const double bone = ease(totalThickness(stack) - lump.bottomMm(), radius);
  return std::max(kLeastSigma, skin * bone * stiffer);
}

}  // namespace

double LumpShape::radiusMm() const {
  return elementary::pow(half_axes_mm[0] * half_axes_mm[1] * half_axes_mm[2], 1.0 / 3.0);
}

double youngOf(const LumpShape& lump, const LayerStack& stack) {
  return lump.young_kpa.value_or(lump.stiffness_ratio * stack.layers[layerAt(stack, lump.centreMm())].young_kpa);
}

TopRange topRange(const LumpShape& lump, const LayerStack& stack) {
  const double skin = stack.layers.empty() ? 0.0 : stack.layers.front().thickness_mm;
  return {skin + kUnderSkinMm, totalThickness(stack) - kOverBoneMm - 2.0 * lump.half_axes_mm[2]};
}

void check(const LumpShape& lump, const LayerStack& stack) {
  if (stack.layers.size() < 2) throw Error("lump: needs a skin over at least one other layer");
  check(stack);
  for (const double half_axis : lump.half_axes_mm) inRange(kHalfAxes, half_axis, "half axis", "mm");
  if (lump.half_axes_mm[0] != lump.half_axes_mm[1]) {
    throw Error("lump: the first two half axes must be equal: a lump is round when seen from above");
  }
  inRange(kEdges, lump.edge, "edge", "");
  if (lump.young_kpa) inRange(kLumpModuli, *lump.young_kpa, "young_kpa", "kPa");
  if (!lump.young_kpa) inRange(kRatios, lump.stiffness_ratio, "stiffness_ratio", "");
  const TopRange top = topRange(lump, stack);
  if (!(lump.depth_mm >= top.from_mm)) {
    throw Error(
        fmt::format("lump: depth_mm = {} is out of range: the top lies at least {} mm under the skin's layer, "
                    "here {:.1f} to {:.1f} mm",
                    lump.depth_mm, kUnderSkinMm, top.from_mm, top.to_mm));
  }
  if (!(lump.depth_mm <= top.to_mm)) {
    throw Error(fmt::format("lump: reaches the bone: its bottom is {:.1f} mm deep, the bone {:.1f} mm", lump.bottomMm(),
                            totalThickness(stack)));
  }
  const double layer_kpa = stack.layers[layerAt(stack, lump.centreMm())].young_kpa;
  if (lump.young_kpa && *lump.young_kpa < kSoftest * layer_kpa) {
    throw Error(fmt::format("lump: young_kpa = {} is out of range: at least {} times the layer's, here {:g} kPa",
                            *lump.young_kpa, kSoftest, kSoftest * layer_kpa));
  }
}

Saturation::Saturation(const LumpShape& lump, const LayerStack& stack)
    : stack_(stack), young_kpa_(youngOf(lump, stack)), edge_(lump.edge), sigma_(sigmaOf(lump, stack)) {}

Hardening Saturation::at(std::size_t layer, double share) const {
  const double layer_kpa = stack_.layers[layer].young_kpa;
  const double nu = stack_.poisson;
  double fullness = 1.0;
  if (share >= 1.0) fullness = 0.0;
  if (share < 1.0 && share > 1.0 - edge_) {
    const double out = (share - (1.0 - edge_)) / edge_;
    fullness = 1.0 - out * out * (3.0 - 2.0 * out);
  }
  const double ratio = std::max(kSoftest, 1.0 + (young_kpa_ / layer_kpa - 1.0) * fullness);
  const double beta_shear = sigma_ * 2.0 * (4.0 - 5.0 * nu) / (15.0 * (1.0 - nu));
  const double beta_volume = sigma_ * (1.0 + nu) / (3.0 * (1.0 - nu));
  const double more = ratio - 1.0;
  const double shear = layer_kpa / (2.0 * (1.0 + nu));
  const double volume = layer_kpa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {shear * more / (1.0 + beta_shear * more), volume * more / (1.0 + beta_volume * more)};
}

}  // namespace palpate::tissue
