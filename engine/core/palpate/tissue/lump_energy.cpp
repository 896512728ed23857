// At build: densities of the press, gathered at points in the lump for 32 distances and every solved depth, then two
// splines. In the tick: one bicubic patch.
#include "palpate/tissue/lump_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/tissue/lump_saturation.h"

namespace palpate::tissue {

namespace {

/// Felt so far beside a lump, beyond its radius.
constexpr double kReachMm = 30.0;
/// Knots are closer up to here, where a fingertip touches.
constexpr double kFineToMm = 12.0;
constexpr std::size_t kFineSteps = 20;
/// The window leaves this share of the reach as it is.
constexpr double kWindowFrom = 0.5;
constexpr double kNPerMn = 1e-3;

constexpr std::size_t kGauss = 8;
constexpr std::array<double, 4> kGaussAt = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                            0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                0.1012285362903763};

struct GaussPoint {
  double at = 0.0;  ///< from 0 to 1
  double weight = 0.0;
};

GaussPoint gaussPoint(std::size_t i) {
  const double side = i % 2 == 0 ? -1.0 : 1.0;
  return {0.5 * (1.0 + side * kGaussAt[i / 2]), 0.5 * kGaussWeight[i / 2]};
}

/// A point of the half y > 0 of the lump, which stands for both.
struct LumpPoint {
  double x = 0.0;
  double y = 0.0;
  std::size_t layer = 0;
  double depth_mm = 0.0;
  double share = 0.0;  ///< of the half axes, from the middle
  double volume_mm3 = 0.0;
};

/// The slice between two depths of one layer.
void addSlice(const LumpShape& lump, std::size_t layer, double from, double to, std::vector<LumpPoint>& points) {
  const double across = lump.half_axes_mm[0];
  const double into = lump.half_axes_mm[2];
  for (std::size_t i = 0; i < kGauss; ++i) {
    const GaussPoint down = gaussPoint(i);
    const double depth = from + (to - from) * down.at;
    const double height = (depth - lump.centreMm()) / into;
    const double disc = std::sqrt(std::max(0.0, 1.0 - height * height));
    for (std::size_t j = 0; j < kGauss; ++j) {
      const GaussPoint out = gaussPoint(j);
      const double radius = disc * out.at;  // in half axes
      const double volume = (to - from) * down.weight * across * across * disc * out.weight * radius * 2.0 *
                            std::numbers::pi / static_cast<double>(kGauss);
      for (std::size_t k = 0; k < kGauss; ++k) {
        const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(kGauss);
        points.push_back({.x = across * radius * elementary::cos(angle),
                          .y = across * radius * elementary::sin(angle),
                          .layer = layer,
                          .depth_mm = depth,
                          .share = std::sqrt(height * height + radius * radius),
                          .volume_mm3 = volume});
      }
    }
  }
}

std::vector<LumpPoint> buildLumpPoints(const LumpShape& lump, const LayerStack& stack) {
  std::vector<LumpPoint> points;
  double top = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double bottom = top + stack.layers[layer].thickness_mm;
    const double from = std::max(top, lump.depth_mm);
    const double to = std::min(bottom, lump.bottomMm());
    if (to > from) addSlice(lump, layer, from, to, points);
    top = bottom;
  }
  return points;
}

/// The depth in a stack of other thicknesses. A thin layer is strained as a whole, so there the share of its thickness
/// counts; a thick one by its depth under the skin, as long as that is in the layer. Stacks of other layers: the same
/// depth.
double depthIn(const LayerStack& other, const LayerStack& stack, std::size_t layer, double depth_mm) {
  if (other.layers.size() != stack.layers.size()) return depth_mm;
  double top = 0.0;
  double other_top = 0.0;
  for (std::size_t i = 0; i < layer; ++i) {
    top += stack.layers[i].thickness_mm;
    other_top += other.layers[i].thickness_mm;
  }
  constexpr double kThinMm = 10.0;  // half of each; of places solved by themselves the best (lump_test.cpp)
  constexpr double kInside = 1e-9;
  const double thickness = stack.layers[layer].thickness_mm;
  const double other_thickness = other.layers[layer].thickness_mm;
  const double by_share = other_top + (depth_mm - top) * other_thickness / thickness;
  const double by_depth = std::clamp(depth_mm, other_top, other_top + other_thickness - kInside);
  const bool over_bone = layer + 1 == stack.layers.size();
  const double thin = elementary::square(elementary::square(thickness / kThinMm));
  const double share = over_bone ? 0.0 : 1.0 / (1.0 + thin);
  return by_depth + share * (by_share - by_depth);
}

