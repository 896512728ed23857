// `palpate measure stiffness FORCES.csv`: how stiff named places are, from force by depth; key points with a stiffness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "measure/commands/commands.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/measure/place_stiffness.h"
#include "report/charts/figure.h"
#include "report/charts/picture_file.h"

namespace palpate::app {

namespace {

// Measured forces of places with the forms that were fitted to them, as a picture.

using measure::PlaceStiffness;

constexpr std::size_t kMaxPlacePanels = 24;

figures::Series formSeries(const PlaceStiffness& place, std::size_t which) {
  constexpr int kPoints = 120;
  const measure::FormOfPlace& form = place.forms[which];
  const bool chosen = which == place.chosen;
  figures::Series line{.name = fmt::format("{}, {:.2g} N", nameOf(form.fit.form), form.rms_n),
                       .stroke = chosen ? figures::Stroke::solid : figures::Stroke::dashed,
                       .colour = figures::seriesColour(which),
                       .width_px = chosen ? 2.6 : 1.4};
  for (int i = 0; i <= kPoints; ++i) {
    line.x.push_back(form.fit.deepest_mm * i / kPoints);
    line.y.push_back(forceOf(form.fit, line.x.back()));
  }
  return line;
}

figures::Plot placePanel(const PlaceStiffness& place) {
  figures::Plot plot{.title = place.refused() ? place.place + ": refused"
                                              : fmt::format("{}: {:.3g} \u00b1 {:.1g} N/mm at 8 mm", place.place,
                                                            place.secant_n_per_mm.value, place.secant_n_per_mm.sd),
                     .x = {.label = "depth", .unit = "mm"},
                     .y = {.label = "force", .unit = "N"}};
  plot.series.push_back({.name = "measured",
                         .x = place.rows.depth_mm,
                         .y = place.rows.force_n,
                         .stroke = figures::Stroke::none,
                         .marker = figures::Marker::circle,
                         .colour = figures::Colour{0.55, 0.55, 0.55}});
  for (std::size_t i = 0; i < place.forms.size(); ++i) plot.series.push_back(formSeries(place, i));
  return plot;
}

/// A panel a place; of one that was refused the rows alone.
figures::Figure placeStiffnessFigure(const measure::PlaceFits& fits) {
  figures::Figure figure{.title = "stiffness of places", .columns = fits.places.size() > 1 ? 2 : 1};
  for (const PlaceStiffness& place : fits.places) {
    if (figure.panels.size() < kMaxPlacePanels) figure.panels.emplace_back(placePanel(place));
  }
  figure.note = "Next to each form: its error (root mean square). Solid: the chosen form.";
  return figure;
}

using tissue::ForceForm;

struct MeasureStiffnessArguments {
  std::string file;
  std::string keys;
  std::optional<ForceForm> form;
  std::string output;
  std::string plot;
  bool json = false;
};

std::string formatSceneKeys(const measure::PlaceFits& fits, const std::string& table) {
  return fmt::format("[ellipses]\nkey_points = \"{}\"\n\n[stiffness]\nsource = \"points\"\n\n[tissue]\n{}",
                     table.empty() ? "TABLE.csv (write it with -o)" : table, tissueKeys(fits));
}

// --- text

std::string formatPlusMinus(double value, double error) {
  return std::isfinite(error) && error > 0.0 ? fmt::format("{:.3g} +- {:.1g}", value, error)
                                             : fmt::format("{:.3g}", value);
}

/// "F = 0.031 d^1.62" and the like: d in mm, F in N.
std::string formatFormula(const tissue::ForceFit& fit) {
  const double k = fit.secant.value;
  if (fit.form == ForceForm::linear) return fmt::format("F = {:.3g} d", k);
  const double first = fit.numbers.front().value;
  if (fit.form == ForceForm::power) {
    return fmt::format("F = {:.3g} d^{:.2f}", k * std::pow(tissue::kReferenceDepthMm, 1.0 - first), first);
  }
  return fmt::format("stiffens {:.1f} times within {:.1f} mm", first, fit.numbers.at(1).value);
}

std::string placeText(const PlaceStiffness& place) {
  if (place.refused()) return fmt::format("{:<12}refused: {}\n", place.place, place.refusal);
  std::string text;
  for (std::size_t i = 0; i < place.forms.size(); ++i) {
    const measure::FormOfPlace& form = place.forms[i];
    text += fmt::format("{:<12}{:<12}{:<18}{:>6.3f}{:>9.3f}{:>9.1f} %  {}{}\n", i == 0 ? place.place : "",
                        nameOf(form.fit.form), formatPlusMinus(form.fit.secant.value, form.fit.secant.standard_error),
                        form.r_squared, form.rms_n, 100.0 * form.fit.unseen_rms, formatFormula(form.fit),
                        i == place.chosen ? "  <-" : "");
  }
  if (place.presses > 1) {
    text += fmt::format("{:<12}{} presses, {} people: {} N/mm\n", "", place.presses, place.subjects,
                        formatPlusMinus(place.secant_n_per_mm.value, place.secant_n_per_mm.sd));
  }
  for (const std::string& warning : place.warnings) text += fmt::format("{:<12}warning: {}\n", "", warning);
  return text;
}

std::string textOf(const measure::PlaceFits& fits, const std::string& table) {
  std::string text = fmt::format("{:<12}{:<12}{:<18}{:>6}{:>9}{:>11}  {}\n", "place", "form", "N/mm at 8 mm", "R2",
                                 "rms, N", "unseen", "");
  for (const PlaceStiffness& place : fits.places) text += placeText(place);
  if (fits.shared) text += "\nin a scene:\n" + formatSceneKeys(fits, table);
  return text;
}

// --- JSON

Json formJson(const measure::FormOfPlace& form) {
  Json json = {{"form", nameOf(form.fit.form)},
               {"secant_n_per_mm", form.fit.secant.value},
               {"secant_standard_error", form.fit.secant.standard_error}};
  for (const tissue::FittedNumber& number : form.fit.numbers) json[std::string(number.name)] = number.value;
  json["r_squared"] = form.r_squared;
  json["rms_n"] = form.rms_n;
  json["unseen_rms"] = form.fit.unseen_rms;
  return json;
}

Json placeJson(const PlaceStiffness& place) {
  Json json = {{"place", place.place}, {"presses", place.presses}, {"subjects", place.subjects}};
  json["refused"] = place.refused();
  if (place.refused()) {
    json["reason"] = place.refusal;
    return json;
  }
  json["stiffness_n_per_mm"] = place.secant_n_per_mm.value;
  json["sd_n_per_mm"] = place.secant_n_per_mm.sd;
  json["best"] = nameOf(place.best().fit.form);
  json["deepest_mm"] = place.best().fit.deepest_mm;
  json["forms"] = Json::array();
  for (const measure::FormOfPlace& form : place.forms) json["forms"].push_back(formJson(form));
  json["warnings"] = place.warnings;
  return json;
}

Json toJson(const measure::PlaceFits& fits, const std::string& table, const std::vector<std::string>& written) {
  Json json = {{"places", Json::array()}};
  for (const PlaceStiffness& place : fits.places) json["places"].push_back(placeJson(place));
  json["scene"] = fits.shared ? formatSceneKeys(fits, table) : "";
  json["written"] = written;
  return json;
}

void runMeasureStiffness(const MeasureStiffnessArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  const std::vector<measure::PlaceCurve> curves = measure::readPlaceCurves(arguments.file);
  std::vector<maps::KeyPoint> keys;
  if (!arguments.keys.empty()) keys = maps::readKeyPoints(arguments.keys);
  ProgressLine progress;
  const measure::PlaceFits fits = fitPlaces(curves, {.form = arguments.form}, progress.callback());
  progress.clear();
  std::vector<std::string> written;
  if (!arguments.output.empty()) {
    writeFile(arguments.output, measure::stiffnessTable(withStiffness(fits, std::move(keys))));
    written.push_back(arguments.output);
  }
  if (!arguments.plot.empty()) {
    writePicture(placeStiffnessFigure(fits), arguments.plot);
    written.push_back(arguments.plot);
  }
  if (arguments.json) {
    fmt::print("{}\n", jsonDump(toJson(fits, arguments.output, written), 2));
  } else {
    fmt::print("{}", textOf(fits, arguments.output));
    for (const std::string& file : written) fmt::print("-> {}\n", file);
  }
  for (const PlaceStiffness& place : fits.places) {
    if (place.refused()) throw ExitWith(1);
  }
}

}  // namespace

void addMeasureStiffnessCommand(Command& parent) {
  const auto [command, a] =
      addCommand(parent, "stiffness", "Find the stiffness of places from force by depth", runMeasureStiffness);
  command.add_option("forces", a.file, "Table place,x_mm,y_mm,depth_mm,force_n and, optionally, subject, press")
      ->required();
  addChoice(command, "--form", a.form,
            Choices<std::optional<ForceForm>>{{"best", std::nullopt},
                                              {"linear", ForceForm::linear},
                                              {"power", ForceForm::power},
                                              {"stiffening", ForceForm::stiffening}},
            "Form of the law of every place; best: the form that predicts unseen rows best");
  command.add_option("--keys", a.keys, "Key points to give the stiffness of the place with their name");
  namesFileToWrite(
      command.add_option("-o,--out", a.output, "Table of key points to write, as scenes and palpate body map read it"));
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
