// Based on: Eshelby, "The determination of the elastic field of an ellipsoidal inclusion", 1957, for a ball; the ends
// of the saturation are fitted to finite elements (docs/explanation/lumps.md).
#include "palpate/tissue/lump_saturation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Fitted to finite elements, all eight (docs/explanation/lumps.md). How far from skin, a border of layers or bone a
/// lump still relaxes, in lump radii.
constexpr double kNearRadii = 0.35;
constexpr double kNearBoneRadii = 0.144;
/// A skin, or a layer below, this many times as stiff (and 1) takes half of what bone would.
constexpr double kHalfSkin = 1.09;
constexpr double kHalfBelow = 18.5;
/// A lump that reaches into the layer below as a whole feels less of its edge: the last number grows by this share.
constexpr double kReachingInto = 3.42;
/// How much more a lump relaxes just under a layer that is soft as nothing.
constexpr double kSofterAbove = 0.62;
/// Over firm ground the gap between skin and lump counts as what is left of it under the press, to this power. A lump
/// less than kRidesMm under the skin goes down with it, and the opposite holds.
constexpr double kSqueezePower = 2.44;
constexpr double kRidesMm = 1.09;
constexpr double kLeastSigma = 0.1;
/// A layer this much stiffer than the lump's own counts as stiffer.
constexpr double kStiffer = 1.2;

void inRange(const NumberRange& range, double value, const char* name, const char* unit) {
  if (range.holds(value)) return;
  throw Error(fmt::format("lump: {} = {}", name, outOfRange(fmt::format("{}", value), range, unit)));
}

/// How much a lump relaxes at a gap beside something that never yields.
double ease(double gap_radii, double near_radii) {
  const double radii = std::max(0.0, gap_radii);
  return radii / (radii + near_radii);
}

/// The share of bone's effect that something `ratio` times as stiff has: half of it at 1 + `half`.
double takes(double ratio, double half) { return ratio > 1.0 ? (ratio - 1.0) / (ratio - 1.0 + half) : 0.0; }

/// The first layer below that counts as stiffer.
struct Ground {
  double ratio = 1.0;   ///< of its modulus; 1: there is none
  double depth_mm = 0;  ///< where it begins
};

Ground findGround(const LayerStack& stack, std::size_t layer) {
  double border = 0.0;
  for (std::size_t i = 0; i < stack.layers.size(); ++i) {
    const double ratio = stack.layers[i].young_kpa / stack.layers[layer].young_kpa;
    if (i > layer && ratio > kStiffer) return {ratio, border};
    border += stack.layers[i].thickness_mm;
  }
  return {};
}

double easeOver(const Ground& ground, const LumpShape& lump) {
  const double gap = ground.depth_mm - lump.bottomMm();
  const double into = std::clamp(-gap / (2.0 * lump.half_axes_mm[2]), 0.0, 1.0);
  const double share = takes(ground.ratio, 1.0 + kHalfBelow * (1.0 + kReachingInto * into));
  return 1.0 - share * (1.0 - ease(gap / lump.radiusMm(), kNearRadii));
}

/// How much softer the layer above is, 0 to 1; the skin does not count.
double softerAbove(const LayerStack& stack, std::size_t layer) {
  if (layer < 2) return 0.0;
  return std::max(0.0, 1.0 - stack.layers[layer - 1].young_kpa / stack.layers[layer].young_kpa);
}

double easeUnderSofter(const LumpShape& lump, const LayerStack& stack, std::size_t layer) {
  double border = 0.0;
  for (std::size_t i = 0; i < layer; ++i) border += stack.layers[i].thickness_mm;
  const double gap = (lump.depth_mm - border) / lump.radiusMm();
  return 1.0 + kSofterAbove * softerAbove(stack, layer) * (1.0 - ease(gap, kNearRadii));
}

}  // namespace

std::size_t layerAt(const LayerStack& stack, double depth_mm) {
  double bottom = 0.0;
  for (std::size_t i = 0; i < stack.layers.size(); ++i) {
    bottom += stack.layers[i].thickness_mm;
    if (depth_mm < bottom) return i;
  }
  return stack.layers.size() - 1;
}

double stretchAlongAxis(double shear_density) {
  // (s^2 + 2 / s - 3) / 2 falls from the least stretch to 1. As exact as its argument after so many halvings.
  constexpr int kHalvings = 30;
  double low = 0.02;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double stretch = 0.5 * (low + high);
    const bool more = stretch * stretch + 2.0 / stretch - 3.0 > 2.0 * shear_density;
    (more ? low : high) = stretch;
  }
  return 0.5 * (low + high);
}

double LumpShape::radiusMm() const {
  return elementary::pow(half_axes_mm[0] * half_axes_mm[1] * half_axes_mm[2], 1.0 / 3.0);
}

double youngModulus(const LumpShape& lump, const LayerStack& stack) {
  return lump.young_kpa.value_or(lump.stiffness_ratio * stack.layers[layerAt(stack, lump.centreMm())].young_kpa);
}