/// How high the tissue between skin and lump still is under each press of a field, over its height at rest.
std::vector<double> computeSqueezes(const WeightedField& one, const LumpShape& lump, const LayerStack& stack) {
  constexpr std::size_t kLooks = 16;
  const PressField& field = *one.field;
  const double skin = stack.layers.front().thickness_mm;
  std::vector<double> squeezes(field.depths_mm.size(), 0.0);
  for (std::size_t i = 0; i < kLooks; ++i) {
    const double depth = skin + (lump.depth_mm - skin) * (static_cast<double>(i) + 0.5) / kLooks;
    const FieldRow row = rowAt(field, depthIn(*one.stack, stack, layerAt(stack, depth), depth));
    const FieldPlace place = placeAt(field, row, 0.0);
    for (std::size_t press = 0; press < squeezes.size(); ++press)
      squeezes[press] += stretchAlongAxis(densityAt(field, place, press).shear) / kLooks;
  }
  return squeezes;
}

/// The points of a lump in one field.
struct PointsInField {
  const PressField& field;
  const std::vector<LumpPoint>& points;
  std::vector<FieldRow> rows;        ///< one per point
  std::vector<Hardening> hardening;  ///< from the press before to this one: of point i, press k at i * presses + k
};

PointsInField pointsIn(const WeightedField& one, const LumpShape& lump, const LayerStack& stack,
                       const std::vector<LumpPoint>& points) {
  const Saturation saturation(lump, stack);
  PointsInField found{*one.field, points, {}, {}};
  const std::vector<double> squeezes = computeSqueezes(one, lump, stack);
  std::vector<std::vector<double>> sigmas(stack.layers.size());
  for (std::size_t layer = 0; layer < sigmas.size(); ++layer) {
    double before = 1.0;
    for (const double squeeze : squeezes) {
      sigmas[layer].push_back(saturation.sigma(layer, 0.5 * (before + squeeze)));
      before = squeeze;
    }
  }
  for (const LumpPoint& point : points) {
    found.rows.push_back(rowAt(*one.field, depthIn(*one.stack, stack, point.layer, point.depth_mm)));
    for (const double sigma : sigmas[point.layer])
      found.hardening.push_back(saturation.at(point.layer, point.share, sigma));
  }
  return found;
}

/// U at one distance and every solved depth, N mm: the saturation changes while the tissue above is squeezed, so what
/// each press adds to the densities has its own.
std::vector<double> computeEnergies(const PointsInField& lump, double rho_mm) {
  std::vector<double> energies(lump.field.depths_mm.size(), 0.0);
  for (std::size_t i = 0; i < lump.points.size(); ++i) {
    const LumpPoint& point = lump.points[i];
    const Hardening* const hardening = &lump.hardening[i * energies.size()];
    const FieldPlace place = placeAt(lump.field, lump.rows[i], elementary::hypot(point.x - rho_mm, point.y));
    StrainDensity before;
    double energy = 0.0;
    for (std::size_t press = 0; press < energies.size(); ++press) {
      const StrainDensity density = densityAt(lump.field, place, press);
      energy += hardening[press].shear_kpa * (density.shear - before.shear) +
                hardening[press].volume_kpa * (density.volume - before.volume);
      energies[press] += point.volume_mm3 * energy;
      before = density;
    }
  }
  for (double& energy : energies) energy *= kNPerMn;
  return energies;
}

