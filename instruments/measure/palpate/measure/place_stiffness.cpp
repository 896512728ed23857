// Curves -> by place -> what cannot be a press refused -> three forms on all rows, the best chosen -> the stiffness of
// each press in that form -> mean and error over people; one shape for all.
#include "palpate/measure/place_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "palpate/base/error.h"
#include "palpate/tissue/fitting/force_rows.h"

namespace palpate::measure {

namespace {

using tissue::ForceCurve;
using tissue::ForceFit;
using tissue::ForceForm;

/// Share of the largest force: a balance's zero wanders by less.
constexpr double kBackwards = 0.05;
/// Share of the largest force by which a press may give way and still count.
constexpr double kFalls = 0.1;
constexpr double kNothingMissed = 1e-3;  // no balance is better
constexpr double kPoorFit = 0.9;         // R^2
constexpr double kHardestNPerMm = 20.0;  // nothing soft; a wrong unit
constexpr double kSoftestNPerMm = 0.005;
// Limits of a scene (docs/reference/scene-files.md).
constexpr double kMinPower = 1.0;
constexpr double kMaxPower = 3.0;

ForceCurve allRows(const std::vector<const PlaceCurve*>& presses) {
  ForceCurve all{.name = presses.front()->place, .depth_mm = {}, .force_n = {}};
  for (const PlaceCurve* press : presses) {
    all.depth_mm.insert(all.depth_mm.end(), press->curve.depth_mm.begin(), press->curve.depth_mm.end());
    all.force_n.insert(all.force_n.end(), press->curve.force_n.begin(), press->curve.force_n.end());
  }
  return all;
}

// --- faults of a press

/// Means over the quarters of the rows by depth.
std::array<double, 4> quarters(const ForceCurve& rows) {
  std::vector<std::size_t> order(rows.depth_mm.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows.depth_mm[i]; });
  std::array<double, 4> sums{};
  std::array<double, 4> counts{};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t quarter = 4 * i / order.size();
    sums.at(quarter) += rows.force_n[order[i]];
    counts.at(quarter) += 1.0;
  }
  for (std::size_t q = 0; q < 4; ++q) sums.at(q) /= counts.at(q);
  return sums;
}

std::size_t depthsBelowSkin(const ForceCurve& rows) {
  std::vector<double> depths;
  std::ranges::copy_if(rows.depth_mm, std::back_inserter(depths), [](double depth) { return depth > 0.0; });
  std::ranges::sort(depths);
  return static_cast<std::size_t>(std::unique(depths.begin(), depths.end()) - depths.begin());
}

std::string refusalReason(const ForceCurve& rows) {
  const std::size_t depths = depthsBelowSkin(rows);
  if (depths < tissue::kMinForceDepths) {
    return fmt::format("{} depths below the skin, {} are needed: press deeper, in more steps", depths,
                       tissue::kMinForceDepths);
  }
  const auto [least, most] = std::ranges::minmax_element(rows.force_n);
  const double largest = std::max(std::abs(*least), std::abs(*most));
  if (!(largest > 0.0)) return "no force at all: was the balance connected?";
  if (*least < -kBackwards * largest) {
    const double depth = rows.depth_mm[static_cast<std::size_t>(least - rows.force_n.begin())];
    return fmt::format("a force of {:.3g} N at {:.3g} mm pulls: is the sign turned, or the balance not at zero?",
                       *least, depth);
  }
  const std::array<double, 4> means = quarters(rows);
  for (std::size_t q = 1; q < 4; ++q) {
    if (means.at(q) >= means.at(q - 1) - kFalls * largest) continue;
    return fmt::format(
        "the force falls with the depth, from {:.3g} to {:.3g} N: the indenter slipped, or the rows are "
        "not of one press",
        means.at(q - 1), means.at(q));
  }
  return {};
}

// --- one place

FormOfPlace fitPlaceForm(const ForceCurve& rows, ForceForm form) {
  FormOfPlace found{.fit = fitForce(rows, form, {})};
  const auto n = static_cast<double>(rows.force_n.size());
  const double mean = std::accumulate(rows.force_n.begin(), rows.force_n.end(), 0.0) / n;
  double rest = 0.0;
  double spread = 0.0;
  for (std::size_t i = 0; i < rows.force_n.size(); ++i) {
    rest += std::pow(rows.force_n[i] - forceOf(found.fit, rows.depth_mm[i]), 2);
    spread += std::pow(rows.force_n[i] - mean, 2);
  }
  found.rms_n = std::sqrt(rest / n);
  found.r_squared = spread > 0.0 ? 1.0 - rest / spread : 0.0;
  return found;
}

