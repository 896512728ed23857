// `palpate tissue fit force CURVES.csv`: a force law for measured curves, and the scene keys that use it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/commands.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/tissue/fitting/smoothed_force.h"
#include "report/charts/picture_file.h"
#include "solve/commands/force_fit_figure.h"
#include "solve/commands/force_report.h"

namespace palpate::app {

namespace {

using tissue::ForceCurve;
using tissue::ForceFit;
using tissue::ForceForm;

/// Of --form: a form, or the one that foretells unseen rows best.
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

ForceForm formOf(const FitForceArguments& arguments, const ForceResult& result) {
  for (const ForceForm form : tissue::kForceForms) {
    if (nameOf(form) == arguments.form) return form;
  }
  return bestOf(result.fits()).form;
}

void writeTable(const FitForceArguments& arguments, ForceResult& result) {
  const ForceFit& fit = fitOf(result.fits(), result.chosen);
  const std::string made = fmt::format("# {} law fitted to {}, {:.4g} N/mm at {} mm\n", nameOf(fit.form),
                                       oneLine(arguments.file, 200), fit.secant.value, tissue::kReferenceDepthMm);
  writeFile(arguments.output, made + forceTableText(tableOf(fit)));
  result.table = arguments.output;
  result.written.push_back(arguments.output);
}

void runFitForce(const FitForceArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  ForceResult result = fitted(arguments);
  result.chosen = formOf(arguments, result);
  if (!arguments.output.empty()) writeTable(arguments, result);
  if (!arguments.plot.empty()) {
    writePicture(forceFitFigure(result), arguments.plot);
    result.written.push_back(arguments.plot);
  }
  fmt::print("{}", arguments.json ? jsonOf(result).dump(2) + "\n" : textOf(result));
}

std::vector<std::string> formWords() {
  std::vector<std::string> words = {kBestWord};
  for (const ForceForm form : tissue::kForceForms) words.emplace_back(nameOf(form));
  return words;
}

}  // namespace

void addFitForceCommand(CLI::App& parent) {
  const auto arguments = std::make_shared<FitForceArguments>();
  FitForceArguments& a = *arguments;
  CLI::App& command = *parent.add_subcommand("force", "Find the force law of measured force by depth");
  command.add_option("--data,CURVES", a.file, "Table depth_mm,force_n and, where there are several, curve or place")
      ->required();
  command.add_option("--curve", a.curves, "Only this curve, by its name; repeatable")->allow_extra_args(false);
  takesOneOf(formWords(), command.add_option("--form", a.form,
                                             "Of the table and the scene keys; best: what foretells unseen rows best"))
      ->capture_default_str();
  command.add_flag("--free-offset", a.settings.free_offset,
                   "Look for the depth at which each curve meets the skin, instead of at 0");
  addNumber(command, "--most-offset-mm", a.settings.most_offset_mm, above(0.0, 100.0, "mm"),
            "No deeper than this; with --free-offset")
      ->capture_default_str();
  command.add_option("-o,--out", a.output, "Table to write, as force_table of a scene reads it");
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
  command.callback([arguments] { runFitForce(*arguments); });
}

}  // namespace palpate::app