/// Slopes of the cubic spline through values at knots, twice continuous; at its ends the slope is given, or nothing
/// bends.
std::vector<double> splineSlopes(std::span<const double> knots, std::span<const double> values, bool flat_ends) {
  const std::size_t n = knots.size();
  std::vector<double> diagonal(n, 1.0), upper(n, 0.0), lower(n, 0.0), slopes(n, 0.0);
  const auto step = [&](std::size_t i) { return knots[i + 1] - knots[i]; };
  const auto secant = [&](std::size_t i) { return (values[i + 1] - values[i]) / step(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = step(i);
    diagonal[i] = 2.0 * (step(i - 1) + step(i));
    upper[i] = step(i - 1);
    slopes[i] = 3.0 * (step(i) * secant(i - 1) + step(i - 1) * secant(i));
  }
  if (!flat_ends) {
    diagonal[0] = diagonal[n - 1] = 2.0;
    upper[0] = lower[n - 1] = 1.0;
    slopes[0] = 3.0 * secant(0);
    slopes[n - 1] = 3.0 * secant(n - 2);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    slopes[i] -= factor * slopes[i - 1];
  }
  slopes[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) slopes[i] = (slopes[i] - upper[i] * slopes[i + 1]) / diagonal[i];
  return slopes;
}

/// A cell of knots; 1 / mm is a division that no tick need make.
struct Step {
  double mm = 0.0;
  double inverse = 0.0;
};
constexpr Step makeStep(double mm) noexcept { return {mm, 1.0 / mm}; }

/// Weights of a cubic on a cell: for value and slope at its near end, value and slope at its far end.
using Weights = std::array<double, 4>;

inline Weights valueWeights(double t, const Step& step) noexcept {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {1.0 - 3.0 * t2 + 2.0 * t3, step.mm * (t - 2.0 * t2 + t3), 3.0 * t2 - 2.0 * t3, step.mm * (t3 - t2)};
}

inline Weights slopeWeights(double t, const Step& step) noexcept {
  const double t2 = t * t;
  return {6.0 * (t2 - t) * step.inverse, 1.0 - 4.0 * t + 3.0 * t2, 6.0 * (t - t2) * step.inverse, 3.0 * t2 - 2.0 * t};
}

inline Weights bendWeights(double t, const Step& step) noexcept {
  return {(12.0 * t - 6.0) * step.inverse * step.inverse, (6.0 * t - 4.0) * step.inverse,
          (6.0 - 12.0 * t) * step.inverse * step.inverse, (6.0 * t - 2.0) * step.inverse};
}

/// For the cell next to the skin, with neither energy nor force at its near end. Its force grows as the square of the
/// depth, as that of layered tissue does there (force_law.h): a cubic's would grow as the depth, and a light enough
/// touch would feel nothing but the lump.
inline Weights firstValueWeights(double t, const Step& step) noexcept {
  const double t3 = t * t * t;
  return {0.0, 0.0, t3 * (4.0 - 3.0 * t), step.mm * (t3 * (t - 1.0))};
}

inline Weights firstSlopeWeights(double t, const Step& step) noexcept {
  const double t2 = t * t;
  return {0.0, 0.0, 12.0 * (t2 * (1.0 - t)) * step.inverse, t2 * (4.0 * t - 3.0)};
}

inline Weights firstBendWeights(double t, const Step& step) noexcept {
  return {0.0, 0.0, t * (24.0 - 36.0 * t) * step.inverse * step.inverse, t * (12.0 * t - 6.0) * step.inverse};
}

inline double weighted(const Weights& w, const Weights& v) noexcept {
  return w[0] * v[0] + w[1] * v[1] + w[2] * v[2] + w[3] * v[3];
}

/// Value and slope at a depth.
struct EnergyAndForce {
  double energy = 0.0;
  double force = 0.0;
};

/// Energies of solved depths as a curve: U / d^2 is nearly straight over the root of d.
class DepthCurve {
 public:
  DepthCurve(const std::vector<double>& depths, const std::vector<double>& energies) {
    roots_.push_back(0.0);
    shares_.push_back(0.0);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      roots_.push_back(std::sqrt(depths[i]));
      shares_.push_back(energies[i] / (depths[i] * depths[i]));
    }
    slopes_ = splineSlopes(roots_, shares_, false);
  }

  EnergyAndForce at(double depth) const {
    if (!(depth > 0.0)) return {};
    const double last = roots_.back() * roots_.back();
    if (depth <= last) return within(std::sqrt(depth));
    constexpr double kBefore = 0.5;  // mm, that the last slope is taken over
    const EnergyAndForce end = within(roots_.back());
    const double slope = (end.force - within(std::sqrt(last - kBefore)).force) / kBefore;
    const double beyond = depth - last;
    return {end.energy + beyond * (end.force + 0.5 * slope * beyond), end.force + slope * beyond};
  }

 private:
  EnergyAndForce within(double root) const {
    const auto above = std::upper_bound(roots_.begin() + 1, roots_.end() - 1, root);
    const auto i = static_cast<std::size_t>(above - roots_.begin()) - 1;
    const Step step = makeStep(roots_[i + 1] - roots_[i]);
    const double t = (root - roots_[i]) / step.mm;
    const Weights ends = {shares_[i], slopes_[i], shares_[i + 1], slopes_[i + 1]};
    const double share = weighted(valueWeights(t, step), ends);
    const double depth = root * root;
    return {depth * depth * share, 2.0 * depth * share + 0.5 * depth * root * weighted(slopeWeights(t, step), ends)};
  }

  std::vector<double> roots_;
  std::vector<double> shares_;
  std::vector<double> slopes_;
};