TopRange topRange(const LumpShape& lump, const LayerStack& stack) {
  const double skin = stack.layers.empty() ? 0.0 : stack.layers.front().thickness_mm;
  return {skin + kUnderSkinMm, totalThickness(stack) - kOverBoneMm - 2.0 * lump.half_axes_mm[2]};
}

void check(const LumpShape& lump, const LayerStack& stack) {
  if (stack.layers.size() < 2) throw Error("lump: requires a skin layer above at least one other layer");
  check(stack);
  for (const double half_axis : lump.half_axes_mm) inRange(kHalfAxes, half_axis, "half axis", "mm");
  if (lump.half_axes_mm[0] != lump.half_axes_mm[1]) {
    throw Error("lump: the first two half axes must be equal (a lump is round seen from above)");
  }
  inRange(kEdges, lump.edge, "edge", "");
  if (lump.young_kpa) inRange(kLumpModuli, *lump.young_kpa, "young_kpa", "kPa");
  if (!lump.young_kpa) inRange(kRatios, lump.stiffness_ratio, "stiffness_ratio", "");
  const TopRange top = topRange(lump, stack);
  if (!(lump.depth_mm >= top.from_mm)) {
    throw Error(
        fmt::format("lump: depth_mm = {} is out of range: the top must be at least {} mm below the skin layer, here "
                    "{:.1f} to {:.1f} mm",
                    lump.depth_mm, kUnderSkinMm, top.from_mm, top.to_mm));
  }
  if (!(lump.depth_mm <= top.to_mm)) {
    throw Error(fmt::format(
        "lump: reaches the bone: its bottom is at {:.1f} mm, the bone at {:.1f} mm; make it smaller or shallower",
        lump.bottomMm(), totalThickness(stack)));
  }
  const double layer_kpa = stack.layers[layerAt(stack, lump.centreMm())].young_kpa;
  if (lump.young_kpa && *lump.young_kpa < kSoftest * layer_kpa) {
    throw Error(
        fmt::format("lump: young_kpa = {} is out of range: expected at least {} times the layer's, here {:g} kPa",
                    *lump.young_kpa, kSoftest, kSoftest * layer_kpa));
  }
}

Saturation::Saturation(const LumpShape& lump, const LayerStack& stack)
    : stack_(stack), young_kpa_(youngModulus(lump, stack)), edge_(lump.edge) {
  const double radius = lump.radiusMm();
  const double gap = lump.depth_mm - stack.layers.front().thickness_mm;
  gap_radii_ = gap / radius;
  const double power = kSqueezePower * (gap - kRidesMm) / (gap + kRidesMm);
  const double bone = ease((totalThickness(stack) - lump.bottomMm()) / radius, kNearBoneRadii);
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double skin_ratio = stack.layers.front().young_kpa / stack.layers[layer].young_kpa;
    const Ground ground = findGround(stack, layer);
    // Without firm ground the lump goes down, and nothing above it is squeezed.
    const double firm = ground.ratio > 1.0 ? 1.0 - 1.0 / ground.ratio : softerAbove(stack, layer);
    around_.push_back({.skin_takes = takes(skin_ratio, kHalfSkin),
                       .ease = bone * easeOver(ground, lump) * easeUnderSofter(lump, stack, layer),
                       .squeeze_power = power > 0.0 ? power * firm : power});
  }
}

double Saturation::sigma(std::size_t layer, double squeeze) const {
  const Around& around = around_[layer];
  const double gap = gap_radii_ * elementary::pow(squeeze, around.squeeze_power);
  const double sigma = around.ease * (1.0 - around.skin_takes * (1.0 - ease(gap, kNearRadii)));
  // A lump softer than its layer would fall to nothing and below as sigma grows.
  const double most = young_kpa_ < stack_.layers[layer].young_kpa ? 1.0 : std::numeric_limits<double>::infinity();
  return std::clamp(sigma, kLeastSigma, most);
}

Hardening Saturation::at(std::size_t layer, double share, double sigma) const {
  const double layer_kpa = stack_.layers[layer].young_kpa;
  const double nu = stack_.poisson;
  double fullness = 1.0;
  if (share >= 1.0) fullness = 0.0;
  if (share < 1.0 && share > 1.0 - edge_) {
    const double out = (share - (1.0 - edge_)) / edge_;
    fullness = 1.0 - out * out * (3.0 - 2.0 * out);
  }
  const double ratio = std::max(kSoftest, 1.0 + (young_kpa_ / layer_kpa - 1.0) * fullness);
  const double beta_shear = sigma * 2.0 * (4.0 - 5.0 * nu) / (15.0 * (1.0 - nu));
  const double beta_volume = sigma * (1.0 + nu) / (3.0 * (1.0 - nu));
  const double more = ratio - 1.0;
  const double shear = layer_kpa / (2.0 * (1.0 + nu));
  const double volume = layer_kpa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {shear * more / (1.0 + beta_shear * more), volume * more / (1.0 + beta_volume * more)};
}

}  // namespace palpate::tissue
