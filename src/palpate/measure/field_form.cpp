// Based on: Ji, dissertation 2008, (4.14) (the half Gaussian, E19), with a tail of free length in its place.
#include "palpate/measure/field_form.h"

#include <cmath>

#include "palpate/measure/solved_drag.h"

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

/// Of the pointed form, of rho: no skin has a kink.
constexpr double kRounding = 0.1;

FormValue withSideways(const Fall& fall, double s_by_rho2, double rho2, double sideways) {
  const double share = rho2 / (1.0 + rho2);
  const double by_rho2 = fall.by_s * s_by_rho2;
  return {fall.value,        sideways * share * fall.value,
          by_rho2,           sideways * (share * by_rho2 + fall.value / ((1.0 + rho2) * (1.0 + rho2))),
          fall.by_tail,      sideways * share * fall.by_tail,
          share * fall.value};
}

FormValue solvedAt(double rho2, double tail, double sideways) {
  const SolvedDrag d = solvedDragAt(rho2, tail);
  const double more = 1.0 + sideways;
  return {d.across,          more * (d.along - d.across),
          d.across_by_rho2,  more * (d.along_by_rho2 - d.across_by_rho2),
          d.across_by_tail,  more * (d.along_by_tail - d.across_by_tail),
          d.along - d.across};
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
    case FieldForm::deep: {
      Fall fall = fallAt(rho2, 2.0);
      fall.by_tail = 0.0;
      return withSideways(fall, 1.0, rho2, sideways);
    }
    case FieldForm::solved:
      break;
  }
  return solvedAt(rho2, tail, sideways);
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