/// 1 near the lump, 0 with slope 0 at the end of its reach.
double windowAt(double share_of_reach) {
  const double t = std::clamp((share_of_reach - kWindowFrom) / (1.0 - kWindowFrom), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

double factorAt(std::span<const ForceCorrection> correction, double depth_mm) {
  if (correction.empty()) return 1.0;
  if (depth_mm <= correction.front().depth_mm) return correction.front().factor;
  for (std::size_t i = 1; i < correction.size(); ++i) {
    const ForceCorrection& a = correction[i - 1];
    const ForceCorrection& b = correction[i];
    if (depth_mm < b.depth_mm)
      return a.factor + (b.factor - a.factor) * (depth_mm - a.depth_mm) / (b.depth_mm - a.depth_mm);
  }
  return correction.back().factor;
}

}  // namespace

/// The functions that a tick calls are in the class, small enough to be inlined.
namespace {

/// By distance and depth, before the splines along rho.
using EnergyRows = std::vector<std::vector<EnergyAndForce>>;

}  // namespace

struct LumpEnergy::Table {
  struct Knot {
    std::array<double, 2> value{};   ///< U and dU/dd
    std::array<double, 2> by_rho{};  ///< of both
  };

  double radius_mm = 0.0;
  double reach_mm = 0.0;
  double deepest_mm = 0.0;
  Step depth_step;
  Step coarse_step;
  LumpSteepness steepest;
  std::array<std::array<Knot, kDepths>, kRhos> knots{};

  double rhoAt(std::size_t i) const {
    return i <= kFineSteps ? kFineStep.mm * static_cast<double>(i)
                           : kFineToMm + coarse_step.mm * static_cast<double>(i - kFineSteps);
  }

  // How it is filled, in this order.
  void layOut(const LumpShape& lump, std::span<const WeightedField> fields);
  EnergyRows rowsOf(const LumpShape& lump, const LayerStack& stack, std::span<const WeightedField> fields) const;
  void setKnots(const EnergyRows& rows);
  void findSteepest();

  struct Full {
    LumpAnswer answer;
    double d_depth_depth = 0.0;
  };
  Full at(double rho, double depth) const noexcept;

  LumpSlopes slopesAt(double rho, double depth) const noexcept {
    const Patch patch = patchAt(rho, depth);
    const Weights value = column(patch, valueWeights(patch.t, patch.rho_step));
    const Weights first = column(patch, slopeWeights(patch.t, patch.rho_step));
    const Weights d_first = depthSlopes(patch);
    LumpSlopes slopes{weighted(depthValues(patch), first), weighted(d_first, value)};
    if (const double beyond = patch.beyond; beyond > 0.0) {
      const Weights d_second = depthBends(patch);
      slopes.d_rho += beyond * (weighted(d_first, first) + 0.5 * beyond * weighted(d_second, first));
      slopes.d_depth += beyond * weighted(d_second, value);
    }
    return slopes;
  }

  double forceAt(double rho, double depth) const noexcept {
    const Patch patch = patchAt(rho, depth);
    const Weights value = column(patch, valueWeights(patch.t, patch.rho_step));
    const double force = weighted(depthSlopes(patch), value);
    if (!(patch.beyond > 0.0)) return force;
    return force + patch.beyond * weighted(depthBends(patch), value);
  }

 private:
  static constexpr Step kFineStep = makeStep(kFineToMm / kFineSteps);

  /// Where a distance and a depth are among the knots. Signed: a processor makes no unsigned number of a double at
  /// once.
  struct Patch {
    std::ptrdiff_t i = 0, k = 0;
    double t = 0.0;  ///< from knot i on, in steps
    Step rho_step;
    double down = 0.0;    ///< from knot k on, in steps
    double beyond = 0.0;  ///< the deepest, mm
  };

  Patch patchAt(double rho, double depth) const noexcept {
    constexpr auto kLastRho = static_cast<std::ptrdiff_t>(kRhos) - 2,
                   kLastDepth = static_cast<std::ptrdiff_t>(kDepths) - 2;
    const bool fine = rho < kFineToMm;
    const std::ptrdiff_t from = fine ? 0 : static_cast<std::ptrdiff_t>(kFineSteps);
    const Step rho_step = fine ? kFineStep : coarse_step;
    const double along = (fine ? rho : rho - kFineToMm) / rho_step.mm;
    const std::ptrdiff_t i = std::min(static_cast<std::ptrdiff_t>(along) + from, kLastRho);
    const double inside = std::min(depth, deepest_mm);
    const double down = inside / depth_step.mm;
    const std::ptrdiff_t k = std::min(static_cast<std::ptrdiff_t>(down), kLastDepth);
    return {.i = i,
            .k = k,
            .t = along - static_cast<double>(i - from),
            .rho_step = rho_step,
            .down = down - static_cast<double>(k),
            .beyond = depth - inside};
  }

  Weights depthValues(const Patch& patch) const noexcept {
    return patch.k == 0 ? firstValueWeights(patch.down, depth_step) : valueWeights(patch.down, depth_step);
  }
  Weights depthSlopes(const Patch& patch) const noexcept {
    return patch.k == 0 ? firstSlopeWeights(patch.down, depth_step) : slopeWeights(patch.down, depth_step);
  }
  Weights depthBends(const Patch& patch) const noexcept {
    return patch.k == 0 ? firstBendWeights(patch.down, depth_step) : bendWeights(patch.down, depth_step);
  }

  /// The patch at a distance as values and depth's slopes at both depths, by the weights of the distance.
  Weights column(const Patch& patch, const Weights& w) const noexcept {
    const Knot* const a = &knots[static_cast<std::size_t>(patch.i)][static_cast<std::size_t>(patch.k)];
    const Knot* const b = a + kDepths;
    Weights column;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t j = 0; j < 2; ++j) {  // two numbers at once
        column[2 * k + j] = w[0] * a[k].value[j] + w[1] * a[k].by_rho[j] + w[2] * b[k].value[j] + w[3] * b[k].by_rho[j];
      }
    }
    return column;
  }
};

