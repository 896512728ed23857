// Eight ways from the contact, each walked once for press and drag together. A press counts the way as seen along the
// normal and no folds: a fingertip dents the skin by a centimetre, which no fold is narrower than.
#include "palpate/scene/anatomical_reach.h"
#include "palpate/scene/section_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/scene/beneath/tissue_beneath.h"
#include "palpate/tree/closest_on_triangle.h"

namespace palpate::scene {

namespace {

constexpr std::size_t kDirections = std::tuple_size_v<DirectedFactors>;
/// Shares of a drag's reach that a radian of fold costs: across the fold, which it pulls open or shut, and along it.
constexpr double kFoldCost = 0.6;
constexpr double kFoldCostAlong = 0.2;
/// A hollow must turn by at least this (radian) to be a fold.
constexpr double kNoFold = 0.15;
/// Ways are told by chords of about this length: what is finer is relief.
constexpr double kChordMm = 4.0;
/// No factor goes further: beyond, what was solved says nothing.
constexpr double kMinFactor = 0.25;
constexpr double kMaxFactor = 1.6;
constexpr double kFarBoneMm = 1e3;
/// The skin goes down by at most this share of the tissue at rest.
constexpr double kMaxOfTissue = 0.9;

/// Where the skin goes down by 2 mm of a press of 8, as a share of the region.
double findQuarterFallOff(const tissue::PressCurves& press) {
  double q = 0.0;
  while (q < 1.0 && tissue::curveAt(press.down, tissue::kPressBend, q * q).value > 0.25) q += 1.0 / 512.0;
  return q;
}

double directionAngle(std::size_t direction) {
  return 2.0 * std::numbers::pi * static_cast<double>(direction) / static_cast<double>(kDirections);
}

std::vector<float> logarithms(std::span<const float> values) {
  std::vector<float> logs;
  for (const float value : values) logs.push_back(elementary::log(value));
  return logs;
}

/// The cost of a fold, chord by chord: the turn of a whole hollow counts, less kNoFold.
class FoldCost {
 public:
  explicit FoldCost(double each_rad) : each_rad_(each_rad) {}
  /// `slope_rad`: of the next chord against the tangent plane. The first one starts it.
  double next(double slope_rad) noexcept {
    const double turn = started_ ? slope_rad - slope_ : 0.0;
    started_ = true;
    slope_ = slope_rad;
    if (turn < 0.0) {
      hollow_ = charged_ = 0.0;
      return 0.0;
    }
    hollow_ += turn;
    const double whole = each_rad_ * std::max(0.0, hollow_ - kNoFold);
    const double more = whole - charged_;
    charged_ = whole;
    return more;
  }

 private:
  double each_rad_;
  double slope_ = 0.0;
  double hollow_ = 0.0;  ///< radian turned inward since the last turn outward
  double charged_ = 0.0;
  bool started_ = false;
};

/// `other` may have any length; 1 if it is zero.
double squaredCosine(const Vec3& unit, const Vec3& other) noexcept {
  const double length2 = other.squaredNorm();
  return length2 > 0.0 ? unit.dot(other) * unit.dot(other) / length2 : 1.0;
}

double logFactor(double reach_mm, double flat_mm) noexcept {
  return elementary::log(std::clamp(reach_mm / flat_mm, kMinFactor, kMaxFactor));
}

/// Between the two vertices of an edge.
double valueAt(const std::vector<float>& values, const SectionWalk::Crossing& at) noexcept {
  const auto first = static_cast<double>(values[at.vertices[0]]);
  return first + at.share * (static_cast<double>(values[at.vertices[1]]) - first);
}

maps::LogTensor evenPart(const DirectedFactors& factors) noexcept {
  maps::LogTensor even = maps::LogTensor::Zero();
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double twice = 2.0 * directionAngle(i);
    even += factors[i] * Vec3(1.0, 2.0 * elementary::cos(twice), 2.0 * elementary::sin(twice));
  }
  return even / static_cast<double>(kDirections);
}

}  // namespace

/// mm that a region reaches in tissue of one thickness.
struct AnatomicalReach::Rates {
  double press_mm = 1.0;
  double drag_mm = 1.0;
};

/// A share that grows along a way until it is 1.
struct AnatomicalReach::Growing {
  double share = 0.0;
  double reach_mm = 0.0;  ///< as seen along the normal, where it came to 1, or so far

  bool done() const { return share >= 1.0; }
  void add(double from_mm, double ahead_mm, double more) noexcept {
    if (done()) return;
    reach_mm = from_mm + (share + more < 1.0 ? ahead_mm : ahead_mm * (1.0 - share) / more);
    share += more;
  }
  /// As if the skin went on flat from here.
  void extendFlat(double from_mm, double whole_mm) noexcept { add(from_mm, whole_mm, 1.0); }
};

/// How deep the centre of a press may go, so that no skin around it comes too near to the bone under it.
struct AnatomicalReach::Cover {
  static constexpr std::size_t kSteps = 32;
  double step_mm = 0.0;                    ///< 0: nothing is asked
  std::array<double, kSteps + 1> moved{};  ///< of the centre's way, what the skin at step_mm i moves by
  double deepest_mm = std::numeric_limits<double>::infinity();

