// Newton's method on the energy of a press at one depth: every step goes downhill, or the search ends.
//
// An equilibrium is a least of the energy. Where the tangent has a negative pivot the step is taken with its convex
// neighbour instead; where that has to be done again and again, the tissue has no equilibrium nearby: it gives way.
#pragma once

#include <Eigen/Core>
#include <string>

#include "palpate/elements/press_model.h"

namespace palpate::elements {

struct EquilibriumSettings {
  double tolerance = 1e-5;  ///< residual over the force of the contact
  int most_steps = 30;
};

struct Equilibrium {
  Eigen::VectorXd displacement;
  Balance balance;
  int systems = 0;      ///< factorised ones
  std::string trouble;  ///< why none was found, with the place; empty: found
  bool found() const { return trouble.empty(); }
};

Equilibrium settle(PressModel& model, const Eigen::VectorXd& start, double depth_mm,
                   const EquilibriumSettings& settings);

}  // namespace palpate::elements
