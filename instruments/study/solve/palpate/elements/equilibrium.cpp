#include "palpate/elements/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace palpate::elements {

namespace {

class Descent {
 public:
  Descent(PressModel& model, const Eigen::VectorXd& start, double depth_mm) : model_(model), depth_mm_(depth_mm) {
    state_.displacement = start;
    state_.balance = model.evaluate(start, depth_mm, Tangent::exact);
    residual_ = model.residual();
  }

  bool possible() const { return state_.balance.possible(); }
  bool settled(double tolerance) const {
    constexpr double kMinForceMn = 1e-3;
    return residual_.norm() <= tolerance * std::max(state_.balance.force_mn, kMinForceMn);
  }
  /// Steps in a row whose tangent had to be made convex.
  int strayed() const { return strayed_; }

  /// False: no step, however short, went downhill.
  bool step() {
    step_ = direction();
    if (step_.size() == 0) return false;
    const double slope = step_.dot(residual_);
    const double before = state_.balance.energy();
    const double size_before = residual_.norm();
    constexpr double kLongestMm = 1.0;
    double share = std::min(1.0, kLongestMm / step_.cwiseAbs().maxCoeff());
    inverted_ = -1;
    for (int attempt = 0; attempt < 25; ++attempt) {
      Eigen::VectorXd displacement = model_.moved(state_.displacement, step_, share);
      const Balance balance = model_.evaluate(displacement, depth_mm_, Tangent::exact);
      if (balance.possible()) {
        const bool lower = balance.energy() <= before + 1e-4 * share * slope + 1e-12 * std::abs(before);
        if (lower || model_.residual().norm() < 0.5 * size_before) {
          state_.displacement = std::move(displacement);
          state_.balance = balance;
          residual_ = model_.residual();
          return true;
        }
      } else {
        inverted_ = balance.inverted;
      }
      share *= 0.5;
    }
    return false;
  }

  /// The obstacle, after steps that led nowhere.
  std::string trouble() const {
    if (!possible()) return "an element is turned inside out, " + model_.placeOfElement(state_.balance.inverted);
    if (inverted_ >= 0) return "an element turns inside out, " + model_.placeOfElement(inverted_);
    Eigen::Index worst = 0;
    if (step_.size() == 0) return "the system of equations is singular";
    step_.cwiseAbs().maxCoeff(&worst);
    const std::string place = model_.placeOfFreedom(worst);
    if (strayed_ > 0) return "no equilibrium nearby: the tissue gives way, " + place;
    return "no progress, most motion " + place;
  }

  Equilibrium result() { return std::move(state_); }

 private:
  /// Empty if the tangent cannot be factorised.
  Eigen::VectorXd direction() {
    int negative = model_.tangent().factorise();
    ++state_.systems;
    strayed_ = negative == 0 ? 0 : strayed_ + 1;
    if (negative != 0) {
      model_.evaluate(state_.displacement, depth_mm_, Tangent::convex);
      negative = model_.tangent().factorise();
      ++state_.systems;
      if (negative < 0) return {};
    }
    return -model_.tangent().solve(residual_);
  }

  PressModel& model_;
  double depth_mm_;
  Equilibrium state_;
  Eigen::VectorXd residual_;  ///< residual of the state; the model's own is that of the last trial
  Eigen::VectorXd step_;
  int strayed_ = 0;
  int inverted_ = -1;  ///< in the last search for a step
};

}  // namespace

Equilibrium settle(PressModel& model, const Eigen::VectorXd& start, double depth_mm,
                   const EquilibriumSettings& settings) {
  constexpr int kFarthestAstray = 12;
  Descent descent(model, start, depth_mm);
  bool moving = descent.possible();
  for (int i = 0; i < settings.most_steps && moving && !descent.settled(settings.tolerance); ++i) {
    moving = descent.step() && descent.strayed() < kFarthestAstray;
  }
  constexpr double kNearEnough = 100.0;  // rounding stops the search on hard stacks a little above the tolerance
  const bool found =
      descent.possible() && descent.settled(moving ? settings.tolerance : kNearEnough * settings.tolerance);
  std::string trouble = found ? std::string() : descent.trouble();
  Equilibrium result = descent.result();
  result.trouble = std::move(trouble);
  return result;
}

}  // namespace palpate::elements
