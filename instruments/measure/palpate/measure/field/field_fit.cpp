// Levenberg and Marquardt's method on the motions of all dots at once. The dots show how far the body moved between the
// pictures as well as how the skin was dragged: both are unknowns of one fit, the first with a prior. So are bends of
// the body that a similarity does not have: left out, they stretch long tails by a tenth unnoticed. Each dot counts by
// its certainty (estimateSds); a dot that nothing explains counts less (pseudo-Huber). First the form with one ellipse,
// from four starts; then, from the best, sideways motion too.
//
// The dots lie 30 mm apart and do not see the core of the field; several forms may explain them about equally well and
// differ by a tenth at 2 mm and by half at the peak. So every form is fitted, and each counts by how well it does
// (computeFormWeights): their difference is part of the uncertainty (field_report.h).
//
// Based on: Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963; Charbonnier et al.,
// "Deterministic edge-preserving regularization in computed imaging", 1997 (pseudo-Huber by reweighting).
#include "palpate/measure/field/field_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/order_statistics.h"
#include "palpate/measure/field/field_form.h"
#include "palpate/tissue/solved_drag.h"

namespace palpate::measure {

namespace {

enum Unknown : int {
  kContact = 0,
  kMeanShape = 2,
  kDeviator = 3,
  kPeak = 5,
  kTail = 7,
  kSideways = 8,
  kPressed = 9,
  kDrift = kFirstDrift
};

// Priors, before the dots are looked at.
constexpr double kTailMean = 0.8;  // mean of 1/P: from the half Gaussian, 0, to a half space's long tail, 1 to 1.8
constexpr double kTailSd = 0.8;
constexpr double kTailMost = 2.0;
static_assert(kTailMost == tissue::kSolvedLongestTail);

/// Priors that a form has in addition.
struct FormPrior {
  double elongation_sd = 0.0;  ///< sd of ln(a/b)
  double sideways_mean = 0.0;  ///< mean of kappa
  double sideways_sd = 0.0;
  bool presses = false;  ///< skin that moves outwards all around the stick
  double shape_mean = 0.0;
  double shape_sd = 0.0;  ///< sd of the mean of ln W; 0: nothing is known
};

/// The solved one has the ellipse of the drag in itself, and its size from the stick's tip: 6 mm, give or take a third.
/// For the others, kappa of a half space of incompressible matter is 1.
FormPrior formPrior(FieldForm form) {
  if (form == FieldForm::deep)
    return {.elongation_sd = 0.35, .sideways_mean = 0.95, .sideways_sd = 0.1, .presses = true};
  if (form != FieldForm::solved) return {.elongation_sd = 0.7, .sideways_sd = 1.5};
  return {.elongation_sd = 0.35,
          .sideways_sd = 0.25,
          .presses = true,
          .shape_mean = -2.0 * std::log(tissue::kSolvedPatchMm),
          .shape_sd = 2.0 * 0.35};
}

// The peak lies between the dots, under the stick, and a long tail's core is narrow: the unseen part is bounded,
// softly.
constexpr double kMaxPeakMm = 30.0;    // skin is not dragged farther
constexpr double kPeakOverSeen = 3.0;  // times the largest motion: no core is narrower than stick and skin make it
constexpr double kPeakSd = 0.1;        // share of that bound
constexpr double kPressedFarSd =
    0.15;  // Boussinesq against Cerruti where nu is 0.4 and the press as strong as the drag
constexpr double kPressedNearSd = 0.7;
constexpr double kNone = 1e-4;
constexpr double kSidewaysLeast = -0.9;
constexpr double kSidewaysMost = 4.0;
// Relative to the shift of a body that breathes or rolls between the pictures: a turn about the spine by 0.06 degrees
// lowers the flanks by 0.05 mm.
constexpr double kStretchOfDrift = 0.1;
constexpr double kBendOfDrift = 0.035;
constexpr int kStretches = 2;               // the first bends are stretches
constexpr double kShapeLeast = -14.0;       // mean of ln W: radii to 1.1 m
constexpr double kShapeMost = -2.2;         // ... from 3 mm
constexpr double kSolvedShapeLeast = -4.8;  // ln(1/mm^2) for the patch under the stick: to 11 mm

// Weights: noise of marks and chart, which grows with the displacement itself.
constexpr double kMinSdMm = 0.08;
constexpr double kSdMedians = 1.8;           // in medians of the residuals
constexpr double kSdOfMotion = 0.04;         // the chart's own error
constexpr double kResidualOfFormMm = 0.115;  // root mean square; more means that the field is not of this form
constexpr double kMinScatter = 0.5;          // chart errors are alike from dot to dot and leave small residuals
constexpr double kFirstSdMm = 0.15;          // before there are residuals
constexpr double kRobustSds = 3.0;           // beyond, a dot counts less
constexpr int kLookSteps = 6;                // steps per start before the best is chosen
constexpr int kMaxSteps = 40;
constexpr double kConverged = 1e-5;  // decrease of the cost, of it
constexpr std::array kStartTails = {0.1, 1.2};
constexpr std::array kStartWidthsMm = {35.0, 70.0};
constexpr std::array kPointedStartWidthsMm = {15.0, 40.0};
constexpr std::array kSolvedStartWidthsMm = {tissue::kSolvedPatchMm};
constexpr std::array kSolvedStartTails = {0.4, 1.0, 1.7};
constexpr std::array kDeepStartTails = {0.8};
constexpr double kMinShare = 0.01;  // a less likely form is left out
/// Errors of the chart and of every form are alike from dot to dot: chi2 differs by more than chance has it.
constexpr double kChanceOfCost = 2.0;
constexpr double kSmoothBefore = 2.0;  // prior odds against each other form, before the dots are looked at

using Jacobian = Eigen::Matrix<double, 2, kFieldUnknowns>;

/// W from the shape's three numbers, and its derivatives by the two deviators.
struct Shape {
  Mat2 w;
  std::array<Mat2, 2> by_deviator;
};

Shape shapeOf(const FieldNumbers& n) {
  const double d1 = n[kDeviator];
  const double d2 = n[kDeviator + 1];
  const double s = std::hypot(d1, d2);
  const bool is_round = s < 1e-4;
  const double sinhc = is_round ? 1.0 + s * s / 6.0 : std::sinh(s) / s;
  const double sinhc_slope = is_round ? 1.0 / 3.0 : (std::cosh(s) - sinhc) / (s * s);  // derivative over s
  Mat2 deviator;
  deviator << d1, d2, d2, -d1;
  Mat2 first;
  first << 1.0, 0.0, 0.0, -1.0;
  Mat2 second;
  second << 0.0, 1.0, 1.0, 0.0;
  const double size = std::exp(n[kMeanShape]);
  Shape shape;
  shape.w = size * (std::cosh(s) * Mat2::Identity() + sinhc * deviator);
  shape.by_deviator[0] = size * (sinhc * d1 * Mat2::Identity() + sinhc_slope * d1 * deviator + sinhc * first);
  shape.by_deviator[1] = size * (sinhc * d2 * Mat2::Identity() + sinhc_slope * d2 * deviator + sinhc * second);
  return shape;
}

constexpr int kDriftUnknowns = kFieldUnknowns - kFirstDrift;
using DriftSlope = Eigen::Matrix<double, 2, kDriftUnknowns>;

/// Motions in the picture, mm, for one of each unknown of the drift: a similarity, then bends.
DriftSlope driftSlopeAt(const Vec2& picture_mm) {
  const double x = 0.01 * picture_mm.x();
  const double y = 0.01 * picture_mm.y();
  DriftSlope slope;
  slope << 1.0, 0.0, x, -y, x, y, x * x, x * y, y * y, 0.0, 0.0, 0.0,  //
      0.0, 1.0, y, x, -y, x, 0.0, 0.0, 0.0, x * x, x * y, y * y;
  return slope;
}

/// Displacement of the skin at a dot with its drift; and its derivatives.
Vec2 modelAt(FieldForm form, const FieldNumbers& n, const Shape& shape, const FieldDatum& datum, Vec2& dragged,
             Jacobian* slope) {
  const Vec2 offset = datum.skin_mm - n.segment<2>(kContact);
  const Vec2 peak = n.segment<2>(kPeak);
  const Vec2 weighed = shape.w * offset;
  const double rho2 = offset.dot(weighed);
  const FormValue f = formAt(form, rho2, n[kTail], n[kSideways]);
  const double distance2 = std::max(offset.squaredNorm(), 1e-9);
  const double along = offset.dot(peak);
  const Vec2 radial = along / distance2 * offset;  // (e . peak) e
  const Vec2 pressed = n.segment<2>(kPressed);
  const PressShape press = pressShapeAt(rho2);
  const double peak_mm = std::max(peak.norm(), 1e-9);
  const double per_radius = std::exp(0.5 * n[kMeanShape]);
  const double outwards = peak_mm * per_radius * press.value.dot(pressed);
  dragged = f.round * peak + f.radial * radial + outwards * offset;
  if (slope) {
    const Vec2 by_rho2 =
        f.round_by_rho2 * peak + f.radial_by_rho2 * radial + peak_mm * per_radius * press.by_rho2.dot(pressed) * offset;
    const Mat2 radial_by_offset = (offset * peak.transpose() + along * Mat2::Identity()) / distance2 -
                                  2.0 * along / (distance2 * distance2) * offset * offset.transpose();
    Jacobian& j = *slope;
    j.middleCols<2>(kContact) =
        -2.0 * by_rho2 * weighed.transpose() - f.radial * radial_by_offset - outwards * Mat2::Identity();
    j.col(kMeanShape) = by_rho2 * rho2 + 0.5 * outwards * offset;
    for (int i = 0; i < 2; ++i)
      j.col(kDeviator + i) = by_rho2 * offset.dot(shape.by_deviator[static_cast<std::size_t>(i)] * offset);
    j.middleCols<2>(kPeak) = f.round * Mat2::Identity() + f.radial / distance2 * offset * offset.transpose() +
                             outwards / (peak_mm * peak_mm) * offset * peak.transpose();
    j.middleCols<2>(kPressed) = peak_mm * per_radius * offset * press.value.transpose();
    j.col(kTail) = f.round_by_tail * peak + f.radial_by_tail * radial;
    j.col(kSideways) = f.round_by_sideways * peak + f.radial_by_sideways * radial;
    j.rightCols<kDriftUnknowns>() = datum.to_skin * driftSlopeAt(datum.picture_mm);
    return dragged + j.rightCols<kDriftUnknowns>() * n.tail<kDriftUnknowns>();
  }
  return dragged + driftAt(n, datum);
}

/// The normal equations of the data and of the priors, apart, and the cost of both.
struct Normal {
  FieldCovariance data = FieldCovariance::Zero();
  FieldCovariance prior = FieldCovariance::Zero();
  FieldNumbers gradient = FieldNumbers::Zero();
  double cost = 0.0;
};

/// Prior knowledge, before the dots are fitted.
struct Prior {
  FieldForm form = FieldForm::smooth;
  DriftPrior drift;
  double peak_mm = kMaxPeakMm;
};

void addPrior(const FieldNumbers& n, const Prior& prior, Normal& normal) {
  const auto expect = [&](int unknown, double mean, double sd) {
    const double off = (n[unknown] - mean) / sd;
    normal.prior(unknown, unknown) += 1.0 / (sd * sd);
    normal.gradient[unknown] += off / sd;
    normal.cost += off * off;
  };
  expect(kTail, kTailMean, kTailSd);
  const FormPrior form = formPrior(prior.form);
  expect(kDeviator, 0.0, form.elongation_sd);
  expect(kDeviator + 1, 0.0, form.elongation_sd);
  expect(kSideways, form.sideways_mean, form.sideways_sd);
  if (form.shape_sd > 0.0) expect(kMeanShape, form.shape_mean, form.shape_sd);
  expect(kPressed, 0.0, form.presses ? kPressedFarSd : kNone);
  expect(kPressed + 1, 0.0, form.presses ? kPressedNearSd : kNone);
  expect(kDrift, 0.0, prior.drift.shift_mm);
  expect(kDrift + 1, 0.0, prior.drift.shift_mm);
  expect(kDrift + 2, 0.0, prior.drift.scale);
  expect(kDrift + 3, 0.0, prior.drift.turn);
  for (int i = kFirstBend; i < kFieldUnknowns; ++i)
    expect(i, 0.0, prior.drift.shift_mm * (i < kFirstBend + kStretches ? kStretchOfDrift : kBendOfDrift));
  const Vec2 peak = n.segment<2>(kPeak);
  const double over = (peak.norm() / prior.peak_mm - 1.0) / kPeakSd;
  if (over > 0.0) {
    const Vec2 outward = peak.normalized() / (kPeakSd * prior.peak_mm);
    normal.prior.block<2, 2>(kPeak, kPeak) += outward * outward.transpose();
    normal.gradient.segment<2>(kPeak) += over * outward;
    normal.cost += over * over;
  }
}

/// Adds w J'J, upper triangle, and J'(w off): plain loops, which the compiler turns into wide ones.
void accumulate(const Jacobian& slope, const Vec2& weighed_off, double weight, int unknowns, Normal& normal) {
  for (int i = 0; i < unknowns; ++i) {
    normal.gradient[i] += slope(0, i) * weighed_off.x() + slope(1, i) * weighed_off.y();
    const double first = weight * slope(0, i);
    const double second = weight * slope(1, i);
    for (int j = 0; j <= i; ++j) normal.data(j, i) += first * slope(0, j) + second * slope(1, j);
  }
}

Normal buildNormalEquations(std::span<const FieldDatum> data, std::span<const double> sd_mm, const FieldNumbers& n,
                            const Prior& prior, int unknowns) {
  Normal normal;
  const Shape shape = shapeOf(n);
  Jacobian slope;
  Vec2 dragged;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double inverse = 1.0 / sd_mm[i];
    const Vec2 off = inverse * (modelAt(prior.form, n, shape, data[i], dragged, &slope) - data[i].moved_mm);
    const double root = std::sqrt(1.0 + off.squaredNorm() / (kRobustSds * kRobustSds));
    normal.cost += 2.0 * kRobustSds * kRobustSds * (root - 1.0);
    const double weight = inverse / root;
    accumulate(slope, weight * off, weight * inverse, unknowns, normal);
  }
  addPrior(n, prior, normal);
  if (!std::isfinite(normal.cost)) normal.cost = std::numeric_limits<double>::infinity();
  return normal;
}

double minShape(FieldForm form) { return form == FieldForm::solved ? kSolvedShapeLeast : kShapeLeast; }

FieldNumbers clamped(FieldNumbers n, FieldForm form) {
  n[kTail] = std::clamp(n[kTail], 0.0, kTailMost);
  n[kSideways] = std::clamp(n[kSideways], kSidewaysLeast, kSidewaysMost);
  n[kMeanShape] = std::clamp(n[kMeanShape], minShape(form), kShapeMost);
  return n;
}

/// Free part of the form: first without sideways motion, then with it, in the end with the bends of the body too.
enum class Freedom : unsigned char { plain, sideways, bends };

int unknownCount(Freedom freedom) { return freedom == Freedom::bends ? kFieldUnknowns : kFirstBend; }

/// Unknowns that stay as they are: those that are not free yet, and what would leave its bounds.
std::array<bool, kFieldUnknowns> findHeldUnknowns(const FieldNumbers& n, const FieldNumbers& gradient, FieldForm form,
                                                  Freedom freedom) {
  std::array<bool, kFieldUnknowns> held = {};
  held[kSideways] = freedom == Freedom::plain;
  held[kPressed] = held[kPressed + 1] = freedom != Freedom::bends;
  for (std::size_t i = static_cast<std::size_t>(unknownCount(freedom)); i < held.size(); ++i) held[i] = true;
  const auto hold_at = [&](int unknown, double low, double high) {
    const auto at = static_cast<std::size_t>(unknown);
    held[at] =
        held[at] || (n[unknown] <= low && gradient[unknown] > 0.0) || (n[unknown] >= high && gradient[unknown] < 0.0);
  };
  hold_at(kTail, 0.0, kTailMost);
  hold_at(kSideways, kSidewaysLeast, kSidewaysMost);
  hold_at(kMeanShape, minShape(form), kShapeMost);
  return held;
}

FieldNumbers dampedStep(const Normal& normal, double damping, const std::array<bool, kFieldUnknowns>& held) {
  FieldCovariance matrix = normal.data.selfadjointView<Eigen::Upper>();
  matrix += normal.prior;
  FieldNumbers right = -normal.gradient;
  for (int i = 0; i < kFieldUnknowns; ++i) {
    if (held[static_cast<std::size_t>(i)]) {
      matrix.row(i).setZero();
      matrix.col(i).setZero();
      matrix(i, i) = 1.0;
      right[i] = 0.0;
    }
    matrix(i, i) *= 1.0 + damping;
    matrix(i, i) += 1e-12;
  }
  return matrix.ldlt().solve(right);
}

struct Descent {
  FieldNumbers numbers = FieldNumbers::Zero();
  double cost = std::numeric_limits<double>::infinity();
};

Descent descend(std::span<const FieldDatum> data, std::span<const double> sd_mm, FieldNumbers n, const Prior& prior,
                Freedom freedom, int most_steps) {
  double damping = 1e-2;
  Normal normal = buildNormalEquations(data, sd_mm, n, prior, unknownCount(freedom));
  for (int step = 0; step < most_steps; ++step) {
    const FieldNumbers tried =
        clamped(n + dampedStep(normal, damping, findHeldUnknowns(n, normal.gradient, prior.form, freedom)), prior.form);
    const Normal there = buildNormalEquations(data, sd_mm, tried, prior, unknownCount(freedom));
    if (there.cost < normal.cost) {
      const bool is_done = normal.cost - there.cost < kConverged * normal.cost;
      n = tried;
      normal = there;
      damping = std::max(damping * 0.1, 1e-9);
      if (is_done) break;
    } else {
      damping *= 5.0;
      if (damping > 1e5) break;
    }
  }
  return {n, normal.cost};
}

/// The contact where the skin moved most, the body at rest.
FieldNumbers estimateStart(std::span<const FieldDatum> data, double tail, double width_mm) {
  std::vector<std::size_t> order(data.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t top = std::min<std::size_t>(5, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(top), order.end(),
      [&](std::size_t a, std::size_t b) { return data[a].moved_mm.squaredNorm() > data[b].moved_mm.squaredNorm(); });
  FieldNumbers n = FieldNumbers::Zero();
  double weights = 1e-12;
  for (std::size_t i = 0; i < top; ++i) {
    const FieldDatum& datum = data[order[i]];
    const double weight = datum.moved_mm.squaredNorm();
    n.segment<2>(kContact) += weight * datum.skin_mm;
    n.segment<2>(kPeak) += weight * datum.moved_mm;
    weights += weight;
  }
  n.segment<2>(kContact) /= weights;
  n.segment<2>(kPeak) *= 1.2 / weights;
  n[kMeanShape] = -2.0 * std::log(width_mm);
  n[kTail] = tail;
  return n;
}

Prior makePrior(std::span<const FieldDatum> data, const DriftPrior& drift, FieldForm form) {
  double seen = 0.0;
  for (const FieldDatum& datum : data) seen = std::max(seen, datum.moved_mm.norm());
  return {form, drift, std::clamp(kPeakOverSeen * seen, 1.0, kMaxPeakMm)};
}

/// Where the skin is seen at a grazing angle a pixel is many millimetres.
double computeStretch(const FieldDatum& datum) {
  return std::max(1.0, Eigen::JacobiSVD<Mat2>(datum.to_skin).singularValues()[0]);
}

std::vector<double> computeResiduals(std::span<const FieldDatum> data, FieldForm form, const FieldNumbers& n) {
  std::vector<double> residuals;
  const Shape shape = shapeOf(n);
  Vec2 dragged;
  for (const FieldDatum& datum : data)
    residuals.push_back((modelAt(form, n, shape, datum, dragged, nullptr) - datum.moved_mm).norm());
  return residuals;
}

std::vector<double> estimateSds(std::span<const FieldDatum> data, std::span<const double> stretches, FieldForm form,
                                const FieldNumbers& n) {
  constexpr double kComponentOfLength = 0.6745 / 1.1774;  // medians of a component and of a length of two
  const double noise =
      std::max(kMinSdMm, kSdMedians * kComponentOfLength * upperMedianOf(computeResiduals(data, form, n)));
  std::vector<double> sd;
  const Shape shape = shapeOf(n);
  for (std::size_t i = 0; i < data.size(); ++i) {
    Vec2 dragged;
    modelAt(form, n, shape, data[i], dragged, nullptr);
    sd.push_back(std::hypot(noise, kSdOfMotion * dragged.norm()) * stretches[i]);
  }
  return sd;
}

/// Covariance by the observed scatter, for the data; priors keep theirs. All of it is less sure where the residuals
/// show that the skin did not move as in the form.
FieldCovariance computeCovariance(std::span<const FieldDatum> data, std::span<const double> sd_mm,
                                  const FieldNumbers& n, const Prior& prior) {
  const Normal normal = buildNormalEquations(data, sd_mm, n, prior, kFieldUnknowns);
  const std::vector<double> residuals = computeResiduals(data, prior.form, n);
  double chi2 = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    squares += residuals[i] * residuals[i];
    const double off2 = residuals[i] * residuals[i] / (sd_mm[i] * sd_mm[i]);
    chi2 += off2 / std::sqrt(1.0 + off2 / (kRobustSds * kRobustSds));
  }
  const double freedom = std::max(1.0, 2.0 * static_cast<double>(data.size()) - kFirstBend);
  FieldCovariance information = normal.data.selfadjointView<Eigen::Upper>();
  information /= std::max(chi2 / freedom, kMinScatter);
  information += normal.prior + 1e-12 * FieldCovariance::Identity();
  const double mean_square = squares / static_cast<double>(std::max<std::size_t>(1, data.size()));
  const double misfit = std::max(1.0, mean_square / (kResidualOfFormMm * kResidualOfFormMm));
  return misfit * information.ldlt().solve(FieldCovariance::Identity());
}

std::vector<double> computeStretches(std::span<const FieldDatum> data) {
  std::vector<double> stretches;
  for (const FieldDatum& datum : data) stretches.push_back(computeStretch(datum));
  return stretches;
}

std::span<const double> startWidths(FieldForm form) {
  switch (form) {
    case FieldForm::smooth:
    case FieldForm::deep:
      return kStartWidthsMm;
    case FieldForm::pointed:
      return kPointedStartWidthsMm;
    case FieldForm::solved:
      break;
  }
  return kSolvedStartWidthsMm;
}

std::span<const double> startTails(FieldForm form) {
  if (form == FieldForm::solved) return kSolvedStartTails;
  if (form == FieldForm::deep) return kDeepStartTails;
  return kStartTails;
}

/// Contact and drift from `known`, where there is one.
FittedField fitOne(std::span<const FieldDatum> data, const DriftPrior& drift, std::span<const double> stretches,
                   FieldForm form, const FieldNumbers* known) {
  const Prior prior = makePrior(data, drift, form);
  std::vector<double> sd;
  for (const double stretch : stretches) sd.push_back(kFirstSdMm * stretch);
  Descent best;
  for (const double tail : startTails(form)) {
    for (const double width : startWidths(form)) {
      FieldNumbers start = estimateStart(data, tail, width);
      if (known != nullptr) {
        start.segment<2>(kContact) = known->segment<2>(kContact);
        start.segment<kFirstBend - kDrift>(kDrift) = known->segment<kFirstBend - kDrift>(kDrift);
      }
      const Descent found = descend(data, sd, start, prior, Freedom::plain, kLookSteps);
      if (found.cost < best.cost) best = found;
    }
  }
  for (const Freedom freedom : {Freedom::plain, Freedom::sideways, Freedom::bends}) {
    sd = estimateSds(data, stretches, form, best.numbers);
    best = descend(data, sd, best.numbers, prior, freedom, kMaxSteps);
  }
  return {form, best.numbers, computeCovariance(data, sd, best.numbers, prior),
          computeResiduals(data, form, best.numbers)};
}

/// Weight of each form: by its residuals, all of them held against the noise of the best.
std::vector<double> computeFormWeights(std::span<const FieldDatum> data, const DriftPrior& drift,
                                       std::span<const double> stretches, std::span<const FittedField> forms) {
  const auto best = std::min_element(forms.begin(), forms.end(), [](const FittedField& a, const FittedField& b) {
    return upperMedianOf(a.residuals_mm) < upperMedianOf(b.residuals_mm);
  });
  const std::vector<double> sd = estimateSds(data, stretches, best->form, best->numbers);
  std::vector<double> costs;
  for (const FittedField& form : forms) {
    costs.push_back(
        buildNormalEquations(data, sd, form.numbers, makePrior(data, drift, form.form), kFieldUnknowns).cost);
  }
  const double least = *std::min_element(costs.begin(), costs.end());
  const double freedom = std::max(1.0, 2.0 * static_cast<double>(data.size()) - kFirstBend);
  const double chance = kChanceOfCost * std::max(1.0, least / freedom);
  std::vector<double> shares;
  double sum = 0.0;
  for (const double cost : costs) {
    const double before = forms[shares.size()].form == FieldForm::smooth ? kSmoothBefore : 1.0;
    const double share = before * std::exp(-0.5 * (cost - least) / chance);
    shares.push_back(share > kMinShare ? share : 0.0);
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

SkinField toSkinField(const FieldNumbers& n, FieldForm form) {
  const double mean = n[kMeanShape];
  return {n.segment<2>(kContact),
          {mean + n[kDeviator], n[kDeviator + 1], mean - n[kDeviator]},
          n.segment<2>(kPeak),
          std::clamp(n[kTail], 0.0, kTailMost),
          std::clamp(n[kSideways], kSidewaysLeast, kSidewaysMost),
          n.segment<2>(kPressed),
          form};
}

Vec2 driftAt(const FieldNumbers& numbers, const FieldDatum& datum) {
  return datum.to_skin * (driftSlopeAt(datum.picture_mm) * numbers.tail<kDriftUnknowns>());
}

DriftPrior makeDriftPrior(double drift_mm) {
  const DriftPrior held;
  const double times = drift_mm / held.shift_mm;
  return {drift_mm, held.scale * times, held.turn * times};
}

FittedField fitField(std::span<const FieldDatum> data, const DriftPrior& drift) {
  return fitOne(data, drift, computeStretches(data), FieldForm::smooth, nullptr);
}

std::vector<WeighedField> fitForms(std::span<const FieldDatum> data, const DriftPrior& drift) {
  const std::vector<double> stretches = computeStretches(data);
  std::vector<FittedField> forms = {fitOne(data, drift, stretches, FieldForm::smooth, nullptr)};
  for (const FieldForm form : {FieldForm::pointed, FieldForm::deep, FieldForm::solved}) {
    const FieldNumbers known = forms.front().numbers;
    forms.push_back(fitOne(data, drift, stretches, form, &known));
  }
  const std::vector<double> shares = computeFormWeights(data, drift, stretches, forms);
  std::vector<WeighedField> weighed;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (shares[i] > 0.0) weighed.push_back({std::move(forms[i]), shares[i]});
  }
  std::stable_sort(weighed.begin(), weighed.end(),
                   [](const WeighedField& a, const WeighedField& b) { return a.share > b.share; });
  return weighed;
}

Eigen::Vector4d fitDrift(std::span<const FieldDatum> data, const DriftPrior& prior) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  const Eigen::Vector4d prior_sd(prior.shift_mm, prior.shift_mm, prior.scale, prior.turn);
  matrix.diagonal() = prior_sd.array().square().inverse();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const double weight = 1.0 / (kFirstSdMm * kFirstSdMm);
  for (const FieldDatum& datum : data) {
    const Eigen::Matrix<double, 2, 4> slope = datum.to_skin * driftSlopeAt(datum.picture_mm).leftCols<4>();
    matrix += weight * slope.transpose() * slope;
    right += weight * slope.transpose() * datum.moved_mm;
  }
  return matrix.ldlt().solve(right);
}

}  // namespace palpate::measure
