// Curve -> rows -> the form's numbers by least squares, k following from them in closed form -> once more with weights
// from the fit, for each proportion of the two kinds of noise -> errors, rows left out.
#include "palpate/tissue/fitting/force_fit.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "palpate/base/elementary.h"
#include "palpate/tissue/fitting/force_rows.h"

namespace palpate::tissue {

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

constexpr std::array kNoiseFloors = {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 3.0};
/// Fewer rows do not show how the noise grows.
constexpr Eigen::Index kRowsForNoise = 6;
/// Weights from the fit, a fit with these weights: settled after a few.
constexpr int kReweighings = 3;
/// Simpler forms are preferred that predict no worse than by this factor.
constexpr double kNearlyAsWell = 1.05;

// --- one form on one curve

struct Solved {
  Eigen::VectorXd inner;  ///< the form's numbers, and the offset behind them where it is free
  double secant = 0.0;
};

class CurveFit {
 public:
  CurveFit(const ForceRows& rows, ForceForm form, const ForceFitSettings& settings)
      : rows_(rows), form_(form), free_offset_(settings.free_offset), starts_(startsOf(form)) {
    for (const FormNumber& number : numbersOf(form)) bounds_.push_back(number.inner);
    if (!free_offset_) return;
    bounds_.push_back({0.0, settings.most_offset_mm});
    for (Eigen::VectorXd& start : starts_) {
      start.conservativeResize(start.size() + 1);
      start[start.size() - 1] = 0.25 * settings.most_offset_mm;
    }
  }

  Solved solve(const Eigen::ArrayXd& weights) const { return solveFrom(starts_, weights); }
  Solved solveFrom(const std::vector<Eigen::VectorXd>& starts, const Eigen::ArrayXd& weights) const {
    const auto residuals = [&](const Eigen::VectorXd& inner) -> Eigen::VectorXd {
      const Eigen::ArrayXd effective = effectiveAt(inner, rows_.depth_mm);
      return (weights * (bestSecant(effective, rows_, weights) * effective - rows_.force_n)).matrix();
    };
    Solved solved{fitWithin(residuals, starts, bounds_).numbers};
    solved.secant = bestSecant(effectiveAt(solved.inner, rows_.depth_mm), rows_, weights);
    return solved;
  }

  Eigen::ArrayXd forces(const Solved& solved, const Eigen::ArrayXd& depth_mm) const {
    return solved.secant * effectiveAt(solved.inner, depth_mm);
  }
  double fittedOffset(const Solved& solved) const { return offsetIn(solved.inner); }

  /// With k as a further number in front: for the errors of all of them.
  BoundedFit withSecant(const Solved& solved, const Eigen::ArrayXd& weights) const {
    Eigen::VectorXd all(solved.inner.size() + 1);
    all << solved.secant, solved.inner;
    std::vector<Bounds> bounds = bounds_;
    bounds.insert(bounds.begin(), Bounds{0.0, 10.0 * std::max(solved.secant, 1e-9)});
    const auto residuals = [&](const Eigen::VectorXd& numbers) -> Eigen::VectorXd {
      const Eigen::VectorXd inner = numbers.tail(numbers.size() - 1);
      return (weights * (numbers[0] * effectiveAt(inner, rows_.depth_mm) - rows_.force_n)).matrix();
    };
    return fitWithin(residuals, {all}, bounds);
  }

 private:
  double offsetIn(const Eigen::VectorXd& inner) const { return free_offset_ ? inner[inner.size() - 1] : 0.0; }
  Eigen::ArrayXd effectiveAt(const Eigen::VectorXd& inner, const Eigen::ArrayXd& depth_mm) const {
    return FormShape(form_, inner).at(depth_mm - offsetIn(inner));
  }

