// Curves are fitted once a table; what is asked at run time is two blends of some twenty numbers.
//
// Based on: what finite element models of layered tissue show (docs/explanation/tissue.md): shapes at a depth between
// two stored ones are within 1 % of their blend; forces over thickness follow powers, hence logarithms.
#include "palpate/tissue/layered_tissue.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/neighbours.h"

namespace palpate::tissue {

namespace {

/// Displacements below this share of the depth end a region: half of what 0.3 mm pixels show of a 10 mm press.
constexpr double kNothing = 0.006;
constexpr double kMinRadiusMm = 35.0;
constexpr double kMaxRadiusMm = 70.0;
/// A drag's rim over the half axis where a tenth is left. The tail of the solution beyond is faded out.
constexpr double kRimOverTenth = 1.8;
constexpr double kLongestDragMm = 150.0;
/// Samples that a curve is fitted to.
constexpr int kFitSamples = 160;
/// The skin stays this far from the bone, as a share of the thickness at rest.
constexpr double kClosestToBone = 0.1;

double interpolated(std::span<const double> x, std::span<const double> y, double at) {
  const Neighbours place = findNeighbours(x, at);
  return y[place.below] + place.share * (y[place.above] - y[place.below]);
}

/// Where the last of the shapes moves nothing any more.
double radiusOf(const LayeredTable& table) {
  double radius = 0.0;
  for (const PressedShape& shape : table.shapes) {
    for (std::size_t i = 0; i < table.radii_mm.size(); ++i) {
      if (std::max(std::abs(shape.down[i]), std::abs(shape.outward[i])) > kNothing)
        radius = std::max(radius, table.radii_mm[i]);
    }
  }
  return std::min(std::clamp(radius, kMinRadiusMm, kMaxRadiusMm), table.radii_mm.back());
}

/// N/mm: of a finger that one stack was solved for less deep than its neighbours; steeper than any that was.
constexpr double kAnySlope = 1e3;

/// By area, and not nothing in the middle.
double weightAt(double q) { return std::sqrt(q + 0.02); }

template <class ValueAt>
std::vector<CurveSample> samplesOf(const ValueAt& value_at) {
  std::vector<CurveSample> samples;
  for (int i = 0; i < kFitSamples; ++i) {
    const double q = static_cast<double>(i) / kFitSamples;
    samples.push_back({q, value_at(q), weightAt(q)});
  }
  return samples;
}

PressCurves pressCurves(const LayeredTable& table, const PressedShape& shape, double radius) {
  const auto down = samplesOf([&](double q) { return interpolated(table.radii_mm, shape.down, q * radius); });
  const auto outward = samplesOf([&](double q) { return interpolated(table.radii_mm, shape.outward, q * radius); });
  return {radius, fittedShare(down, kPressBend), fittedOutward(outward, kPressBend)};
}

/// Where the curve crosses a tenth.
double findTenthFallOff(const LayeredCurve& share) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (curveAt(share, kDragBend, middle * middle).value > 0.1 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

DragCurve dragCurve(const LayeredTable& table) {
  const DragShape drag = table.drag.value_or(DragShape{});
  const double tenth = std::sqrt(elementary::pow(10.0, 1.0 / drag.exponent) - 1.0);
  DragCurve curve;
  curve.along_mm = std::min(kRimOverTenth * tenth * drag.along_mm, kLongestDragMm);
  curve.across_mm = curve.along_mm * drag.across_mm / drag.along_mm;
  std::vector<CurveSample> samples;
  if (drag.on_along.empty()) {
    samples = samplesOf([&](double q) {
      const double widths = q * curve.along_mm / drag.along_mm;
      return elementary::pow(1.0 + widths * widths, -drag.exponent);
    });
  } else {
    samples = samplesOf([&](double q) { return interpolated(table.radii_mm, drag.on_along, q * curve.along_mm); });
    const auto across =
        samplesOf([&](double q) { return interpolated(table.radii_mm, drag.on_across, q * curve.across_mm); });
    samples.insert(samples.end(), across.begin(), across.end());
  }
  curve.share = fittedShare(samples, kDragBend);
  curve.tenth_q = findTenthFallOff(curve.share);
  return curve;
}

PressCurves blended(const PressCurves& a, const PressCurves& b, double share) noexcept {
  return {a.radius_mm + share * (b.radius_mm - a.radius_mm), blended(a.down, b.down, share),
          blended(a.outward, b.outward, share)};
}

DragCurve blended(const DragCurve& a, const DragCurve& b, double share) noexcept {
  const auto mix = [&](double x, double y) { return x + share * (y - x); };
  return {mix(a.along_mm, b.along_mm), mix(a.across_mm, b.across_mm), blended(a.share, b.share, share),
          mix(a.tenth_q, b.tenth_q)};
}

PressCurves pressOf(const LayeredNode& node, double depth_mm) noexcept {
  const Neighbours at = findNeighbours(node.depths_mm, depth_mm);
  return blended(node.presses[at.below], node.presses[at.above], at.share);
}

/// F / d, straight from 0 at no depth through the stored ones, and on with the last slope while that is not too steep.
double secantOn(std::span<const double> depths, std::span<const double> secants, double depth_mm,
                double steepest_n_per_mm = kStiffestTissue) noexcept {
  if (!(depth_mm > 0.0)) return 0.0;
  const std::size_t last = depths.size() - 1;
  const double first_depth = depths.front();
  if (depth_mm <= first_depth) return secants.front() * depth_mm / first_depth;
  if (depth_mm <= depths[last]) {
    const Neighbours at = findNeighbours(depths, depth_mm);
    return secants[at.below] + at.share * (secants[at.above] - secants[at.below]);
  }
  const double end = depths[last];
  const double before = last > 0 ? depths[last - 1] : 0.0;
  const double slope = (secants[last] - (last > 0 ? secants[last - 1] : 0.0)) / (end - before);
  const double tangent = std::min(secants[last] + end * std::max(0.0, slope), steepest_n_per_mm);
  const double force = secants[last] * end + std::max(tangent, secants[last]) * (depth_mm - end);
  return force / depth_mm;
}

double nodeSecant(const LayeredNode& node, double depth_mm, double finger_mm) noexcept {
  const auto of = [&](const std::vector<double>& secants) { return secantOn(node.depths_mm, secants, depth_mm); };
  if (node.fingers.empty()) return of(node.secants);
  const auto above = std::ranges::upper_bound(node.fingers, finger_mm, {}, &FingerSecants::radius_mm);
  if (above == node.fingers.begin()) return of(above->secants);
  const FingerSecants& below = *(above - 1);
  if (above == node.fingers.end() || below.radius_mm == finger_mm) return of(below.secants);
  const double share = (finger_mm - below.radius_mm) / (above->radius_mm - below.radius_mm);
  return of(below.secants) + share * (of(above->secants) - of(below.secants));
}

double geometric(double a, double b, double share) noexcept {
  if (!(a > 0.0) || !(b > 0.0)) return a + share * (b - a);
  return elementary::exp(elementary::log(a) + share * (elementary::log(b) - elementary::log(a)));
}

/// Between nodes of the same radii; otherwise those of the first.
std::vector<FingerSecants> blendedFingers(const LayeredNode& a, const LayeredNode& b, double share,
                                          const std::vector<double>& depths) {
  std::vector<FingerSecants> fingers;
  if (a.fingers.empty() || b.fingers.empty()) return fingers;
  for (const FingerSecants& finger : a.fingers) {
    FingerSecants& mixed = fingers.emplace_back(FingerSecants{finger.radius_mm, {}});
    for (const double depth : depths) {
      mixed.secants.push_back(
          geometric(nodeSecant(a, depth, finger.radius_mm), nodeSecant(b, depth, finger.radius_mm), share));
    }
  }
  return fingers;
}

/// Between two depths the secant is straight and the force a parabola, steepest at its end.
void soften(double most_n_per_mm, const std::vector<double>& depths, std::vector<double>& secants) {
  double depth_before = 0.0;
  double secant_before = 0.0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double steepness = depths[i] / (depths[i] - depth_before);
    const double most = (most_n_per_mm + steepness * secant_before) / (1.0 + steepness);
    secants[i] = std::min(secants[i], most);
    depth_before = depths[i];
    secant_before = secants[i];
  }
}

}  // namespace

Neighbours findNeighbours(std::span<const double> values, double at, bool logarithmic) noexcept {
  if (!(at > values.front())) return {};
  const std::size_t last = values.size() - 1;
  if (at >= values[last]) return {last, last, 0.0};
  const auto above = static_cast<std::size_t>(std::upper_bound(values.begin(), values.end(), at) - values.begin());
  const double from = values[above - 1];
  const double to = values[above];
  const double share =
      logarithmic ? elementary::log(at / from) / elementary::log(to / from) : (at - from) / (to - from);
  return {above - 1, above, share};
}

std::vector<FingerSecants> fingersOf(const std::vector<FingerForces>& solved, double indenter_radius_mm,
                                     const LayeredNode& node) {
  std::vector<FingerSecants> fingers = {{indenter_radius_mm, node.secants}};
  for (const FingerForces& finger : solved) {
    std::vector<double> secants;
    for (std::size_t i = 0; i < finger.depths_mm.size(); ++i)
      secants.push_back(finger.force_n[i] / finger.depths_mm[i]);
    FingerSecants& added = fingers.emplace_back(FingerSecants{finger.radius_mm, {}});
    for (const double depth : node.depths_mm)
      added.secants.push_back(secantOn(finger.depths_mm, secants, depth, kAnySlope));
  }
  std::ranges::sort(fingers, {}, &FingerSecants::radius_mm);
  return fingers;
}

LayeredNode nodeOf(const LayeredTable& table) {
  check(table);
  LayeredNode node;
  node.thickness_mm = totalThickness(table.stack);
  const double radius = radiusOf(table);
  for (const PressedShape& shape : table.shapes) {
    node.depths_mm.push_back(shape.depth_mm);
    node.secants.push_back(shape.force_n / shape.depth_mm);
    node.presses.push_back(pressCurves(table, shape, radius));
  }
  node.drag = dragCurve(table);
  if (table.drag) node.tangential_over_normal = table.drag->tangential_over_normal;
  if (!table.fingers.empty()) {
    node.fingers = fingersOf(table.fingers, table.indenter_radius_mm, node);
  } else if (!table.stack.layers.empty()) {
    node.fingers = fingersLikeLibrary(table.stack, table.indenter_radius_mm, node);
  }
  return node;
}

LayeredNode blended(const LayeredNode& a, const LayeredNode& b, double share) {
  LayeredNode node;
  node.thickness_mm = a.thickness_mm + share * (b.thickness_mm - a.thickness_mm);
  const double deepest = std::max(a.depths_mm.back(), b.depths_mm.back());
  const LayeredNode& longer = a.depths_mm.back() == deepest ? a : b;
  for (const double depth : longer.depths_mm) {
    node.depths_mm.push_back(depth);
    node.secants.push_back(
        geometric(secantOn(a.depths_mm, a.secants, depth), secantOn(b.depths_mm, b.secants, depth), share));
    node.presses.push_back(blended(pressOf(a, depth), pressOf(b, depth), share));
  }
  node.drag = blended(a.drag, b.drag, share);
  node.tangential_over_normal =
      a.tangential_over_normal + share * (b.tangential_over_normal - a.tangential_over_normal);
  node.fingers = blendedFingers(a, b, share, node.depths_mm);
  return node;
}

LayeredNode softenedTo(double most_n_per_mm, LayeredNode node) {
  soften(most_n_per_mm, node.depths_mm, node.secants);
  for (FingerSecants& finger : node.fingers) soften(most_n_per_mm, node.depths_mm, finger.secants);
  return node;
}

LayeredTissue::LayeredTissue(std::vector<LayeredNode> nodes) : nodes_(std::move(nodes)) {
  if (nodes_.empty()) throw Error("layered tissue: at least one table is required");
  std::ranges::sort(nodes_, {}, &LayeredNode::thickness_mm);
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    if (!(nodes_[i].thickness_mm > nodes_[i - 1].thickness_mm))
      throw Error("layered tissue: two tables have the same thickness");
  }
}

