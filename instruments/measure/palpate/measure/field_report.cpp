// Half axes depend on peak, width and tail together, and on none of them in a straight line: 300 draws from the
// covariances of the fitted forms, each by its weight, give their certainty.
#include "palpate/measure/field_report.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/measure/field/field_form.h"

namespace palpate::measure {

namespace {

constexpr int kDrawsOfFit = 300;
constexpr double kSlopeStep = 0.02;  // in sds
constexpr int kRaysOfDraw = 24;
constexpr int kRootSteps = 12;
constexpr int kHalvings = 24;
constexpr double kFarthestRho = 1e4;
constexpr std::uint64_t kSeed = 20080611;  // seed of the draws: any, but always the same
/// ln(q) of the half Gaussian at its rim (E20): the dissertation cuts off at exp(-6.158).
constexpr double kGaussianRim = 6.158;
/// A peak that no dot saw is extrapolated: this share of it counts as unsure.
constexpr double kSdOfUnseen = 0.25;
constexpr double kSdOfUnseenDeep = 0.6;  // the spread of the stick's load is not seen either
constexpr double kCoreShare = 0.5;       // share of the peak: where the skin moves farther is the core
/// An ellipse around few dots is read between them: this share over (1 + dots)^1.5 counts as unsure. Both from pairs
/// outside the fitted forms (docs/explanation/measuring.md).
constexpr double kSdBetweenDots = 0.2;
/// Relative sd of a half axis: six stacks represent all skin over bone.
constexpr double kSdOfSolved = 0.013;
constexpr double kSdOfDeep = 0.02;     // spread of the stick's load
constexpr double kCompactTail = 0.45;  // in 1/P: above it a tail has no rim

/// rho^2 along a ray at which the motion falls to the level; 0 where even the peak is below.
double smoothLevelOnRay(const SkinField& field, const Vec2& ray, double level_mm) {
  const Vec2 radial = ray.dot(field.peak_mm) * ray;
  const double k = field.inverse_tail;
  const auto strength = [&](double rho2) {
    return (field.peak_mm + field.sideways * rho2 / (1.0 + rho2) * radial).norm();
  };
  // Without sideways motion in closed form; with it, the strength of the last round replaces the peak.
  const auto solved = [&](double peak) {
    const double logarithm = std::log(peak / level_mm);
    if (logarithm <= 0.0) return 0.0;
    return k > 1e-6 ? std::expm1(k * logarithm) / k : logarithm;
  };
  double rho2 = solved(field.peak_mm.norm());
  for (int i = 0; i < kRootSteps && field.sideways != 0.0; ++i) {
    const double next = solved(strength(rho2));
    if (std::abs(next - rho2) < 1e-9 * (1.0 + rho2)) break;
    rho2 = next;
  }
  return rho2;
}

double levelOnRay(const SkinField& field, const Vec2& ray, double level_mm) {
  if (field.form == FieldForm::smooth) return smoothLevelOnRay(field, ray, level_mm);
  const Vec2 radial = ray.dot(field.peak_mm) * ray;
  const auto moved = [&](double rho) {
    const FormValue value = formAt(field.form, rho * rho, field.inverse_tail, field.sideways);
    return (value.round * field.peak_mm + value.radial * radial).norm();
  };
  if (!(moved(0.0) > level_mm)) return 0.0;
  double low = 0.0;
  double high = 1.0;
  while (moved(high) > level_mm && high < kFarthestRho) {
    low = high;
    high *= 2.0;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (moved(middle) > level_mm ? low : high) = middle;
  }
  return 0.25 * (low + high) * (low + high);
}

Mat2 shapeMatrix(const Vec3& log_shape) {
  Mat2 logarithm;
  logarithm << log_shape[0], log_shape[1], log_shape[1], log_shape[2];
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(logarithm);
  return axes.eigenvectors() * axes.eigenvalues().array().exp().matrix().asDiagonal() * axes.eigenvectors().transpose();
}

double halfTurn(double angle_rad) {
  const double folded = std::remainder(angle_rad, std::numbers::pi);
  return folded <= -0.5 * std::numbers::pi ? folded + std::numbers::pi : folded;
}

struct Reported {
  FieldForm form = FieldForm::smooth;
  std::array<LevelEllipse, 2> levels;
  Vec2 contact = Vec2::Zero();
  double peak = 0.0;
  double drag = 0.0;
  double tail = 0.0;
  double sideways = 0.0;
  Vec2 drift = Vec2::Zero();
};

constexpr std::array kLevelsMm = {2.0, 4.0};

/// The skin's y is up and its x to the right; drift in the skin's frame.
Reported deriveReported(const FieldNumbers& numbers, FieldForm form, const Mat2& mean_to_skin, int rays) {
  const SkinField field = toSkinField(numbers, form);
  Reported r;
  r.form = form;
  for (std::size_t i = 0; i < kLevelsMm.size(); ++i) r.levels[i] = levelEllipse(field, kLevelsMm[i], rays);
  r.contact = field.contact_mm;
  r.peak = field.peak_mm.norm();
  r.drag = std::atan2(field.peak_mm.y(), field.peak_mm.x());
  r.tail = field.inverse_tail;
  r.sideways = field.sideways;
  r.drift = mean_to_skin * numbers.segment<2>(kFirstDrift);
  return r;
}

/// Root of the mean square difference of the draws from the estimate.
template <class Difference>
double spread(const std::vector<Reported>& draws, const Difference& difference) {
  double sum = 0.0;
  for (const Reported& draw : draws) {
    const double off = difference(draw);
    sum += off * off;
  }
  return draws.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(draws.size()));
}

constexpr std::size_t kAxes = 2 * kLevelsMm.size();
using AxisSlopes = Eigen::Matrix<double, kAxes, kFieldUnknowns>;

Eigen::Vector<double, kAxes> logAxes(const Reported& reported) {
  Eigen::Vector<double, kAxes> logarithms;
  for (std::size_t i = 0; i < kLevelsMm.size(); ++i) {
    logarithms[2 * static_cast<Eigen::Index>(i)] = std::log(std::max(reported.levels[i].half_major_mm, 1e-3));
    logarithms[2 * static_cast<Eigen::Index>(i) + 1] = std::log(std::max(reported.levels[i].half_minor_mm, 1e-3));
  }
  return logarithms;
}

/// Slopes of the half axes' logarithms by every unknown in its sd; forwards, away from the bound of the tail at 0.
AxisSlopes computeAxisSlopes(const FittedField& fitted, const Mat2& mean_to_skin) {
  const Eigen::Vector<double, kAxes> here =
      logAxes(deriveReported(fitted.numbers, fitted.form, mean_to_skin, kRaysOfDraw));
  AxisSlopes slopes = AxisSlopes::Zero();
  for (int i = 0; i < kFirstDrift; ++i) {
    const double step = kSlopeStep * std::sqrt(fitted.covariance(i, i));
    FieldNumbers numbers = fitted.numbers;
    numbers[i] += step;
    slopes.col(i) = (logAxes(deriveReported(numbers, fitted.form, mean_to_skin, kRaysOfDraw)) - here) / step;
  }
  return slopes;
}

/// Peak and core of the deep form depend on each other, and the core leans on its bounds: what is sure of the axes
/// would be lost in draws. Their logarithms are carried on in straight lines.
void straighten(const Eigen::Vector<double, kAxes>& logarithms, Reported& draw) {
  for (std::size_t i = 0; i < kLevelsMm.size(); ++i) {
    draw.levels[i].half_major_mm = std::exp(logarithms[2 * static_cast<Eigen::Index>(i)]);
    draw.levels[i].half_minor_mm = std::exp(logarithms[2 * static_cast<Eigen::Index>(i) + 1]);
  }
}

std::vector<Reported> samplePosterior(std::span<const WeighedField> forms, const Mat2& mean_to_skin) {
  std::vector<Reported> draws;
  Random random(kSeed);
  for (const auto& [fitted, share] : forms) {
    const Eigen::LLT<FieldCovariance> root(fitted.covariance);
    if (root.info() != Eigen::Success) continue;
    const bool is_straight = fitted.form == FieldForm::deep;
    const AxisSlopes slopes = is_straight ? computeAxisSlopes(fitted, mean_to_skin) : AxisSlopes::Zero();
    const Eigen::Vector<double, kAxes> axes =
        logAxes(deriveReported(fitted.numbers, fitted.form, mean_to_skin, kRaysOfDraw));
    const auto count = static_cast<int>(std::lround(share * kDrawsOfFit));
    for (int i = 0; i < count; ++i) {
      FieldNumbers normal;
      for (int j = 0; j < kFieldUnknowns; ++j) normal[j] = random.normal();
      const FieldNumbers off = root.matrixL() * normal;
      draws.push_back(deriveReported(fitted.numbers + off, fitted.form, mean_to_skin, kRaysOfDraw));
      if (is_straight) straighten(axes + slopes * off, draws.back());
    }
  }
  return draws;
}

/// The likeliest form's report, with lengths averaged over all forms by their shares.
Reported averageForms(std::span<const WeighedField> forms, const Mat2& mean_to_skin) {
  Reported mean;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Reported one = deriveReported(forms[i].fitted.numbers, forms[i].fitted.form, mean_to_skin, 72);
    const double share = forms[i].share;
    if (i == 0) {
      mean = one;
      for (LevelEllipse& level : mean.levels) level.half_major_mm = level.half_minor_mm = 0.0;
      mean.contact = Vec2::Zero();
      mean.peak = 0.0;
    }
    for (std::size_t l = 0; l < mean.levels.size(); ++l) {
      mean.levels[l].half_major_mm += share * one.levels[l].half_major_mm;
      mean.levels[l].half_minor_mm += share * one.levels[l].half_minor_mm;
    }
    mean.contact += share * one.contact;
    mean.peak += share * one.peak;
  }
  return mean;
}