/// The fit that predicts best; the simplest of those that do so exactly, rounding apart.
ForceForm bestForm(std::vector<ForceFit> fits) {
  for (ForceFit& fit : fits) fit.unseen_rms = std::max(fit.unseen_rms, kNothingMissed);
  return bestOf(fits).form;
}

std::size_t chooseFormIndex(const std::vector<FormOfPlace>& forms, const PlaceFitSettings& settings) {
  std::vector<ForceFit> fits;
  for (const FormOfPlace& form : forms) fits.push_back(form.fit);
  const ForceForm form = settings.form ? *settings.form : bestForm(fits);
  return static_cast<std::size_t>(std::ranges::find(kPlaceForms, form) - kPlaceForms.begin());
}

struct MeanAndError {
  double mean = 0.0;
  double error = std::numeric_limits<double>::quiet_NaN();
};

MeanAndError meanWithError(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  MeanAndError found{.mean = std::accumulate(values.begin(), values.end(), 0.0) / n};
  if (values.size() < 2) return found;
  double squares = 0.0;
  for (const double value : values) squares += (value - found.mean) * (value - found.mean);
  found.error = std::sqrt(squares / (n - 1.0) / n);
  return found;
}

/// Secants of every person's presses; presses too short for a fit of their own are in the rows only.
std::vector<std::vector<double>> fitPersonSecants(const std::vector<const PlaceCurve*>& presses, ForceForm form) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> people;
  for (const PlaceCurve* press : presses) {
    if (!refusalReason(press->curve).empty()) continue;
    const auto found = std::ranges::find(names, press->subject);
    const auto which = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) {
      names.push_back(press->subject);
      people.emplace_back();
    }
    people[which].push_back(fitForce(press->curve, form, {}).secant.value);
  }
  return people;
}

/// Over people; for one person over presses; for one press by its own fit.
Estimate estimateSecant(const std::vector<const PlaceCurve*>& presses, const ForceFit& fit) {
  const Estimate whole{fit.secant.value, fit.secant.standard_error};
  if (presses.size() < 2) return whole;
  const auto people = fitPersonSecants(presses, fit.form);
  if (people.empty()) return whole;
  std::vector<double> means;
  for (const auto& person : people) means.push_back(meanWithError(person).mean);
  const MeanAndError over = people.size() > 1 ? meanWithError(means) : meanWithError(people.front());
  return {over.mean, std::isnan(over.error) ? whole.sd : over.error};
}

std::vector<std::string> collectWarnings(const PlaceStiffness& place) {
  std::vector<std::string> warnings;
  const FormOfPlace& best = place.best();
  if (best.fit.deepest_mm < tissue::kReferenceDepthMm) {
    warnings.push_back(fmt::format("measured {:.3g} mm deep: the stiffness at {:g} mm is extrapolated",
                                   best.fit.deepest_mm, tissue::kReferenceDepthMm));
  }
  if (best.r_squared < kPoorFit) {
    warnings.push_back(fmt::format("R2 is {:.2f}: the rows scatter, or are of no such form", best.r_squared));
  }
  const double secant = place.secant_n_per_mm.value;
  if (secant > kHardestNPerMm || secant < kSoftestNPerMm) {
    warnings.push_back(fmt::format("{:.3g} N/mm is not a skin: are the forces in N and the depths in mm?", secant));
  }
  for (const tissue::FittedNumber& number : best.fit.numbers) {
    if (number.at_end) warnings.push_back(fmt::format("{} is at the end of its range", number.name));
  }
  return warnings;
}

PlaceStiffness fitPlace(const std::vector<const PlaceCurve*>& presses, const PlaceFitSettings& settings) {
  PlaceStiffness place{.place = presses.front()->place, .rows = allRows(presses), .presses = presses.size()};
  std::vector<std::string> subjects;
  Vec2 sum = Vec2::Zero();
  double placed = 0.0;
  for (const PlaceCurve* press : presses) {
    if (std::ranges::count(subjects, press->subject) == 0) subjects.push_back(press->subject);
    if (!press->at_mm) continue;
    sum += *press->at_mm;
    placed += 1.0;
  }
  place.subjects = subjects.size();
  if (placed > 0.0) place.at_mm = sum / placed;
  place.refusal = refusalReason(place.rows);
  for (const PlaceCurve* press : presses) {  // a slipped press must not hide among good ones
    if (place.refused() || presses.size() < 2 || depthsBelowSkin(press->curve) < tissue::kMinForceDepths) continue;
    const std::string fault = refusalReason(press->curve);
    if (!fault.empty()) place.refusal = fmt::format("press {}: {}", press->curve.name, fault);
  }
  if (place.refused()) return place;
  for (const ForceForm form : kPlaceForms) place.forms.push_back(fitPlaceForm(place.rows, form));
  place.chosen = chooseFormIndex(place.forms, settings);
  place.secant_n_per_mm = estimateSecant(presses, place.best().fit);
  place.warnings = collectWarnings(place);
  return place;
}