LayeredTissue::Between LayeredTissue::between(double thickness_mm) const noexcept {
  if (!(thickness_mm > thinnest())) return {&nodes_.front(), &nodes_.front(), 0.0};
  if (thickness_mm >= thickest()) return {&nodes_.back(), &nodes_.back(), 0.0};
  const auto above = std::ranges::upper_bound(nodes_, thickness_mm, {}, &LayeredNode::thickness_mm);
  const LayeredNode& a = *(above - 1);
  return {&a, &*above,
          elementary::log(thickness_mm / a.thickness_mm) / elementary::log(above->thickness_mm / a.thickness_mm)};
}

PressCurves LayeredTissue::pressAt(double thickness_mm, double depth_mm) const noexcept {
  const Between at = between(thickness_mm);
  return blended(pressOf(*at.a, depth_mm), pressOf(*at.b, depth_mm), at.share);
}

DragCurve LayeredTissue::dragAt(double thickness_mm) const noexcept {
  const Between at = between(thickness_mm);
  return blended(at.a->drag, at.b->drag, at.share);
}

double LayeredTissue::tangentialAt(double thickness_mm) const noexcept {
  const Between at = between(thickness_mm);
  return at.a->tangential_over_normal + at.share * (at.b->tangential_over_normal - at.a->tangential_over_normal);
}