KeyEllipse makeKeyEllipse(const Reported& best, const std::vector<Reported>& draws, std::size_t level) {
  const LevelEllipse& e = best.levels[level];
  const auto of = [&](const Reported& draw) -> const LevelEllipse& { return draw.levels[level]; };
  KeyEllipse key;
  key.level_mm = kLevelsMm[level];
  key.half_major_mm = {e.half_major_mm,
                       spread(draws, [&](const auto& d) { return of(d).half_major_mm - e.half_major_mm; })};
  key.half_minor_mm = {e.half_minor_mm,
                       spread(draws, [&](const auto& d) { return of(d).half_minor_mm - e.half_minor_mm; })};
  const auto ratio = [](const LevelEllipse& x) {
    return x.half_minor_mm > 0.0 ? x.half_major_mm / x.half_minor_mm : 1.0;
  };
  key.major_over_minor = {ratio(e), spread(draws, [&](const auto& d) { return ratio(of(d)) - ratio(e); })};
  key.direction_deg = {kDegPerRad * e.direction_rad, kDegPerRad * spread(draws, [&](const auto& d) {
                                                       return halfTurn(of(d).direction_rad - e.direction_rad);
                                                     })};
  return key;
}

Drift makeDrift(const FieldNumbers& n, const Reported& best, const std::vector<Reported>& draws,
                const DriftPrior& prior) {
  const double* drift = n.data() + kFirstDrift;
  Drift d;
  d.right_mm = {best.drift.x(), spread(draws, [&](const auto& r) { return r.drift.x() - best.drift.x(); })};
  d.headwards_mm = {best.drift.y(), spread(draws, [&](const auto& r) { return r.drift.y() - best.drift.y(); })};
  d.scale_percent = drift[2];
  d.turn_deg = kDegPerRad * 0.01 * drift[3];
  d.length_mm = std::hypot(drift[0], drift[1]);
  d.in_sd = std::max({d.length_mm / prior.shift_mm, std::abs(drift[2]) / prior.scale, std::abs(drift[3]) / prior.turn});
  return d;
}