std::optional<ForceFit> sharedShape(const std::vector<PlaceStiffness>& places, const PlaceFitSettings& settings) {
  std::vector<ForceCurve> curves;
  for (const PlaceStiffness& place : places) {
    if (place.refused()) continue;
    curves.push_back(place.rows);
  }
  if (curves.empty()) return std::nullopt;
  if (curves.size() == 1) return std::ranges::find_if_not(places, &PlaceStiffness::refused)->best().fit;
  std::vector<ForceFit> fits;
  for (const ForceForm form : kPlaceForms) {
    if (!settings.form || *settings.form == form) fits.push_back(fitSharedForce(curves, form, {}));
  }
  return *std::ranges::find(fits, bestForm(fits), &ForceFit::form);
}

}  // namespace

PlaceFits fitPlaces(std::span<const PlaceCurve> curves, const PlaceFitSettings& settings, const Progress& progress) {
  std::vector<std::vector<const PlaceCurve*>> places;
  for (const PlaceCurve& curve : curves) {
    const auto same = [&](const auto& presses) { return presses.front()->place == curve.place; };
    const auto found = std::ranges::find_if(places, same);
    if (found == places.end()) {
      places.push_back({&curve});
    } else {
      found->push_back(&curve);
    }
  }
  PlaceFits fits;
  for (const auto& presses : places) {
    report(progress, "fitting", static_cast<double>(fits.places.size()) / static_cast<double>(places.size()));
    fits.places.push_back(fitPlace(presses, settings));
  }
  fits.shared = sharedShape(fits.places, settings);
  return fits;
}

std::vector<maps::KeyPoint> withStiffness(const PlaceFits& fits, std::vector<maps::KeyPoint> keys) {
  for (const PlaceStiffness& place : fits.places) {
    if (place.refused()) continue;
    const auto named = std::ranges::find(keys, place.place, &maps::KeyPoint::name);
    if (named != keys.end()) {
      named->stiffness_n_per_mm = place.secant_n_per_mm.value;
    } else if (place.at_mm) {
      keys.push_back({place.place, *place.at_mm, {}, place.secant_n_per_mm.value});
    } else {
      throw Error(fmt::format("{} has no position; give x_mm and y_mm in its rows", place.place));
    }
  }
  return keys;
}

std::string stiffnessTable(std::span<const maps::KeyPoint> keys) {
  std::string table = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm\n";
  for (const maps::KeyPoint& key : keys) {
    const maps::Ellipse& e = key.ellipse;
    const std::string ellipse = e.half_major_mm > 0.0 ? fmt::format("{:.10g},{:.10g},{:.10g}", e.half_major_mm,
                                                                    1.0 / e.aspect, e.direction_rad * kDegPerRad)
                                                      : std::string(",,");
    table += fmt::format("{},{:.10g},{:.10g},{},{}\n", key.name, key.position_mm.x(), key.position_mm.y(), ellipse,
                         key.stiffness_n_per_mm ? fmt::format("{:.6g}", *key.stiffness_n_per_mm) : "");
  }
  return table;
}

std::string tissueKeys(const PlaceFits& fits) {
  if (!fits.shared) return {};
  const ForceFit& fit = *fits.shared;
  const auto number = [&](std::size_t i) { return fit.numbers.at(i).value; };
  if (fit.form == ForceForm::power) {
    return fmt::format("force_law = \"power\"\nexponent = {:.4g}\n", std::clamp(number(0), kMinPower, kMaxPower));
  }
  if (fit.form == ForceForm::stiffening) {
    return fmt::format("force_law = \"stiffening\"\nstiffening_ratio = {:.4g}\nstiffening_depth_mm = {:.4g}\n",
                       number(0), number(1));
  }
  return "force_law = \"linear\"\n";
}

}  // namespace palpate::measure