  const ForceRows& rows_;
  ForceForm form_;
  bool free_offset_;
  std::vector<Bounds> bounds_;
  std::vector<Eigen::VectorXd> starts_;
};

// --- how much a row counts

/// A fit with the weights that belong to it.
struct Weighed {
  Solved solved;
  Eigen::ArrayXd weights;
  double floor = 0.0;
  double likelihood = -std::numeric_limits<double>::infinity();
};

Weighed reweighed(const CurveFit& fit, const ForceRows& rows, const Solved& first, double floor) {
  Weighed weighed{.solved = first, .weights = {}, .floor = floor};
  for (int i = 0; i < kReweighings; ++i) {
    const Eigen::ArrayXd force = fit.forces(weighed.solved, rows.depth_mm);
    weighed.weights = (force.square() + elementary::square(floor * rows.most_n)).rsqrt();
    weighed.solved = fit.solveFrom({weighed.solved.inner}, weighed.weights);
  }
  const Eigen::ArrayXd rest = weighed.weights * (fit.forces(weighed.solved, rows.depth_mm) - rows.force_n);
  const double variance = std::max(rest.square().mean(), 1e-24);
  weighed.likelihood = weighed.weights.unaryExpr(&elementary::log).sum() -
                       0.5 * static_cast<double>(rows.depth_mm.size()) * elementary::log(variance);
  return weighed;
}

Weighed weighedFit(const CurveFit& fit, const ForceRows& rows) {
  const Eigen::ArrayXd weights = scoreWeights(rows);
  const Solved first = fit.solve(weights);
  Weighed best{.solved = first, .weights = weights};
  if (rows.depth_mm.size() < kRowsForNoise) return best;
  for (const double floor : kNoiseFloors) {
    Weighed other = reweighed(fit, rows, first, floor);
    if (other.likelihood > best.likelihood) best = std::move(other);
  }
  return best;
}

// --- what came out

std::vector<FittedNumber> fittedNumbers(ForceForm form, const Eigen::VectorXd& inner) {
  std::vector<FittedNumber> fitted;
  for (const FormNumber& number : numbersOf(form)) {
    fitted.push_back({number.name, number.valueOf(inner[static_cast<Eigen::Index>(fitted.size())]), kNotKnown});
  }
  return fitted;
}

/// Sets the errors of k, the form's numbers and the offset.
void setStandardErrors(const BoundedFit& whole, const ForceFitSettings& settings, ForceFit& fit) {
  const Eigen::VectorXd errors = standardErrors(whole);
  fit.secant.standard_error = errors[0];
  fit.secant.at_end = whole.at_bound[0];
  for (std::size_t i = 0; i < fit.numbers.size(); ++i) {
    const double scale = numbersOf(fit.form)[i].logarithmic ? fit.numbers[i].value : 1.0;
    fit.numbers[i].standard_error = scale * errors[static_cast<Eigen::Index>(i + 1)];
    fit.numbers[i].at_end = whole.at_bound[i + 1];
  }
  if (!settings.free_offset) return;
  fit.offset.standard_error = errors[errors.size() - 1];
  fit.offset.at_end = whole.at_bound.back();
}

ForceFit fitRows(const ForceRows& rows, ForceForm form, const ForceFitSettings& settings) {
  const CurveFit curve(rows, form, settings);
  const Weighed weighed = weighedFit(curve, rows);
  const Solved& solved = weighed.solved;
  ForceFit fit{.form = form,
               .secant = {"secant_n_per_mm", solved.secant},
               .numbers = fittedNumbers(form, solved.inner),
               .offset = {"offset_mm", curve.fittedOffset(solved)},
               .law = FormShape(form, solved.inner).law()};
  setStandardErrors(curve.withSecant(solved, weighed.weights), settings, fit);
  fit.noise_floor = weighed.floor;
  fit.rms = scoreRms(rows, curve.forces(solved, rows.depth_mm));
  fit.unseen_rms = unseenRms(rows, [&](const std::vector<Eigen::Index>& seen, const Eigen::ArrayXd& depth_mm) {
    const ForceRows part = partOf(rows, seen);
    const CurveFit again(part, form, settings);
    return again.forces(again.solveFrom({solved.inner}, weighed.weights(seen)), depth_mm);
  });
  return fit;
}

Eigen::ArrayXd forcesIn(const ForceTable& table, const Eigen::ArrayXd& depth_mm) {
  return depth_mm.unaryExpr([&](double depth) { return forceIn(table, depth); });
}

ForceFit measuredFit(const ForceRows& rows) {
  const Eigen::ArrayXd weights = scoreWeights(rows);
  ForceFit fit{.form = ForceForm::measured, .offset = {"offset_mm"}};
  fit.law.kind = ForceLaw::Kind::table;
  fit.law.table = smoothedTable(rows, weights);
  fit.secant = {"secant_n_per_mm", forceIn(fit.law.table, kReferenceDepthMm) / kReferenceDepthMm, kNotKnown};
  fit.rms = scoreRms(rows, forcesIn(fit.law.table, rows.depth_mm));
  fit.unseen_rms = unseenRms(rows, [&](const std::vector<Eigen::Index>& seen, const Eigen::ArrayXd& depth_mm) {
    return forcesIn(smoothedTable(partOf(rows, seen), weights(seen)), depth_mm);
  });
  return fit;
}

std::size_t numbersIn(const ForceFit& fit) {
  return fit.form == ForceForm::measured ? std::size_t{fit.law.table.rows} : fit.numbers.size();
}

}  // namespace

