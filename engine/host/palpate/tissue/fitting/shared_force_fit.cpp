// One shape for all places: the form's numbers from every row, each curve with its own k.
//
// Curves count alike, whatever their number of rows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/order_statistics.h"
#include "palpate/tissue/fitting/force_fit.h"
#include "palpate/tissue/fitting/force_rows.h"

namespace palpate::tissue {

namespace {

/// A curve from its own contact on.
struct ForcePlace {
  ForceRows rows;
  Eigen::ArrayXd weights;
  double secant = 0.0;
};

std::vector<ForcePlace> forcePlaces(std::span<const ForceCurve> curves, const std::vector<ForceFit>& alone) {
  std::vector<ForcePlace> places;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    ForceRows rows = rowsOf(curves[i]);
    rows.depth_mm -= alone[i].offset.value;
    // The squares of a curve are a mean: long ones count as short ones.
    Eigen::ArrayXd weights = scoreWeights(rows) / std::sqrt(static_cast<double>(rows.depth_mm.size()));
    places.push_back({std::move(rows), std::move(weights)});
  }
  return places;
}

Eigen::VectorXd computeResiduals(const std::vector<ForcePlace>& places, const FormShape& shape) {
  Eigen::Index count = 0;
  for (const ForcePlace& place : places) count += place.rows.depth_mm.size();
  Eigen::VectorXd rest(count);
  Eigen::Index at = 0;
  for (const ForcePlace& place : places) {
    const Eigen::ArrayXd effective = shape.at(place.rows.depth_mm);
    const double secant = bestSecant(effective, place.rows, place.weights);
    rest.segment(at, effective.size()) = (place.weights * (secant * effective - place.rows.force_n)).matrix();
    at += effective.size();
  }
  return rest;
}

/// All rows as if every place were as stiff as the middle one.
ForceCurve pooled(const std::vector<ForcePlace>& places, const std::vector<ForceFit>& alone, double secant) {
  ForceCurve all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double factor = alone[i].secant.value > 0.0 ? secant / alone[i].secant.value : 0.0;
    for (Eigen::Index row = 0; row < places[i].rows.depth_mm.size(); ++row) {
      all.depth_mm.push_back(places[i].rows.depth_mm[row]);
      all.force_n.push_back(factor * places[i].rows.force_n[row]);
    }
  }
  return all;
}

double maxDepth(const std::vector<ForcePlace>& places) {
  double deepest = 0.0;
  for (const ForcePlace& place : places) deepest = std::max(deepest, place.rows.depth_mm.maxCoeff());
  return deepest;
}

BoundedFit solvePlaces(const std::vector<ForcePlace>& places, ForceForm form) {
  std::vector<Bounds> bounds;
  for (const FormNumber& number : numbersOf(form)) bounds.push_back(number.inner);
  return fitWithin([&](const Eigen::VectorXd& inner) { return computeResiduals(places, FormShape(form, inner)); },
                   startsOf(form), bounds);
}

/// Squares of places whose shape is that of the others, a fifth of them at a time; of all where there is one.
double unseenSquares(const std::vector<ForcePlace>& places, ForceForm form, const FormShape& of_all) {
  const std::size_t folds = std::min<std::size_t>(5, places.size());
  if (folds < 2) return computeResiduals(places, of_all).squaredNorm();
  double squares = 0.0;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<ForcePlace> seen;
    std::vector<ForcePlace> left_out;
    for (std::size_t i = 0; i < places.size(); ++i) (i % folds == fold ? left_out : seen).push_back(places[i]);
    squares += computeResiduals(left_out, FormShape(form, solvePlaces(seen, form).numbers)).squaredNorm();
  }
  return squares;
}

}  // namespace

ForceFit fitSharedForce(std::span<const ForceCurve> curves, ForceForm form, const ForceFitSettings& settings) {
  // The measured form has no stiffness apart from its shape: a power of the depth lends it.
  const ForceForm own = form == ForceForm::measured ? ForceForm::power : form;
  std::vector<ForceFit> alone;
  std::vector<double> secants;
  for (const ForceCurve& curve : curves) {
    alone.push_back(fitForce(curve, own, settings));
    secants.push_back(alone.back().secant.value);
  }
  const std::vector<ForcePlace> places = forcePlaces(curves, alone);
  const double secant = upperMedianOf(secants);
  if (form == ForceForm::measured) return fitForce(pooled(places, alone, secant), form, {});

  const BoundedFit solved = solvePlaces(places, form);
  const FormShape shape(form, solved.numbers);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ForceFit fit{.form = form, .secant = {"secant_n_per_mm", secant, nan}, .offset = {"offset_mm"}, .law = shape.law()};
  for (const FormNumber& number : numbersOf(form)) {
    const auto i = fit.numbers.size();
    fit.numbers.push_back(
        {number.name, number.valueOf(solved.numbers[static_cast<Eigen::Index>(i)]), nan, solved.at_bound[i]});
  }
  const auto count = static_cast<double>(places.size());
  const Eigen::VectorXd rest = computeResiduals(places, shape);
  fit.rms = std::sqrt(rest.squaredNorm() / count);
  fit.unseen_rms = std::sqrt(unseenSquares(places, form, shape) / count);
  fit.rows = static_cast<std::size_t>(rest.size());
  fit.deepest_mm = maxDepth(places);
  return fit;
}

}  // namespace palpate::tissue
