// Places of one depth -> arrays with weights -> the form's numbers by least squares, u0 following from them in closed
// form -> the same for the sideways motion -> places left out.
#include "palpate/tissue/fitting/profile_fit.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "palpate/base/dense_solve.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/gaussian.h"
#include "palpate/tissue/fitting/bounded_fit.h"
#include "palpate/tissue/user_profile.h"

namespace palpate::tissue {

namespace {

constexpr double kScoreRadiusMm = 40.0;
/// Skin nearer to the axis than this shows how far the axis goes down; farther out it hides under the indenter.
constexpr double kMiddleMm = 2.0;
constexpr std::size_t kMinPlaces = 6;
constexpr Eigen::Index kMaxKnots = 150;
constexpr Eigen::Index kPlaceFolds = 5;

using Indices = std::vector<Eigen::Index>;

/// Places by radius.
struct Places {
  double depth = 0.0;
  Eigen::ArrayXd radius;
  Eigen::ArrayXd down;
  Eigen::ArrayXd outward;  // empty: not measured
  Eigen::ArrayXd areas;    // areas of the ring around each within kScoreRadiusMm; they add up to 1
  Eigen::ArrayXd weights;  // weights in the fit

  bool showsMiddle() const { return radius[0] <= kMiddleMm; }
};

Eigen::ArrayXd areaShares(const Eigen::ArrayXd& radius) {
  Eigen::ArrayXd areas(radius.size());
  const auto squared = [](double r) { return elementary::square(std::min(r, kScoreRadiusMm)); };
  double inner = 0.0;
  for (Eigen::Index i = 0; i < radius.size(); ++i) {
    const double outer = i + 1 < radius.size() ? 0.5 * (radius[i] + radius[i + 1]) : radius[i];
    areas[i] = squared(outer) - squared(inner);
    inner = outer;
  }
  const double all = areas.sum();
  return all > 0.0 ? Eigen::ArrayXd(areas / all)
                   : Eigen::ArrayXd::Constant(radius.size(), 1.0 / static_cast<double>(radius.size()));
}

Places skinPlaces(const SkinProfile& profile) {
  const auto array = [](const std::vector<double>& values) {
    return Eigen::ArrayXd(Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  Places places{.depth = profile.depth_mm,
                .radius = array(profile.radius_mm),
                .down = array(profile.down_mm),
                .outward = array(profile.outward_mm),
                .areas = {},
                .weights = {}};
  std::vector<double> radii = profile.radius_mm;
  const auto different = static_cast<std::size_t>(std::unique(radii.begin(), radii.end()) - radii.begin());
  const std::string where = fmt::format("depth {} mm", profile.depth_mm);
  if (different < kMinPlaces) {
    throw Error(fmt::format("{}: {} different radii; at least {} are required", where, different, kMinPlaces));
  }
  if (!(places.down.maxCoeff() > 0.0)) throw Error(where + ": the skin is not pressed down at any radius");
  places.areas = areaShares(places.radius);
  places.weights = (0.5 * places.areas + 0.5 / static_cast<double>(places.radius.size())).sqrt();
  return places;
}

/// Keeps areas and weights: scored as all of them, fitted as if these were all.
Places somePlaces(const Places& places, const Indices& which) {
  return {places.depth,        places.radius(which),
          places.down(which),  places.outward.size() > 0 ? Eigen::ArrayXd(places.outward(which)) : Eigen::ArrayXd(),
          places.areas(which), places.weights(which)};
}

// --- the forms: numbers as the fit turns them, most by their logarithm

struct ShapeNumber {
  std::string_view name;
  Bounds inner;
};

std::vector<ShapeNumber> innerNumbers(ProfileForm form) {
  const auto logarithms = [](double low, double high) { return Bounds{elementary::log(low), elementary::log(high)}; };
  switch (form) {
    case ProfileForm::half_gaussian:
      return {{"radius_mm", logarithms(1.0, 1000.0)}};
    case ProfileForm::power_tail:
      return {{"width_mm", logarithms(0.5, 500.0)}, {"exponent", logarithms(0.2, 8.0)}};
    case ProfileForm::two_gaussians:
      return {
          {"narrow_mm", logarithms(0.5, 300.0)}, {"wide_mm", logarithms(1.05, 10.0)}, {"wide_weight", {-2.0, 0.98}}};
    case ProfileForm::measured:
      break;
  }
  return {};
}

std::vector<Eigen::VectorXd> shapeStarts(ProfileForm form) {
  const auto log2 = [](double a, double b) {
    return Eigen::VectorXd(Eigen::Vector2d(elementary::log(a), elementary::log(b)));
  };
  const auto gaussians = [](double narrow, double ratio, double weight) {
    return Eigen::VectorXd(Eigen::Vector3d(elementary::log(narrow), elementary::log(ratio), weight));
  };
  switch (form) {
    case ProfileForm::half_gaussian:
      return {Eigen::VectorXd::Constant(1, elementary::log(12.0)), Eigen::VectorXd::Constant(1, elementary::log(50.0))};
    case ProfileForm::power_tail:
      return {log2(8.0, 1.0), log2(20.0, 3.0)};
    default:
      return {gaussians(6.0, 2.0, -0.2), gaussians(8.0, 3.0, 0.3), gaussians(15.0, 1.5, -1.0)};
  }
}

/// Values for people: the wide Gaussian's width instead of its ratio to the narrow one's.
Eigen::VectorXd toReportedValues(ProfileForm form, const Eigen::VectorXd& inner) {
  Eigen::VectorXd values = inner.unaryExpr(&elementary::exp);
  if (form != ProfileForm::two_gaussians) return values;
  values[1] *= values[0];
  values[2] = inner[2];
  return values;
}

double shareAt(ProfileForm form, const Eigen::VectorXd& values, double radius) {
  const auto bell = [radius](double width) { return elementary::exp(-elementary::square(radius / width)); };
  switch (form) {
    case ProfileForm::half_gaussian:
      return halfGaussian(radius / values[0]);
    case ProfileForm::power_tail:
      return elementary::pow(1.0 + elementary::square(radius / values[0]), -values[1]);
    default:
      return (1.0 - values[2]) * bell(values[0]) + values[2] * bell(values[1]);
  }
}

Eigen::ArrayXd sharesAt(ProfileForm form, const Eigen::VectorXd& inner, const Eigen::ArrayXd& radius) {
  const Eigen::VectorXd values = toReportedValues(form, inner);
  return radius.unaryExpr([&](double r) { return shareAt(form, values, r); });
}

/// u0 for these shares: the best where the middle was measured, else the skin touches the indenter there.
double surfaceOf(const Places& places, const Eigen::ArrayXd& shares) {
  if (!places.showsMiddle()) return places.depth;
  const Eigen::ArrayXd weighted = places.weights * shares;
  return (weighted * places.weights * places.down).sum() / weighted.square().sum();
}

BoundedFit solveDown(const Places& places, ProfileForm form, const std::vector<Eigen::VectorXd>& starts) {
  std::vector<Bounds> bounds;
  for (const ShapeNumber& number : innerNumbers(form)) bounds.push_back(number.inner);
  const auto residuals = [&](const Eigen::VectorXd& inner) -> Eigen::VectorXd {
    const Eigen::ArrayXd shares = sharesAt(form, inner, places.radius);
    return (places.weights * (surfaceOf(places, shares) * shares - places.down)).matrix();
  };
  return fitWithin(residuals, starts, bounds);
}

// --- sideways

double outwardTerm(double radius, double width) {
  const double q = radius / width;
  return q * elementary::exp(0.5 - 0.5 * q * q);
}

/// The two amplitudes for these widths.
Eigen::Vector2d solveAmplitudes(const Places& places, const Eigen::Vector2d& widths) {
  Eigen::MatrixXd terms(places.radius.size(), 2);
  for (Eigen::Index i = 0; i < places.radius.size(); ++i) {
    for (Eigen::Index k = 0; k < 2; ++k) terms(i, k) = places.weights[i] * outwardTerm(places.radius[i], widths[k]);
  }
  Eigen::Matrix2d normal = terms.transpose() * terms;
  normal.diagonal().array() += 1e-12 * normal.trace() + 1e-300;
  return solved(normal, terms.transpose() * (places.weights * places.outward).matrix());
}

Eigen::Vector2d toWidths(const Eigen::VectorXd& inner) {
  return {elementary::exp(inner[0]), elementary::exp(inner[0] + inner[1])};
}

void fitOutward(const Places& places, ProfileFit& fit) {
  const auto residuals = [&](const Eigen::VectorXd& inner) -> Eigen::VectorXd {
    const Eigen::Vector2d widths = toWidths(inner);
    const Eigen::Vector2d amplitudes = solveAmplitudes(places, widths);
    const auto motion = places.radius.unaryExpr([&](double r) {
      return amplitudes[0] * outwardTerm(r, widths[0]) + amplitudes[1] * outwardTerm(r, widths[1]);
    });
    return (places.weights * (motion - places.outward)).matrix();
  };
  const auto start = [](double narrow, double ratio) {
    return Eigen::VectorXd(Eigen::Vector2d(elementary::log(narrow), elementary::log(ratio)));
  };
  const BoundedFit solved =
      fitWithin(residuals, {start(4.0, 2.5), start(8.0, 2.0), start(15.0, 1.5)},
                {{elementary::log(1.0), elementary::log(80.0)}, {elementary::log(1.2), elementary::log(8.0)}});
  const Eigen::Vector2d widths = toWidths(solved.numbers);
  const Eigen::Vector2d amplitudes = solveAmplitudes(places, widths);
  fit.outward_mm = {amplitudes[0], amplitudes[1]};
  fit.outward_width_mm = {widths[0], widths[1]};
}

// --- through the places themselves

/// Neighbours averaged; those of one radius are one.
std::vector<ProfileKnot> averaged(const Eigen::ArrayXd& radius, const Eigen::ArrayXd& value) {
  const Eigen::Index in_each = (radius.size() + kMaxKnots - 1) / kMaxKnots;
  std::vector<ProfileKnot> knots;
  for (Eigen::Index begin = 0; begin < radius.size();) {
    Eigen::Index end = std::min(begin + in_each, radius.size());
    while (end < radius.size() && radius[end] == radius[end - 1]) ++end;
    const Eigen::Index count = end - begin;
    knots.push_back({radius.segment(begin, count).mean(), value.segment(begin, count).mean()});
    begin = end;
  }
  return knots;
}

/// Where a parabola through the innermost places meets the axis.
double extrapolateToAxis(const std::vector<ProfileKnot>& knots) {
  if (knots.front().q == 0.0) return knots.front().value;
  constexpr Eigen::Index kInner = 4;
  Eigen::MatrixXd terms(kInner, 2);
  Eigen::VectorXd values(kInner);
  for (Eigen::Index i = 0; i < kInner; ++i) {
    const ProfileKnot& knot = knots[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, knot.q * knot.q;
    values[i] = knot.value;
  }
  return solved(terms.transpose() * terms, terms.transpose() * values)(0);
}

RadialCurve curveThrough(std::vector<ProfileKnot> knots, double on_axis, double scale, UserInterpolation between) {
  for (ProfileKnot& knot : knots) knot.value *= scale;
  if (knots.front().q == 0.0) knots.erase(knots.begin());
  knots.insert(knots.begin(), {0.0, on_axis});
  RadialCurve curve{knots, knotSlopes(knots, between)};
  return curve;
}

double valueAt(const RadialCurve& curve, UserInterpolation between, double radius) {
  const double within = std::min(radius, curve.knots.back().q);
  return interpolatedKnots(curve.knots, curve.slopes, between, within).value;
}

double measuredSurface(const Places& places) {
  return places.showsMiddle() ? extrapolateToAxis(averaged(places.radius, places.down)) : places.depth;
}

void passThrough(const Places& places, ProfileFit& fit) {
  fit.surface_mm = measuredSurface(places);
  if (!(fit.surface_mm > 0.0)) {
    throw Error(fmt::format("depth {} mm: the skin is not pressed down at the centre", places.depth));
  }
  const double scale = 1.0 / fit.surface_mm;
  fit.measured_down = curveThrough(averaged(places.radius, places.down), 1.0, scale, UserInterpolation::monotone_cubic);
  if (places.outward.size() == 0) return;
  fit.measured_outward = curveThrough(averaged(places.radius, places.outward), 0.0, scale, UserInterpolation::linear);
}

// --- one depth

std::vector<FittedNumber> fittedShapeNumbers(ProfileForm form, const BoundedFit& solved) {
  const Eigen::VectorXd values = toReportedValues(form, solved.numbers);
  const Eigen::VectorXd errors = standardErrors(solved);
  std::vector<FittedNumber> numbers;
  Eigen::Index i = 0;
  for (const ShapeNumber& number : innerNumbers(form)) {
    const bool weight = number.name == "wide_weight";
    numbers.push_back(
        {number.name, values[i], errors[i] * (weight ? 1.0 : values[i]), solved.at_bound[static_cast<std::size_t>(i)]});
    ++i;
  }
  return numbers;
}

/// Without how well it does.
ProfileFit fitPlaces(const Places& places, ProfileForm form, const std::vector<Eigen::VectorXd>& starts,
                     Eigen::VectorXd* inner = nullptr) {
  ProfileFit fit;
  fit.form = form;
  fit.depth_mm = places.depth;
  fit.surface_measured = places.showsMiddle();
  fit.places = static_cast<std::size_t>(places.radius.size());
  if (form == ProfileForm::measured) {
    passThrough(places, fit);
    return fit;
  }
  const BoundedFit solved = solveDown(places, form, starts);
  fit.surface_mm = surfaceOf(places, sharesAt(form, solved.numbers, places.radius));
  fit.numbers = fittedShapeNumbers(form, solved);
  if (places.outward.size() > 0) fitOutward(places, fit);
  if (inner != nullptr) *inner = solved.numbers;
  return fit;
}

Eigen::ArrayXd downMisses(const ProfileFit& fit, const Places& places) {
  return places.radius.unaryExpr([&](double r) { return fit.surface_mm * downShare(fit, r); }) - places.down;
}

double unseenPlacesRms(const Places& places, const ProfileFit& fit, const Eigen::VectorXd& inner, double surface) {
  const Eigen::Index count = places.radius.size();
  double squares = 0.0;
  for (Eigen::Index fold = 0; fold < kPlaceFolds; ++fold) {
    Indices seen;
    Indices left_out;
    for (Eigen::Index i = 0; i < count; ++i) (i % kPlaceFolds == fold ? left_out : seen).push_back(i);
    Places part = somePlaces(places, seen);
    part.outward.resize(0);  // only the way down matters
    const Places unseen = somePlaces(places, left_out);
    squares += (unseen.areas * downMisses(fitPlaces(part, fit.form, {inner}), unseen).square()).sum();
  }
  return std::sqrt(squares) / surface;
}

}  // namespace

std::string_view nameOf(ProfileForm form) {
  constexpr std::array<std::string_view, kProfileForms.size()> kNames = {"half_gaussian", "power_tail", "two_gaussians",
                                                                         "measured"};
  return kNames.at(static_cast<std::size_t>(form));
}

double downShare(const ProfileFit& fit, double radius_mm) {
  if (fit.form == ProfileForm::measured) {
    return valueAt(fit.measured_down, UserInterpolation::monotone_cubic, radius_mm);
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(fit.numbers.size()));
  for (std::size_t i = 0; i < fit.numbers.size(); ++i) values[static_cast<Eigen::Index>(i)] = fit.numbers[i].value;
  return shareAt(fit.form, values, radius_mm);
}

double outwardShare(const ProfileFit& fit, double radius_mm) {
  if (fit.form == ProfileForm::measured) {
    if (fit.measured_outward.knots.empty()) return 0.0;
    return valueAt(fit.measured_outward, UserInterpolation::linear, radius_mm);
  }
  double motion = 0.0;
  for (std::size_t k = 0; k < 2; ++k) motion += fit.outward_mm[k] * outwardTerm(radius_mm, fit.outward_width_mm[k]);
  return motion / fit.surface_mm;
}

ProfileFit fitProfile(const SkinProfile& profile, ProfileForm form) {
  const Places places = skinPlaces(profile);
  const double surface = measuredSurface(places);
  if (!(surface > 0.0)) {
    throw Error(fmt::format("depth {} mm: the skin is not pressed down at the centre", profile.depth_mm));
  }
  Eigen::VectorXd inner;
  ProfileFit fit = fitPlaces(places, form, shapeStarts(form), &inner);
  const Eigen::ArrayXd misses = downMisses(fit, places);
  fit.rms = std::sqrt((places.areas * misses.square()).sum()) / surface;
  fit.largest_miss = misses.abs().maxCoeff() / surface;
  fit.unseen_rms = unseenPlacesRms(places, fit, inner, surface);
  if (places.outward.size() == 0) return fit;
  const Eigen::ArrayXd sideways =
      places.radius.unaryExpr([&](double r) { return fit.surface_mm * outwardShare(fit, r); }) - places.outward;
  fit.vector_rms = std::sqrt((places.areas * (misses.square() + sideways.square())).sum()) / surface;
  return fit;
}

}  // namespace palpate::tissue