double forceOf(const ForceFit& fit, double depth_mm) {
  const double depth = depth_mm - fit.offset.value;
  if (fit.form == ForceForm::measured) return forceIn(fit.law.table, depth);
  Eigen::VectorXd inner(static_cast<Eigen::Index>(fit.numbers.size()));
  for (std::size_t i = 0; i < fit.numbers.size(); ++i) {
    inner[static_cast<Eigen::Index>(i)] = numbersOf(fit.form)[i].innerOf(fit.numbers[i].value);
  }
  return fit.secant.value * FormShape(fit.form, inner).at(depth);
}

ForceFit fitForce(const ForceCurve& curve, ForceForm form, const ForceFitSettings& settings) {
  const ForceRows rows = rowsOf(curve);
  ForceFit fit = form == ForceForm::measured ? measuredFit(rows) : fitRows(rows, form, settings);
  fit.rows = static_cast<std::size_t>(rows.depth_mm.size());
  fit.deepest_mm = rows.depth_mm.maxCoeff() - fit.offset.value;
  return fit;
}

std::vector<ForceFit> fitForces(const ForceCurve& curve, const ForceFitSettings& settings) {
  std::vector<ForceFit> fits;
  for (const ForceForm form : kForceForms) fits.push_back(fitForce(curve, form, settings));
  return fits;
}

const ForceFit& bestOf(std::span<const ForceFit> fits) {
  const double least = std::ranges::min_element(fits, {}, &ForceFit::unseen_rms)->unseen_rms;
  const ForceFit* best = nullptr;
  for (const ForceFit& fit : fits) {
    if (fit.unseen_rms > kNearlyAsWell * least) continue;
    const bool simpler = best == nullptr || numbersIn(fit) < numbersIn(*best);
    const bool nearer = !simpler && numbersIn(fit) == numbersIn(*best) && fit.unseen_rms < best->unseen_rms;
    if (simpler || nearer) best = &fit;
  }
  return *best;
}

ForceTable tableOf(const ForceFit& fit) {
  if (fit.form == ForceForm::measured) return fit.law.table;
  ForceTable table;
  constexpr std::uint32_t kRows = 40;
  for (std::uint32_t i = 0; i < kRows; ++i) {
    // Closer where a power of the depth bends most.
    const double depth = fit.deepest_mm * elementary::pow((i + 1.0) / kRows, 1.5);
    table.depth_mm.at(i) = depth;
    table.effective_mm.at(i) = forceOf(fit, depth + fit.offset.value);
  }
  table.rows = kRows;
  return table;
}

}  // namespace palpate::tissue
