// Settings are checked and tables filled once; a value is the chosen form, then its rim: lowered and stretched (E18),
// or faded out.
//
// Based on: Ji, dissertation 2008, (4.1) to (4.3); the forms name their sources in profile_forms.h.
#include "palpate/tissue/profile_curve.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/tissue/profile_forms.h"
#include "palpate/tissue/user_profile.h"

namespace palpate::tissue {

namespace {

/// More would only cost memory: nearest entries of a million are 4e-6 apart.
constexpr std::size_t kMaxTableEntries = 1'000'000;

void requireProfile(bool holds, const char* message) {
  if (!holds) throw Error(message);
}

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }

void check(const ProfileSettings& settings) {
  requireProfile(settings.table_entries >= 2 && settings.table_entries <= kMaxTableEntries,
                 "profile: a table needs 2 to 1000000 entries");
  requireProfile(isPositive(settings.two_gaussians.narrow) && isPositive(settings.two_gaussians.wide) &&
                     std::isfinite(settings.two_gaussians.wide_weight),
                 "profile: the widths of two Gaussians must be above 0");
  requireProfile(isPositive(settings.power.width) && isPositive(settings.power.exponent),
                 "profile: width and exponent of the power tail must be above 0");
  if (settings.kind == ProfileKind::user) checkProfileKnots(settings.knots);
}

}  // namespace

ProfileCurve::ProfileCurve(const ProfileSettings& settings) : settings_(settings) {
  check(settings);
  if (settings.kind == ProfileKind::user) knot_slopes_ = knotSlopes(settings.knots, settings.interpolation);
  if (settings.kind == ProfileKind::table) fillTable();
  if (settings.rim == ProfileRim::lowered) rest_ = unfinished(1.0).value;
}

void ProfileCurve::fillTable() {
  table_.resize(settings_.table_entries);
  const double last = static_cast<double>(table_.size() - 1);
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = halfGaussianForm(static_cast<double>(i) / last).value;
}

ProfilePoint ProfileCurve::at(double q) const noexcept {
  if (!(q < 1.0)) return {};
  return finished(unfinished(q), q);
}

ProfilePoint ProfileCurve::finished(const ProfilePoint& point, double q) const noexcept {
  if (settings_.rim == ProfileRim::smooth) return fadedOut(point, q);
  const double scale = 1.0 / (1.0 - rest_);
  return {scale * (point.value - rest_), scale * point.slope};
}

ProfilePoint ProfileCurve::unfinished(double q) const noexcept {
  switch (settings_.kind) {
    case ProfileKind::half_gaussian:
      return halfGaussianForm(q);
    case ProfileKind::table:
      return tableAt(q);
    case ProfileKind::sharp:
      return sharpForm(q);
    case ProfileKind::cosine:
      return cosineForm(q);
    case ProfileKind::logarithm:
      return logarithmForm(q);
    case ProfileKind::two_gaussians:
      return twoGaussiansForm(settings_.two_gaussians, q);
    case ProfileKind::power:
      return powerForm(settings_.power, q);
    case ProfileKind::user:
      return userAt(q);
  }
  return {};
}

ProfilePoint ProfileCurve::tableAt(double q) const noexcept {
  const double last = static_cast<double>(table_.size() - 1);
  const double place = last * q;
  const auto interval = std::min(static_cast<std::size_t>(place), table_.size() - 2);
  const double rise = table_[interval + 1] - table_[interval];
  if (settings_.lookup == TableLookup::nearest) {
    return {table_[static_cast<std::size_t>(std::lround(place))], last * rise};  // (4.3)
  }
  return {table_[interval] + (place - static_cast<double>(interval)) * rise, last * rise};
}

ProfilePoint ProfileCurve::userAt(double q) const noexcept {
  return interpolatedKnots(settings_.knots, knot_slopes_, settings_.interpolation, q);
}

}  // namespace palpate::tissue