std::size_t dotsWithin(std::span<const FieldDatum> data, const KeyEllipse& key, const FieldFit& fit) {
  const maps::Ellipse ellipse = ellipseOf(key);
  const Vec2 major(std::cos(ellipse.direction_rad), std::sin(ellipse.direction_rad));
  const Vec2 contact(fit.contact_x_mm.value, fit.contact_y_mm.value);
  const auto is_within = [&](const FieldDatum& datum) {
    const Vec2 offset = datum.skin_mm - contact;
    const Vec2 along(offset.dot(major), major.x() * offset.y() - major.y() * offset.x());
    return Vec2(along.x(), along.y() / ellipse.aspect).norm() <= ellipse.half_major_mm;
  };
  return static_cast<std::size_t>(std::count_if(data.begin(), data.end(), is_within));
}

double sdOfForm(FieldForm form) {
  if (form == FieldForm::solved) return kSdOfSolved;
  return form == FieldForm::deep ? kSdOfDeep : 0.0;
}

}  // namespace

LevelEllipse levelEllipse(const SkinField& field, double level_mm, int rays) {
  // The level line is symmetric about the contact: p' M p = 1, M by least squares.
  const Mat2 shape = shapeMatrix(field.log_shape);
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (int i = 0; i < rays; ++i) {
    const double angle = std::numbers::pi * i / rays;
    const Vec2 ray(std::cos(angle), std::sin(angle));
    const double rho2 = levelOnRay(field, ray, level_mm);
    if (!(rho2 > 0.0)) return {};
    const double radius2 = rho2 / ray.dot(shape * ray);
    const Vec3 row = Vec3(ray.x() * ray.x(), 2.0 * ray.x() * ray.y(), ray.y() * ray.y()) * radius2;
    normal += row * row.transpose();
    right += row;
  }
  const Vec3 m = normal.ldlt().solve(right);
  Mat2 matrix;
  matrix << m[0], m[1], m[1], m[2];
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(matrix);
  if (!(axes.eigenvalues()[0] > 0.0)) return {};
  const Vec2 major = axes.eigenvectors().col(0);
  return {1.0 / std::sqrt(axes.eigenvalues()[0]), 1.0 / std::sqrt(axes.eigenvalues()[1]),
          halfTurn(std::atan2(major.y(), major.x()))};
}

