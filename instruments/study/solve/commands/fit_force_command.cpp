// `palpate tissue fit force CURVES.csv`: a force law for measured curves, and the scene keys that use it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/tissue/fitting/force_rows.h"
#include "report/charts/figure.h"
#include "report/charts/picture_file.h"
#include "solve/commands/commands.h"
#include "solve/commands/fit_reports.h"

namespace palpate::app {

namespace {

using figures::Plot;
using figures::Series;
using tissue::ForceCurve;
using tissue::ForceFit;
using tissue::ForceForm;

constexpr figures::Colour kRows{0.55, 0.55, 0.55};

figures::Colour colourOf(ForceForm form) { return figures::seriesColour(static_cast<std::size_t>(form)); }

figures::Stroke curveStroke(ForceForm form, ForceForm chosen) {
  return form == chosen ? figures::Stroke::solid : figures::Stroke::dashed;
}

std::string nameWithRms(const ForceFit& fit) { return fmt::format("{}, {:.1f} %", nameOf(fit.form), 100.0 * fit.rms); }

Series lawSeries(const ForceFit& fit, double from_mm, double to_mm, double scale, ForceForm chosen) {
  constexpr int kPoints = 200;
  Series law{.name = nameWithRms(fit), .stroke = curveStroke(fit.form, chosen), .colour = colourOf(fit.form)};
  if (fit.form == chosen) law.width_px = 2.6;
  for (int i = 0; i <= kPoints; ++i) {
    const double depth = from_mm + (to_mm - from_mm) * i / kPoints;
    law.x.push_back(depth);
    law.y.push_back(scale * forceOf(fit, depth));
  }
  return law;
}

Series rowSeries(const std::string& name, const tissue::ForceCurve& curve) {
  return {.name = name,
          .x = curve.depth_mm,
          .y = curve.force_n,
          .stroke = figures::Stroke::none,
          .marker = figures::Marker::circle,
          .colour = kRows};
}

double maxDepth(const tissue::ForceCurve& curve) { return *std::ranges::max_element(curve.depth_mm); }

// --- one curve

Plot forcePlot(const FittedCurve& one, ForceForm chosen) {
  Plot plot{.title = "force", .x = {.label = "depth", .unit = "mm"}, .y = {.label = "force", .unit = "N"}};
  plot.series.push_back(rowSeries("measured", one.curve));
  const double from = std::min(0.0, *std::ranges::min_element(one.curve.depth_mm));
  for (const ForceFit& fit : one.fits) {
    plot.series.push_back(lawSeries(fit, from, maxDepth(one.curve), 1.0, chosen));
  }
  return plot;
}

/// In the measure of the RMS.
Plot missPlot(const FittedCurve& one, ForceForm chosen) {
  Plot plot{
      .title = "what is missed", .x = {.label = "depth", .unit = "mm"}, .y = {.label = "fit - measured", .unit = "%"}};
  const double floor = 0.3 * *std::ranges::max_element(one.curve.force_n);
  for (const ForceFit& fit : one.fits) {
    Series miss{.name = std::string(nameOf(fit.form)),
                .stroke = figures::Stroke::none,
                .marker = fit.form == chosen ? figures::Marker::circle : figures::Marker::cross,
                .colour = colourOf(fit.form)};
    for (std::size_t i = 0; i < one.curve.depth_mm.size(); ++i) {
      const double force = one.curve.force_n[i];
      miss.x.push_back(one.curve.depth_mm[i]);
      miss.y.push_back(100.0 * (forceOf(fit, one.curve.depth_mm[i]) - force) / std::max(force, floor));
    }
    plot.series.push_back(std::move(miss));
  }
  return plot;
}

// --- several

/// In units of its own force at the reference depth, from the contact on.
Series scaledRows(const FittedCurve& one) {
  const ForceFit& power = findFit(one.fits, ForceForm::power);
  const double scale = 1.0 / (tissue::kReferenceDepthMm * power.secant.value);
  const tissue::ForceRows rows = rowsOf(one.curve);
  Series line{.colour = kRows, .width_px = 0.8};
  for (Eigen::Index i = 0; i < rows.depth_mm.size(); ++i) {
    line.x.push_back(rows.depth_mm[i] - power.offset.value);
    line.y.push_back(scale * rows.force_n[i]);
  }
  return line;
}

Plot sharedPlot(const ForceResult& result) {
  Plot plot{.title = "all curves, each by its own stiffness",
            .x = {.label = "depth from the contact", .unit = "mm"},
            .y = {.label = "force over that at 8 mm"}};
  double deepest = 0.0;
  for (const FittedCurve& one : result.curves) {
    plot.series.push_back(scaledRows(one));
    deepest = std::max(deepest, plot.series.back().x.back());
  }
  plot.series.front().name = "measured";
  for (const ForceFit& fit : result.shared) {
    const double scale = 1.0 / (tissue::kReferenceDepthMm * fit.secant.value);
    plot.series.push_back(lawSeries(fit, 0.0, deepest, scale, result.chosen));
  }
  return plot;
}

/// Sorted: how many curves have an exponent up to this.
Plot exponentPlot(const ForceResult& result) {
  Plot plot{.title = "exponents of the places",
            .x = {.label = "exponent of a power law"},
            .y = {.label = "curves up to it", .unit = "%"}};
  Series all{.marker = figures::Marker::circle};
  for (const FittedCurve& one : result.curves) {
    all.x.push_back(findFit(one.fits, ForceForm::power).numbers.front().value);
  }
  std::ranges::sort(all.x);
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    all.y.push_back(100.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(all.x.size()));
  }
  plot.y.from = 0.0;
  plot.y.to = 100.0;
  plot.series.push_back(std::move(all));
  return plot;
}

/// Rows, laws and misses of one curve; for several curves all of them over each other, and their exponents.
figures::Figure forceFitFigure(const ForceResult& result) {
  figures::Figure figure;
  figure.title = result.file;
  figure.columns = 2;
  if (result.shared.empty()) {
    figure.panels = {forcePlot(result.curves.front(), result.chosen), missPlot(result.curves.front(), result.chosen)};
  } else {
    figure.panels = {sharedPlot(result), exponentPlot(result)};
  }
  figure.note =
      "Percentages are of max(force, 0.3 of the largest); in the legend their RMS. The chosen form is drawn through.";
  return figure;
}

/// Value of --form: a form, or the one that predicts unseen rows best.
constexpr const char* kBestWord = "best";

struct FitForceArguments {
  std::string file;
  std::vector<std::string> curves;
  std::string form = kBestWord;
  tissue::ForceFitSettings settings;
  std::string output;
  std::string plot;
  bool json = false;
};

std::vector<ForceCurve> curvesFrom(const FitForceArguments& arguments) {
  std::vector<ForceCurve> curves = tissue::readForceCurves(arguments.file);
  if (arguments.curves.empty()) return curves;
  std::vector<std::string> names;
  for (const ForceCurve& curve : curves) names.push_back(curve.name);
  for (const std::string& wanted : arguments.curves) {
    if (std::ranges::count(names, wanted) > 0) continue;
    throw Error::inFile(arguments.file, unknownName("curve", wanted, "", names));
  }
  std::erase_if(curves, [&](const ForceCurve& curve) { return std::ranges::count(arguments.curves, curve.name) == 0; });
  return curves;
}

ForceResult fitted(const FitForceArguments& arguments) {
  ForceResult result;
  result.file = arguments.file;
  result.free_offset = arguments.settings.free_offset;
  const std::vector<ForceCurve> curves = curvesFrom(arguments);
  ProgressLine progress;
  try {
    for (const ForceCurve& curve : curves) {
      const auto done = static_cast<double>(result.curves.size());
      report(progress.callback(), "fitting", done / static_cast<double>(curves.size()));
      result.curves.push_back({curve, fitForces(curve, arguments.settings)});
    }
    for (const ForceForm form : tissue::kForceForms) {
      if (curves.size() < 2) break;
      report(progress.callback(), "one shape for all", static_cast<double>(form) / tissue::kForceForms.size());
      result.shared.push_back(fitSharedForce(curves, form, arguments.settings));
    }
  } catch (const Error& error) {
    throw Error::inFile(arguments.file, error.what());
  }
  return result;
}

ForceForm chooseForm(const FitForceArguments& arguments, const ForceResult& result) {
  for (const ForceForm form : tissue::kForceForms) {
    if (nameOf(form) == arguments.form) return form;
  }
  return bestOf(result.fits()).form;
}

void writeTable(const FitForceArguments& arguments, ForceResult& result) {
  const ForceFit& fit = findFit(result.fits(), result.chosen);
  const std::string made = fmt::format("# {} law fitted to {}, {:.4g} N/mm at {} mm\n", nameOf(fit.form),
                                       oneLine(arguments.file, 200), fit.secant.value, tissue::kReferenceDepthMm);
  writeFile(arguments.output, made + forceTableText(tableOf(fit)));
  result.table = arguments.output;
  result.written.push_back(arguments.output);
}

void runFitForce(const FitForceArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  ForceResult result = fitted(arguments);
  result.chosen = chooseForm(arguments, result);
  if (!arguments.output.empty()) writeTable(arguments, result);
  if (!arguments.plot.empty()) {
    writePicture(forceFitFigure(result), arguments.plot);
    result.written.push_back(arguments.plot);
  }
  fmt::print("{}", arguments.json ? jsonDump(toJson(result), 2) + "\n" : textOf(result));
}

std::vector<std::string> formChoices() {
  std::vector<std::string> words = {kBestWord};
  for (const ForceForm form : tissue::kForceForms) words.emplace_back(nameOf(form));
  return words;
}

}  // namespace

void addFitForceCommand(Command& parent) {
  const auto [command, a] = addCommand(parent, "force", "Find the force law of measured force by depth", runFitForce);
  command.add_option("--data,CURVES", a.file, "Table depth_mm,force_n and, for several curves, curve or place")
      ->required();
  command.add_option("--curve", a.curves, "Fit only this curve, by its name; repeatable")->allow_extra_args(false);
  restrictTo(formChoices(),
             command.add_option(
                 "--form", a.form,
                 "Form of the law in the table and the scene keys; best: the form that predicts unseen rows best"))
      ->capture_default_str();
  command.add_flag("--free-offset", a.settings.free_offset,
                   "Find the depth at which each curve meets the skin, instead of 0");
  addSetting(command, "--most-offset-mm", a.settings.most_offset_mm, above(0.0, 100.0, "mm"),
             "Largest depth to look at with --free-offset");
  namesFileToWrite(command.add_option("-o,--out", a.output, "Table to write, for force_table of a scene"));
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
