#include "palpate/base/json.h"
#include "palpate/base/order_statistics.h"
#include "solve/commands/fit_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace palpate::app {

namespace {

using tissue::FittedNumber;
using tissue::ForceFit;
using tissue::ForceForm;

/// One number of every curve.
template <class Number>
std::vector<double> ofAll(const ForceResult& result, ForceForm form, const Number& number) {
  std::vector<double> values;
  for (const FittedCurve& one : result.curves) values.push_back(number(findFit(one.fits, form)));
  return values;
}

double powerExponent(const ForceFit& power) { return power.numbers.front().value; }

// --- text

std::string numberText(const FittedNumber& number) {
  std::string text = fmt::format("{:.4g}", number.value);
  if (number.at_end) return text + " (at the end of its range)";
  if (number.standard_error > 0.0) text += fmt::format(" +- {:.2g}", number.standard_error);
  return text;
}

std::string numbersText(const ForceFit& fit) {
  std::string text;
  for (const FittedNumber& number : fit.numbers) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number.name, numberText(number));
  }
  if (fit.form == ForceForm::measured) text = fmt::format("{} rows", fit.law.table.rows);
  if (fit.offset.value > 0.0 || fit.offset.at_end) {
    text += fmt::format("{}contact at {} mm", text.empty() ? "" : ", ", numberText(fit.offset));
  }
  return text;
}

std::string fitsText(const std::vector<ForceFit>& fits, ForceForm chosen) {
  std::string text = fmt::format("{:<12}{:>8}{:>9}  {:<20}{}\n", "form", "RMS", "unseen", "N/mm at 8 mm", "numbers");
  for (const ForceFit& fit : fits) {
    text +=
        fmt::format("{:<12}{:>6.1f} %{:>7.1f} %  {:<20}{}{}\n", nameOf(fit.form), 100.0 * fit.rms,
                    100.0 * fit.unseen_rms, numberText(fit.secant), numbersText(fit), fit.form == chosen ? "  <-" : "");
  }
  return text;
}

std::string curvesText(const ForceResult& result) {
  constexpr std::size_t kMaxShown = 40;
  std::string text = fmt::format("{:<24}{:>6}{:>9}{:>14}{:>10}{:>8}  {}\n", "curve", "rows", "deepest", "N/mm at 8 mm",
                                 "exponent", "RMS", "best form");
  for (std::size_t i = 0; i < std::min(result.curves.size(), kMaxShown); ++i) {
    const FittedCurve& one = result.curves[i];
    const ForceFit& power = findFit(one.fits, ForceForm::power);
    const ForceFit& best = bestOf(one.fits);
    text += fmt::format("{:<24}{:>6}{:>9.2f}{:>14.3f}{:>10.2f}{:>6.1f} %  {}, {:.1f} %\n", one.curve.name, power.rows,
                        power.deepest_mm, power.secant.value, powerExponent(power), 100.0 * power.rms,
                        nameOf(best.form), 100.0 * best.rms);
  }
  if (result.curves.size() > kMaxShown) text += fmt::format("... {} more\n", result.curves.size() - kMaxShown);
  return text;
}

std::string spreadText(const ForceResult& result) {
  const std::vector<double> exponents = ofAll(result, ForceForm::power, powerExponent);
  std::string text = "\nmedian over curves, each with numbers of its own\n";
  text += fmt::format("{:<12}{:>8}{:>9}\n", "form", "RMS", "unseen");
  for (const ForceForm form : tissue::kForceForms) {
    text +=
        fmt::format("{:<12}{:>6.1f} %{:>7.1f} %\n", nameOf(form),
                    100.0 * quantileOf(ofAll(result, form, [](const ForceFit& fit) { return fit.rms; }), 0.5),
                    100.0 * quantileOf(ofAll(result, form, [](const ForceFit& fit) { return fit.unseen_rms; }), 0.5));
  }
  return text + fmt::format("exponent: {:.2f} in the middle, 8 of 10 from {:.2f} to {:.2f}\n",
                            quantileOf(exponents, 0.5), quantileOf(exponents, 0.1), quantileOf(exponents, 0.9));
}

// --- JSON

Json numberJson(const FittedNumber& number) {
  return {{"value", number.value}, {"standard_error", number.standard_error}, {"at_end", number.at_end}};
}

Json fitJson(const ForceFit& fit) {
  Json json = {{"form", nameOf(fit.form)}, {"secant_n_per_mm", numberJson(fit.secant)}};
  json["numbers"] = numbersJson(fit.numbers);
  json["offset_mm"] = numberJson(fit.offset);
  json["rms"] = fit.rms;
  json["unseen_rms"] = fit.unseen_rms;
  json["noise_floor"] = fit.noise_floor;
  json["rows"] = fit.rows;
  json["deepest_mm"] = fit.deepest_mm;
  return json;
}