void widenByDots(std::span<const FieldDatum> data, const FieldNumbers& numbers, FieldFit& fit) {
  double seen = 0.0;
  for (const FieldDatum& datum : data) seen = std::max(seen, (datum.moved_mm - driftAt(numbers, datum)).norm());
  if (seen < kCoreShare * fit.peak_mm->value) {
    fit.peak_mm.reset();
  } else {
    const double unseen = std::max(0.0, fit.peak_mm->value - seen);
    const double share = fit.field.form == FieldForm::deep ? kSdOfUnseenDeep : kSdOfUnseen;
    fit.peak_mm->sd = std::hypot(fit.peak_mm->sd, share * unseen);
  }
  const double of_form = sdOfForm(fit.field.form);
  for (KeyEllipse* key : {&fit.at_2_mm, &fit.at_4_mm}) {
    const double unsure = kSdBetweenDots / std::pow(1.0 + static_cast<double>(dotsWithin(data, *key, fit)), 1.5);
    for (Estimate* axis : {&key->half_major_mm, &key->half_minor_mm})
      axis->sd = std::hypot(axis->sd, unsure * axis->value, of_form * axis->value);
  }
}

FieldFit reportField(std::span<const WeighedField> forms, const Mat2& mean_to_skin, const DriftPrior& prior) {
  const FittedField& likeliest = forms.front().fitted;
  const Reported best = averageForms(forms, mean_to_skin);
  const std::vector<Reported> draws = samplePosterior(forms, mean_to_skin);
  std::vector<Reported> alike;  // numbers that mean something in one form only
  std::copy_if(draws.begin(), draws.end(), std::back_inserter(alike),
               [&](const Reported& draw) { return draw.form == likeliest.form; });
  FieldFit fit;
  fit.field = toSkinField(likeliest.numbers, likeliest.form);
  for (const WeighedField& form : forms) fit.forms.push_back({form.fitted.form, form.share});
  fit.at_2_mm = makeKeyEllipse(best, draws, 0);
  fit.at_4_mm = makeKeyEllipse(best, draws, 1);
  fit.contact_x_mm = {best.contact.x(), spread(draws, [&](const auto& d) { return d.contact.x() - best.contact.x(); })};
  fit.contact_y_mm = {best.contact.y(), spread(draws, [&](const auto& d) { return d.contact.y() - best.contact.y(); })};
  fit.peak_mm = Estimate{best.peak, spread(draws, [&](const auto& d) { return d.peak - best.peak; })};
  fit.drag_deg = {kDegPerRad * best.drag, kDegPerRad * spread(draws, [&](const auto& d) {
                                            return std::remainder(d.drag - best.drag, 2.0 * std::numbers::pi);
                                          })};
  fit.inverse_tail = {best.tail, spread(alike, [&](const auto& d) { return d.tail - best.tail; })};
  fit.sideways = {best.sideways, spread(alike, [&](const auto& d) { return d.sideways - best.sideways; })};
  fit.drift = makeDrift(likeliest.numbers, best, draws, prior);
  const double two_mm = fit.at_2_mm.half_major_mm.value;
  if (best.form == FieldForm::smooth && two_mm > 0.0 && best.peak > 2.0 && best.tail < kCompactTail)
    fit.gaussian_rim_mm = two_mm / std::sqrt(std::log(best.peak / 2.0) / kGaussianRim);
  return fit;
}

}  // namespace palpate::measure
