// Based on: Ji, dissertation 2008, (4.14) (the half Gaussian, E19), with a tail of free length in its place.
#include "palpate/measure/field/field_form.h"

#include <cmath>

#include "palpate/tissue/solved_drag.h"

namespace palpate::measure {

namespace {

/// f = (1 + k s)^(-1/k) and its derivatives.
struct Fall {
  double value;
  double by_s;
  double by_tail;
};

Fall fallAt(double s, double k) {
  if (k * s < 1e-4) {
    const double f = std::exp(-s + 0.5 * k * s * s - k * k * s * s * s / 3.0);
    return {f, -f / (1.0 + k * s), f * s * s * (0.5 - 2.0 * k * s / 3.0)};
  }
  const double logarithm = std::log1p(k * s);
  const double f = std::exp(-logarithm / k);
  return {f, -f / (1.0 + k * s), f * (logarithm / (k * k) - s / (k * (1.0 + k * s)))};
}

/// The deep form's c is from -0.2 to 1.8.
constexpr double kTailWithoutCore = 0.2;

/// Rounds the pointed form's rho: no skin has a kink.
constexpr double kRounding = 0.1;

FormValue withSideways(const Fall& fall, double s_by_rho2, double rho2, double sideways) {
  const double share = rho2 / (1.0 + rho2);
  const double by_rho2 = fall.by_s * s_by_rho2;
  return {.round = fall.value,
          .radial = sideways * share * fall.value,
          .round_by_rho2 = by_rho2,
          .radial_by_rho2 = sideways * (share * by_rho2 + fall.value / ((1.0 + rho2) * (1.0 + rho2))),
          .round_by_tail = fall.by_tail,
          .radial_by_tail = sideways * share * fall.by_tail,
          .radial_by_sideways = share * fall.value};
}

/// With R^2 = 1 + rho^2: skin moves by (1 - nu) / R + c / R^3 and radially by nu rho^2 / R^3. c = 1 is a load spread
/// over the skin as R^-5; without c it is a force at a point below the skin.
FormValue deepAt(double rho2, double tail, double sideways) {
  const double nu = 0.5 * sideways;
  const double core = tail - kTailWithoutCore;
  const double far = 1.0 / std::sqrt(1.0 + rho2);
  const double near = far * far * far;
  const double nearer = near * far * far;
  const double scale = 1.0 / (1.0 - nu + core);
  FormValue value{.round = scale * ((1.0 - nu) * far + core * near),
                  .radial = scale * nu * rho2 * near,
                  .round_by_rho2 = -scale * (0.5 * (1.0 - nu) * near + 1.5 * core * nearer),
                  .radial_by_rho2 = scale * nu * (near - 1.5 * rho2 * nearer)};
  value.round_by_tail = scale * (near - value.round);
  value.radial_by_tail = -scale * value.radial;
  value.round_by_sideways = 0.5 * scale * (value.round - far);
  value.radial_by_sideways = 0.5 * scale * (rho2 * near + value.radial);
  return value;
}

FormValue solvedAt(double rho2, double tail, double sideways) {
  const tissue::SolvedDrag d = tissue::solvedDragAt(rho2, tail);
  const double more = 1.0 + sideways;
  return {.round = d.across,
          .radial = more * (d.along - d.across),
          .round_by_rho2 = d.across_by_rho2,
          .radial_by_rho2 = more * (d.along_by_rho2 - d.across_by_rho2),
          .round_by_tail = d.across_by_tail,
          .radial_by_tail = more * (d.along_by_tail - d.across_by_tail),
          .radial_by_sideways = d.along - d.across};
}

}  // namespace

FormValue formAt(FieldForm form, double rho2, double tail, double sideways) {
  switch (form) {
    case FieldForm::smooth:
      return withSideways(fallAt(rho2, tail), 1.0, rho2, sideways);
    case FieldForm::pointed: {
      const double rho = std::sqrt(rho2 + kRounding * kRounding);
      return withSideways(fallAt(rho - kRounding, tail), 0.5 / rho, rho2, sideways);
    }
    case FieldForm::deep:
      return deepAt(rho2, tail, sideways);
    case FieldForm::solved:
      break;
  }
  return solvedAt(rho2, tail, sideways);
}

PressShape pressShapeAt(double rho2) {
  const double inverse = 1.0 / (1.0 + rho2);
  const double root = std::sqrt(inverse);
  return {{inverse, inverse * root}, {-inverse * inverse, -1.5 * inverse * inverse * root}};
}

const char* nameOf(FieldForm form) {
  switch (form) {
    case FieldForm::smooth:
      return "smooth";
    case FieldForm::pointed:
      return "pointed";
    case FieldForm::deep:
      return "deep";
    case FieldForm::solved:
      break;
  }
  return "solved";
}

}  // namespace palpate::measure
