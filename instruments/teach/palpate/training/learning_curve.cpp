#include "palpate/training/learning_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "palpate/base/order_statistics.h"
#include "palpate/training/threshold_likelihood.h"

namespace palpate::training {

namespace {

/// SD of ln T that a test of 40 trials leaves, and how it falls with trials: simulated, `palpate study training`.
constexpr double kSdAfterForty = 0.134;
constexpr double kSdFalls = 0.465;  // nearly 1/2; the first answers look for the region
/// Two-sided 5 % of a normal.
constexpr double kTwoSided5Percent = 1.96;

/// A person is not the same every day: how far a session may lie from the smooth curve, in ln T. An assumption; too
/// small a number makes bands that look surer than they are.
constexpr double kDayToDaySd = 0.1;

// The grid of curves.
constexpr std::size_t kStarts = 49;
constexpr double kStartReachSd = 3.0;
constexpr std::size_t kGains = 25;
constexpr double kMaxGain = 1.8;   ///< ln(start / end): a sixth is left
constexpr double kMaxLoss = -0.3;  ///< some get worse
/// In sessions, each as likely: from all at once to hardly within all sessions.
constexpr std::array kPaces = {0.7, 1.0, 1.5, 2.2, 3.3, 5.0, 7.5};
/// Places of the curve between two sessions.
constexpr int kPlacesBetween = 4;

struct WeighedCurve {
  double start = 0.0;
  double end = 0.0;
  double pace = 0.0;
  double weight = 0.0;
  double at(double session) const { return end + (start - end) * std::exp(-session / pace); }
};

double evenly(double from, double to, std::size_t i, std::size_t points) {
  return from + (to - from) * static_cast<double>(i) / static_cast<double>(points - 1);
}

std::vector<WeighedCurve> curvesBefore(const Prior& prior) {
  std::vector<WeighedCurve> curves;
  curves.reserve(kStarts * kGains * kPaces.size());
  for (std::size_t i = 0; i < kStarts; ++i) {
    const double place = evenly(-kStartReachSd, kStartReachSd, i, kStarts);
    const double start = prior.threshold * std::exp(prior.sd_ln_t * place);
    for (std::size_t j = 0; j < kGains; ++j) {
      const double end = start * std::exp(-evenly(kMaxLoss, kMaxGain, j, kGains));
      for (const double pace : kPaces) curves.push_back({start, end, pace, std::exp(-0.5 * place * place)});
    }
  }
  return curves;
}

/// Linear between places, the border's outside.
double valueAt(const ThresholdLikelihood& likelihood, double place) {
  const double cells = (place - likelihood.places.front()) / likelihood.cell();
  const double inside = std::clamp(cells, 0.0, static_cast<double>(likelihood.places.size() - 1));
  const std::size_t below = std::min(static_cast<std::size_t>(inside), likelihood.places.size() - 2);
  const double over = inside - static_cast<double>(below);
  return likelihood.values[below] * (1.0 - over) + likelihood.values[below + 1] * over;
}

/// 2.5, 50 and 97.5 % of one quantity over all curves.
template <class Quantity>
CurvePoint computeCurvePoint(const std::vector<WeighedCurve>& curves, double session, const Quantity& quantity) {
  std::vector<WeighedValue> values;
  values.reserve(curves.size());
  for (const WeighedCurve& curve : curves) values.push_back({quantity(curve), curve.weight});
  std::sort(values.begin(), values.end());
  return {.session = session,
          .median = weighedQuantile(values, 0.5),
          .low = weighedQuantile(values, 0.025),
          .high = weighedQuantile(values, 0.975)};
}

}  // namespace

std::vector<LearningPoint> filteredThresholds(std::span<const SessionAnswers> sessions, int choices, const Prior& prior,
                                              double wander) {
  std::vector<LearningPoint> points;
  Posterior posterior(choices, prior);
  for (const SessionAnswers& session : sessions) {
    if (!points.empty()) posterior.diffuse(wander);
    for (const Answer& answer : session.answers) posterior.add(answer);
    points.push_back({static_cast<int>(session.answers.size()), posterior.summary()});
  }
  return points;
}

std::optional<LearningFit> fitLearning(std::span<const SessionAnswers> sessions, int choices, const Prior& prior) {
  std::vector<WeighedCurve> curves = curvesBefore(prior);
  int with_answers = 0;
  for (std::size_t n = 0; n < sessions.size(); ++n) {
    if (sessions[n].answers.empty()) continue;
    ++with_answers;
    const ThresholdLikelihood told = blurred(thresholdLikelihood(sessions[n].answers, choices), kDayToDaySd);
    for (WeighedCurve& curve : curves) curve.weight *= valueAt(told, std::log(curve.at(static_cast<double>(n))));
  }
  if (with_answers < 3) return std::nullopt;
  // Curves without weight need not be sorted.
  const auto lightest =
      std::max_element(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; })
          ->weight *
      1e-6;
  std::erase_if(curves, [&](const WeighedCurve& curve) { return curve.weight < lightest; });

  LearningFit fit;
  fit.start = computeCurvePoint(curves, 0.0, [](const WeighedCurve& curve) { return curve.start; });
  const auto last = static_cast<double>(sessions.size() - 1);
  fit.end = computeCurvePoint(curves, last, [](const WeighedCurve& curve) { return curve.end; });
  fit.pace_sessions = computeCurvePoint(curves, 0.0, [](const WeighedCurve& curve) { return curve.pace; }).median;
  const int places = kPlacesBetween * static_cast<int>(sessions.size() - 1);
  for (int i = 0; i <= places; ++i) {
    const double session = static_cast<double>(i) / kPlacesBetween;
    fit.curve.push_back(
        computeCurvePoint(curves, session, [&](const WeighedCurve& curve) { return curve.at(session); }));
  }
  return fit;
}

double factorOfRealChange(int trials_before, int trials_after) {
  const auto sd = [](int trials) { return kSdAfterForty * std::pow(40.0 / std::max(trials, 1), kSdFalls); };
  return std::exp(kTwoSided5Percent * std::hypot(sd(trials_before), sd(trials_after)));
}

ThresholdChange changeBetween(const ThresholdSummary& before, const ThresholdSummary& now) {
  const double ln = std::log(now.median / before.median);
  const double open = std::hypot(now.halfWidth(), before.halfWidth());
  return {.ratio = std::exp(ln), .low = std::exp(ln - open), .high = std::exp(ln + open), .clear = std::abs(ln) > open};
}

}  // namespace palpate::training