LumpEnergy::Table::Full LumpEnergy::Table::at(double rho, double depth) const noexcept {
  const Patch patch = patchAt(rho, depth);
  const Weights value = column(patch, valueWeights(patch.t, patch.rho_step));
  const Weights first = column(patch, slopeWeights(patch.t, patch.rho_step));
  const Weights second = column(patch, bendWeights(patch.t, patch.rho_step));
  const Weights d_value = depthValues(patch);
  const Weights d_first = depthSlopes(patch);
  const Weights d_second = depthBends(patch);
  Full full{{weighted(d_value, value), weighted(d_value, first), weighted(d_first, value), weighted(d_value, second)},
            weighted(d_second, value)};
  const double beyond = patch.beyond;
  if (beyond > 0.0) {
    LumpAnswer& answer = full.answer;
    answer.energy_n_mm += beyond * (answer.d_depth + 0.5 * beyond * full.d_depth_depth);
    answer.d_rho += beyond * (weighted(d_first, first) + 0.5 * beyond * weighted(d_second, first));
    answer.d_rho_rho += beyond * (weighted(d_first, second) + 0.5 * beyond * weighted(d_second, second));
    answer.d_depth += beyond * full.d_depth_depth;
  }
  return full;
}

namespace {

/// U <- the integral of c dU/dd, by three points between two depths.
void correct(std::span<const ForceCorrection> correction, const Step& step, std::vector<EnergyAndForce>& row) {
  constexpr std::array<double, 3> kAt = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const std::vector<EnergyAndForce> before = row;
  double energy = 0.0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (k > 0) {
      for (std::size_t q = 0; q < kAt.size(); ++q) {
        const Weights ends = {before[k - 1].energy, before[k - 1].force, before[k].energy, before[k].force};
        const double slope = weighted(k == 1 ? firstSlopeWeights(kAt[q], step) : slopeWeights(kAt[q], step), ends);
        energy += kWeight[q] * step.mm * slope * factorAt(correction, step.mm * (static_cast<double>(k - 1) + kAt[q]));
      }
    }
    row[k] = {energy, before[k].force * factorAt(correction, step.mm * static_cast<double>(k))};
  }
}

}  // namespace