  explicit Cover(const tissue::PressCurves* press) noexcept {
    if (press == nullptr) return;
    step_mm = press->radius_mm / kSteps;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double q = static_cast<double>(i) / kSteps;
      const double outward = q * tissue::curveAt(press->outward, tissue::kPressBend, q * q).value;
      moved[i] = elementary::hypot(tissue::curveAt(press->down, tissue::kPressBend, q * q).value, outward);
    }
  }
  void limitDepth(double distance_mm, double tissue_mm) noexcept {
    const double place = distance_mm / step_mm;
    if (!(place < kSteps)) return;
    const auto i = static_cast<std::size_t>(place);
    const double share = moved[i] + (place - static_cast<double>(i)) * (moved[i + 1] - moved[i]);
    if (share * deepest_mm > kMaxOfTissue * tissue_mm) deepest_mm = kMaxOfTissue * tissue_mm / share;
  }
};

/// One direction, and how far press and drag come.
struct AnatomicalReach::Way {
  Vec3 ahead;
  Rates here;            ///< of flat skin at the contact
  double drag_mm = 1.0;  ///< how far a drag reaches this way on flat skin
  double fold_cost = kFoldCost;
  Growing press, drag;  ///< what is not asked for is done

  bool done() const { return press.done() && drag.done(); }
  /// How far a drag reaches where the tissue is this thick.
  double dragReach(const Rates& rates) const { return drag_mm * rates.drag_mm / here.drag_mm; }
  void extendFlat(double from_mm, const Rates& rates) noexcept {
    press.extendFlat(from_mm, rates.press_mm);
    drag.extendFlat(from_mm, dragReach(rates));
  }
};

AnatomicalReach::AnatomicalReach(const mesh::TriangleMesh& skin, const tree::TriangleTree& tree,
                                 std::span<const double> nearest_mm, std::span<const body::Bone> bones,
                                 const tissue::LayeredTissue& layered)
    : record_of_triangle_(tree.source_triangle.size()),
      log_thinnest_(elementary::log(layered.thinnest())),
      log_step_(elementary::log(layered.thickest() / layered.thinnest()) / kRows) {
  for (std::size_t record = 0; record < tree.source_triangle.size(); ++record) {
    record_of_triangle_[tree.source_triangle[record]] = static_cast<Index>(record);
  }
  for (std::size_t row = 0; row <= kRows; ++row) {
    const double thickness = elementary::exp(log_thinnest_ + log_step_ * static_cast<double>(row));
    const tissue::PressCurves press = layered.pressAt(thickness, tissue::kReferenceDepthMm);
    press_mm_[row] = press.radius_mm * findQuarterFallOff(press);
    const tissue::DragCurve drag = layered.dragAt(thickness);
    drag_mm_[row] = drag.tenth_q * std::sqrt(drag.along_mm * drag.across_mm);
  }
  if (nearest_mm.empty() || bones.empty()) return;
  for (const double depth : nearest_mm) {
    nearest_mm_.push_back(static_cast<float>(std::clamp(depth, 0.0, kFarBoneMm)));
  }
  log_beneath_ = logarithms(tissueBeneath(skin, nearest_mm, bones));
}

AnatomicalReach::Rates AnatomicalReach::ratesAt(double log_thickness) const noexcept {
  if (!(log_step_ > 0.0)) return {press_mm_[0], drag_mm_[0]};
  const double place = std::clamp((log_thickness - log_thinnest_) / log_step_, 0.0, static_cast<double>(kRows));
  const std::size_t row = std::min(static_cast<std::size_t>(place), kRows - 1);
  const double share = place - static_cast<double>(row);
  const auto between = [&](const auto& rows) { return rows[row] + share * (rows[row + 1] - rows[row]); };
  return {between(press_mm_), between(drag_mm_)};
}

AnatomicalReach::Rates AnatomicalReach::flatRates(Index triangle, const tree::TriangleTree& tree,
                                                  const Vec3& point) const noexcept {
  if (nearest_mm_.empty()) return ratesAt(0.0);
  const tree::TriangleRecord& record = tree.records[record_of_triangle_[triangle]];
  const Vec3 weights = tree::barycentricWeights(record.corners, point);
  double thickness = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    thickness += weights[static_cast<Eigen::Index>(i)] * static_cast<double>(nearest_mm_[record.vertices[i]]);
  }
  return ratesAt(elementary::log(thickness));
}

