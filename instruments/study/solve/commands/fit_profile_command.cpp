// `palpate tissue fit profile --data CURVES.csv`: a table of layered tissue, and a scene's own profile, from measured
// skin.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
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
#include "report/charts/picture_file.h"
#include "solve/commands/commands.h"
#include "solve/commands/fit_reports.h"

namespace palpate::app {

namespace {

using tissue::ProfileForm;

constexpr const char* kBestProfileWord = "best";

struct FitProfileArguments {
  std::string data;
  std::string forces;
  std::vector<std::string> layers;
  std::string form = kBestProfileWord;
  double indenter_radius_mm = 8.0;
  std::string output;
  std::string profile;
  std::string plot;
  bool json = false;
};

void fitDepths(ProfileResult& result) {
  ProgressLine progress;
  try {
    for (const tissue::SkinProfile& profile : result.profiles) {
      const auto done = static_cast<double>(result.fits.size()) / static_cast<double>(result.profiles.size());
      report(progress.callback(), "fitting", done);
      auto& of_depth = result.fits.emplace_back();
      for (const ProfileForm form : tissue::kProfileForms) of_depth.push_back(fitProfile(profile, form));
    }
  } catch (const Error& error) {
    throw Error::inFile(result.file, error.what());
  }
}

ProfileForm chooseProfileForm(const FitProfileArguments& arguments, const ProfileResult& result) {
  for (const ProfileForm form : tissue::kProfileForms) {
    if (nameOf(form) == arguments.form) return form;
  }
  return bestForm(result.fits);
}

/// The law of the only curve of the file.
tissue::ForceFit forceFrom(const std::string& file) {
  const std::vector<tissue::ForceCurve> curves = tissue::readForceCurves(file);
  if (curves.size() > 1) throw Error::inFile(file, "holds several curves; expected one, for a table of tissue");
  try {
    return bestOf(fitForces(curves.front(), {}));
  } catch (const Error& error) {
    throw Error::inFile(file, error.what());
  }
}

/// Largest radius at which every depth was measured.
double commonRadius(const std::vector<tissue::SkinProfile>& profiles) {
  double radius = profiles.front().radius_mm.back();
  for (const tissue::SkinProfile& profile : profiles) radius = std::min(radius, profile.radius_mm.back());
  return radius;
}

void makeTable(const FitProfileArguments& arguments, ProfileResult& result) {
  tissue::LayeredTable& table = result.table;
  for (const std::string& layer : arguments.layers) table.stack.layers.push_back(tissue::parseLayer(layer));
  table.indenter_radius_mm = arguments.indenter_radius_mm;
  table.radii_mm = tissue::tableRadii(commonRadius(result.profiles));
  for (std::size_t i = 0; i < result.profiles.size(); ++i) {
    table.shapes.push_back(shapeOf(result.chosenFit(i), table.radii_mm));
    if (result.force) table.shapes.back().force_n = forceOf(*result.force, result.profiles[i].depth_mm);
  }
  try {
    check(table);
  } catch (const Error& error) {
    throw Error::inFile(result.file, error.what());
  }
  result.shared = sharedProfile(table.radii_mm, table.shapes);
}

void writeProfile(const std::string& file, ProfileResult& result) {
  std::string text = fmt::format("# pressed skin of {}\nq,value\n", oneLine(result.file, 200));
  for (const tissue::ProfileKnot& knot : result.shared.knots)
    text += fmt::format("{:.6g},{:.6g}\n", knot.q, knot.value);
  writeFile(file, text);
  result.profile_file = file;
  result.written.push_back(file);
}

void runFitProfile(const FitProfileArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  ProfileResult result;
  result.file = arguments.data;
  result.profiles = tissue::readSkinProfiles(arguments.data);
  if (!arguments.forces.empty()) result.force = forceFrom(arguments.forces);
  fitDepths(result);
  result.chosen = chooseProfileForm(arguments, result);
  makeTable(arguments, result);
  if (!arguments.output.empty()) {
    writeLayeredTable(arguments.output, result.table);
    result.table_file = arguments.output;
    result.written.push_back(arguments.output);
  }
  if (!arguments.profile.empty()) writeProfile(arguments.profile, result);
  if (!arguments.plot.empty()) {
    writePicture(profileFitFigure(result), arguments.plot);
    result.written.push_back(arguments.plot);
  }
  fmt::print("{}", arguments.json ? jsonDump(toJson(result), 2) + "\n" : textOf(result));
}

std::vector<std::string> profileFormChoices() {
  std::vector<std::string> words = {kBestProfileWord};
  for (const ProfileForm form : tissue::kProfileForms) words.emplace_back(nameOf(form));
  return words;
}

}  // namespace

void addFitProfileCommand(Command& parent) {
  const auto [command, a] =
      addCommand(parent, "profile", "Find the shape of pressed skin from measured places", runFitProfile);
  command.add_option("--data,CURVES", a.data, "Table depth_mm,r_mm,down_mm and, if measured, outward_mm")->required();
  command.add_option("--forces", a.forces,
                     "Table depth_mm,force_n of the same place (default: forces are 0, which means unknown)");
  command.add_option("--layer", a.layers, "Layer at the place, NAME:THICKNESS:MODULUS; repeat it from the skin down")
      ->allow_extra_args(false);
  addNumber(command, "--indenter-radius-mm", a.indenter_radius_mm, between(0.1, 1000.0, "mm"), "Radius of the sphere");
  restrictTo(profileFormChoices(),
             command.add_option("--form", a.form,
                                "Form of the profile in the table; best: the form that predicts unseen places best"))
      ->capture_default_str();
  namesFileToWrite(
      command.add_option("-o,--out", a.output, "Table of layered tissue to write (docs/reference/tissue-tables.md)"));
  command.add_option("--profile", a.profile, "Table q,value to write, for profile_file of a scene");
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