void LumpEnergy::Table::layOut(const LumpShape& lump, std::span<const WeightedField> fields) {
  radius_mm = lump.radiusMm();
  reach_mm = kReachMm + radius_mm;
  coarse_step = makeStep((reach_mm - kFineToMm) / static_cast<double>(kRhos - 1 - kFineSteps));
  for (const WeightedField& one : fields) deepest_mm = std::max(deepest_mm, one.field->depths_mm.back());
  depth_step = makeStep(deepest_mm / static_cast<double>(kDepths - 1));
}

EnergyRows LumpEnergy::Table::rowsOf(const LumpShape& lump, const LayerStack& stack,
                                     std::span<const WeightedField> fields) const {
  const std::vector<LumpPoint> points = buildLumpPoints(lump, stack);
  EnergyRows sums(kRhos, std::vector<EnergyAndForce>(kDepths));
  for (const WeightedField& one : fields) {
    const PointsInField found = pointsIn(one, lump, stack, points);
    for (std::size_t i = 0; i < kRhos; ++i) {
      const double rho = rhoAt(i);
      const double share = one.share * windowAt(rho / reach_mm);
      const DepthCurve curve(one.field->depths_mm, computeEnergies(found, rho));
      for (std::size_t k = 0; k < kDepths; ++k) {
        const EnergyAndForce at = curve.at(depth_step.mm * static_cast<double>(k));
        sums[i][k].energy += share * at.energy;
        sums[i][k].force += share * at.force;
      }
    }
  }
  return sums;
}