Json fitsJson(const std::vector<ForceFit>& fits) {
  Json json = Json::array();
  for (const ForceFit& fit : fits) json.push_back(fitJson(fit));
  return json;
}

Json spreadJson(const ForceResult& result) {
  const std::vector<double> exponents = ofAll(result, ForceForm::power, powerExponent);
  Json json;
  json["exponent"] = {
      {"p10", quantileOf(exponents, 0.1)}, {"median", quantileOf(exponents, 0.5)}, {"p90", quantileOf(exponents, 0.9)}};
  for (const ForceForm form : tissue::kForceForms) {
    json["rms_median"][std::string(nameOf(form))] =
        quantileOf(ofAll(result, form, [](const ForceFit& fit) { return fit.rms; }), 0.5);
  }
  return json;
}

/// Lines for a scene file; the table's name is needed where the engine has no law of this form.
std::string sceneKeys(const ForceResult& result) {
  const ForceFit& fit = findFit(result.fits(), result.chosen);
  std::string keys = "[tissue]\n";
  const auto number = [&](std::size_t i) { return fit.numbers[i].value; };
  constexpr double kMinExponent = 1.0;  // limit of a scene
  constexpr double kMaxExponent = 3.0;
  const bool known_power = fit.form == ForceForm::power && number(0) >= kMinExponent && number(0) <= kMaxExponent;
  if (fit.form == ForceForm::linear) {
    keys += "force_law = \"linear\"\n";
  } else if (known_power) {
    keys += fmt::format("force_law = \"power\"\nexponent = {:.4g}\n", number(0));
  } else if (fit.form == ForceForm::stiffening) {
    keys += fmt::format("force_law = \"stiffening\"\nstiffening_ratio = {:.4g}\nstiffening_depth_mm = {:.4g}\n",
                        number(0), number(1));
  } else {
    keys += fmt::format("force_law = \"table\"\nforce_table = \"{}\"\n",
                        result.table.empty() ? "TABLE.csv (write it with -o)" : result.table);
  }
  return keys + fmt::format("\n[stiffness]\nsource = \"constant\"\nconstant_n_per_mm = {:.4g}\n", fit.secant.value);
}

}  // namespace

Json numbersJson(const std::vector<FittedNumber>& numbers) {
  Json json = Json::object();
  for (const FittedNumber& number : numbers) json[number.name] = numberJson(number);
  return json;
}

const ForceFit& findFit(const std::vector<ForceFit>& fits, ForceForm form) {
  return *std::ranges::find(fits, form, &ForceFit::form);
}

std::string textOf(const ForceResult& result) {
  std::string text;
  if (result.shared.empty()) {
    const ForceFit& power = findFit(result.fits(), ForceForm::power);
    text = fmt::format("{}: {} rows, {:.4g} mm deep\n\n", result.file, power.rows, power.deepest_mm);
    text += fitsText(result.fits(), result.chosen);
  } else {
    text = fmt::format("{}: {} curves\n\n", result.file, result.curves.size());
    text += curvesText(result) + spreadText(result);
    text += "\none shape for all, each curve with a stiffness of its own (unseen: the shape is that of other curves)\n";
    text += fitsText(result.shared, result.chosen);
  }
  text += "\nRMS of (fit - force) / max(force, 0.3 of the largest); unseen: of rows left out of the fit.\n";
  text += "\nin a scene:\n" + sceneKeys(result);
  for (const std::string& file : result.written) text += "-> " + file + "\n";
  return text;
}

Json toJson(const ForceResult& result) {
  const ForceFit& power = findFit(result.fits(), ForceForm::power);
  const ForceFit& best = bestOf(result.fits());
  Json json = {{"file", result.file}, {"free_offset", result.free_offset}};
  json["p"] = powerExponent(power);
  json["p_standard_error"] = power.numbers.front().standard_error;
  json["k_n_per_mm"] = power.secant.value;
  json["reference_depth_mm"] = tissue::kReferenceDepthMm;
  json["best"] = nameOf(best.form);
  json["chosen"] = nameOf(result.chosen);
  json["fits"] = fitsJson(result.fits());
  json["curves"] = Json::array();
  for (const FittedCurve& one : result.curves) {
    json["curves"].push_back(
        {{"curve", one.curve.name}, {"best", nameOf(bestOf(one.fits).form)}, {"fits", fitsJson(one.fits)}});
  }
  json["spread"] = spreadJson(result);
  json["scene"] = sceneKeys(result);
  json["written"] = result.written;
  return json;
}

}  // namespace palpate::app