double LayeredTissue::secantAt(double thickness_mm, double depth_mm, double finger_mm) const noexcept {
  const Between at = between(thickness_mm);
  return geometric(nodeSecant(*at.a, depth_mm, finger_mm), nodeSecant(*at.b, depth_mm, finger_mm), at.share);
}

bool LayeredTissue::knowsRadius() const noexcept {
  return std::ranges::all_of(nodes_, [](const LayeredNode& node) { return !node.fingers.empty(); });
}

double LayeredTissue::deepestAt(double thickness_mm) const noexcept {
  return (1.0 - kClosestToBone) * std::max(0.0, thickness_mm);
}

LayeredForce LayeredTissue::forceRows() const {
  LayeredForce rows;
  rows.thinnest_mm = thinnest();
  rows.inverse_step = (1.0 / thinnest() - 1.0 / thickest()) / (LayeredForce::kRows - 1);
  rows.rows = rows.inverse_step > 0.0 ? LayeredForce::kRows : 1;
  rows.knows_radius = knowsRadius();
  for (std::uint32_t row = 0; row < rows.rows; ++row) {
    const double thickness = rows.thicknessOf(row);
    rows.tangential[row] = tangentialAt(thickness);
    const double at_reference = secantAt(thickness, kReferenceDepthMm);
    for (std::uint32_t radius = 0; radius < LayeredForce::kRadii; ++radius) {
      if (!rows.knows_radius && radius != LayeredForce::kFingertip) continue;
      for (std::uint32_t i = 0; i < LayeredForce::kDepths; ++i) {
        rows.factor[radius][row][i] =
            secantAt(thickness, LayeredForce::kDepthStepMm * i, LayeredForce::kRadiiMm[radius]) / at_reference;
      }
    }
  }
  return rows;
}

}  // namespace palpate::tissue