void LumpEnergy::Table::setKnots(const EnergyRows& rows) {
  std::vector<double> rhos(kRhos);
  for (std::size_t i = 0; i < kRhos; ++i) rhos[i] = rhoAt(i);
  std::vector<double> energies(kRhos);
  std::vector<double> forces(kRhos);
  for (std::size_t k = 0; k < kDepths; ++k) {
    for (std::size_t i = 0; i < kRhos; ++i) {
      energies[i] = rows[i][k].energy;
      forces[i] = rows[i][k].force;
    }
    const std::vector<double> by_rho = splineSlopes(rhos, energies, true);
    const std::vector<double> by_both = splineSlopes(rhos, forces, true);
    for (std::size_t i = 0; i < kRhos; ++i) knots[i][k] = {{energies[i], forces[i]}, {by_rho[i], by_both[i]}};
  }
}

void LumpEnergy::Table::findSteepest() {
  constexpr int kLooks = 4;  // per cell
  for (std::size_t i = 0; i + 1 < kRhos; ++i) {
    for (int a = 0; a < kLooks; ++a) {
      const double rho = rhoAt(i) + (rhoAt(i + 1) - rhoAt(i)) * a / kLooks;
      for (std::size_t k = 0; k < kLooks * (kDepths - 1) + 1; ++k) {
        const Full full = at(rho, depth_step.mm * static_cast<double>(k) / kLooks);
        steepest.depth = std::max(steepest.depth, std::abs(full.d_depth_depth));
        steepest.rho = std::max(steepest.rho, std::abs(full.answer.d_rho_rho));
        steepest.snapping = std::max(steepest.snapping, -full.answer.d_rho_rho);
      }
    }
  }
}

LumpEnergy::LumpEnergy(const LumpShape& lump, const LayerStack& stack, std::span<const WeightedField> fields,
                       std::span<const ForceCorrection> correction) {
  check(lump, stack);
  if (fields.empty()) throw Error("lump: the press field is missing");
  auto table = std::make_shared<Table>();
  table->layOut(lump, fields);
  EnergyRows rows = table->rowsOf(lump, stack, fields);
  if (!correction.empty()) {
    for (auto& row : rows) correct(correction, table->depth_step, row);
  }
  table->setKnots(rows);
  table->findSteepest();
  table_ = std::move(table);
}

LumpEnergy LumpEnergy::scaled(double factor) const {
  LumpEnergy result = *this;
  result.factor_ *= factor;
  return result;
}

LumpAnswer LumpEnergy::at(double rho_mm, double depth_mm) const noexcept {
  const double rho = std::abs(rho_mm);
  if (!(depth_mm > 0.0) || !(rho < table_->reach_mm)) return {};
  LumpAnswer answer = table_->at(rho, depth_mm).answer;
  answer.energy_n_mm *= factor_;
  answer.d_rho *= rho_mm < 0.0 ? -factor_ : factor_;
  answer.d_depth *= factor_;
  answer.d_rho_rho *= factor_;
  return answer;
}

LumpSlopes LumpEnergy::slopesAt(double rho_mm, double depth_mm) const noexcept {
  const double rho = std::abs(rho_mm);
  if (!(depth_mm > 0.0) || !(rho < table_->reach_mm)) return {};
  const LumpSlopes slopes = table_->slopesAt(rho, depth_mm);
  return {slopes.d_rho * (rho_mm < 0.0 ? -factor_ : factor_), slopes.d_depth * factor_};
}

double LumpEnergy::forceAt(double rho_mm, double depth_mm) const noexcept {
  const double rho = std::abs(rho_mm);
  if (!(depth_mm > 0.0) || !(rho < table_->reach_mm)) return 0.0;
  return factor_ * table_->forceAt(rho, depth_mm);
}

double LumpEnergy::reachMm() const noexcept { return table_->reach_mm; }
double LumpEnergy::deepestMm() const noexcept { return table_->deepest_mm; }
double LumpEnergy::radiusMm() const noexcept { return table_->radius_mm; }

LumpSteepness LumpEnergy::steepest() const noexcept {
  LumpSteepness steepest = table_->steepest;
  steepest.depth *= std::abs(factor_);
  steepest.rho *= std::abs(factor_);
  steepest.snapping *= std::abs(factor_);
  return steepest;
}

}  // namespace palpate::tissue