void AnatomicalReach::walk(const tree::TriangleTree& tree, Index record, const Vec3& point, const Vec3& normal,
                           Way& way, Cover& cover) const noexcept {
  constexpr int kMaxCrossings = 4000;  // a way of metres on the densest body
  SectionWalk walk(tree, record, point, normal, way.ahead);
  SectionWalk::Crossing at;
  FoldCost folds(way.fold_cost);
  double ahead = 0.0;
  double up = 0.0;
  Rates rates = way.here;
  for (int i = 0; i < kMaxCrossings && !way.done(); ++i) {
    if (!walk.next(at)) return way.extendFlat(ahead, rates);
    if (cover.step_mm > 0.0) cover.limitDepth((at.point - point).norm(), valueAt(nearest_mm_, at));
    const double step = way.ahead.dot(at.point - point) - ahead;
    const double rise = normal.dot(at.point - point) - up;
    const double chord = elementary::hypot(step, rise);
    if (chord < kChordMm) continue;
    if (!(step > 0.0))
      return way.press.extendFlat(ahead, rates.press_mm);  // turns back: a drag ends, whatever is beyond
    if (!log_beneath_.empty()) rates = ratesAt(valueAt(log_beneath_, at));
    way.press.add(ahead, step, step / rates.press_mm);
    way.drag.add(ahead, step, step / way.dragReach(rates) + folds.next(elementary::atan2(rise, step)));
    ahead += step;
    up += rise;
  }
}

PlaceReach AnatomicalReach::at(const tree::TriangleTree& tree, Index triangle, const Vec3& point,
                               const Vec3& unit_normal, const ReachRequest& request) const noexcept {
  PlaceReach place;
  place.first = maps::liftedOntoSurface({1.0, 1.0, 0.0}, unit_normal).half_major;
  place.second = unit_normal.cross(place.first);
  const bool presses = request.press != nullptr && !log_beneath_.empty();
  const bool drags = request.drag_tenth.half_major.norm() > 0.0;
  if (triangle >= record_of_triangle_.size() || !(presses || drags)) return place;
  const Rates here = flatRates(triangle, tree, point);
  Cover cover(presses ? request.press : nullptr);
  for (std::size_t i = 0; i < kDirections; ++i) {
    Way way;
    way.ahead = elementary::cos(directionAngle(i)) * place.first + elementary::sin(directionAngle(i)) * place.second;
    way.here = here;
    way.press.share = presses ? 0.0 : 1.0;
    way.drag.share = drags ? 0.0 : 1.0;
    if (drags) {
      way.drag_mm = 1.0 / maps::locationRatio(request.drag_tenth, way.ahead);
      way.fold_cost = kFoldCostAlong + (kFoldCost - kFoldCostAlong) * squaredCosine(way.ahead, request.drag);
    }
    walk(tree, record_of_triangle_[triangle], point, unit_normal, way, cover);
    if (presses) place.press[i] = logFactor(way.press.reach_mm, here.press_mm);
    if (drags) place.drag[i] = logFactor(way.drag.reach_mm, way.drag_mm);
  }
  place.deepest_mm = cover.deepest_mm;
  return place;
}

maps::SurfaceEllipse bentEllipse(const maps::SurfaceEllipse& ellipse, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept {
  const double length = ellipse.half_major.norm();
  if (!(length > 0.0) || !(ellipse.aspect > 0.0)) return ellipse;
  const double direction = elementary::atan2(ellipse.half_major.dot(place.second), ellipse.half_major.dot(place.first));
  const maps::LogTensor flat = maps::logTensor({length, std::min(1.0, ellipse.aspect), direction});
  const maps::Ellipse bent = maps::ellipseOf(flat + evenPart(factors));
  const Vec3 axis =
      elementary::cos(bent.direction_rad) * place.first + elementary::sin(bent.direction_rad) * place.second;
  return {bent.half_major_mm * axis, bent.aspect};
}

namespace {

/// The factors as radii at equal angles, so that radiusAt interpolates them.
maps::PolarContour asRadii(const DirectedFactors& factors) noexcept {
  maps::PolarContour radii{.count = factors.size()};
  std::ranges::copy(factors, radii.log_radii.begin());
  return radii;
}

}  // namespace

maps::SurfaceContour bentContour(maps::SurfaceContour contour, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept {
  const maps::PolarContour between = asRadii(factors);
  for (std::size_t i = 0; i < contour.contour.count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(contour.contour.count);
    const Vec3 ahead = elementary::cos(angle) * contour.axis_x + elementary::sin(angle) * contour.axis_y;
    const double at_place = elementary::atan2(ahead.dot(place.second), ahead.dot(place.first));
    contour.contour.log_radii[i] += elementary::log(maps::radiusAt(between, at_place));
  }
  return contour;
}

maps::SurfaceContour bentContour(const maps::SurfaceEllipse& ellipse, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept {
  constexpr std::size_t kRadii = 48;  // four between two ways
  maps::SurfaceContour bent{.contour = {.count = kRadii}, .axis_x = place.first, .axis_y = place.second};
  const maps::PolarContour between = asRadii(factors);
  for (std::size_t i = 0; i < kRadii; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kRadii);
    const Vec3 ahead = elementary::cos(angle) * place.first + elementary::sin(angle) * place.second;
    bent.contour.log_radii[i] = elementary::log(maps::radiusAt(between, angle) / maps::locationRatio(ellipse, ahead));
  }
  return bent;
}

}  // namespace palpate::scene
