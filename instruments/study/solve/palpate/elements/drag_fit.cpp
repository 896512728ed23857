// The share of a drag as (1 + q^2)^-p, fitted over a quarter square with every square millimetre the same weight.
#include <cmath>

#include "palpate/elements/drag_solver.h"
#include "palpate/tissue/fitting/bounded_fit.h"

namespace palpate::elements {

FittedDrag fitDrag(const DragField& field, const std::vector<double>& radii_mm, double to_mm) {
  constexpr int kSteps = 60;
  const auto place = [&](int i) { return to_mm * i / kSteps; };
  Eigen::VectorXd solved((kSteps + 1) * (kSteps + 1));
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) solved[i * (kSteps + 1) + j] = field.at(place(i), place(j));
  }
  const auto residuals = [&](const Eigen::VectorXd& shape) {
    Eigen::VectorXd off(solved.size());
    for (int i = 0; i <= kSteps; ++i) {
      const double x = place(i) / shape[0];
      for (int j = 0; j <= kSteps; ++j) {
        const double y = place(j) / shape[1];
        const Eigen::Index at = i * (kSteps + 1) + j;
        off[at] = std::pow(1.0 + x * x + y * y, -shape[2]) - solved[at];
      }
    }
    return off;
  };
  const std::vector<Eigen::VectorXd> starts = {Eigen::Vector3d(16.0, 9.0, 0.8)};
  const tissue::BoundedFit fit = tissue::fitWithin(residuals, starts, {{1.0, 200.0}, {1.0, 200.0}, {0.1, 10.0}});

  FittedDrag result;
  result.shape.along_mm = fit.numbers[0];
  result.shape.across_mm = fit.numbers[1];
  result.shape.exponent = fit.numbers[2];
  result.shape.tangential_over_normal = field.drag_n_per_mm / field.press_n_per_mm;
  for (const double r : radii_mm) {
    result.shape.on_along.push_back(field.at(r, 0.0));
    result.shape.on_across.push_back(field.at(0.0, r));
  }
  result.rms = std::sqrt(fit.squares / static_cast<double>(solved.size()));
  return result;
}

}  // namespace palpate::elements
