#include "solve/commands/fit_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/kit/json.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

using tissue::FittedNumber;
using tissue::ProfileFit;
using tissue::ProfileForm;

std::size_t indexOf(ProfileForm form) { return static_cast<std::size_t>(form); }

/// Over the depths.
double worstOverDepths(const ProfileResult& result, ProfileForm form, double ProfileFit::*miss) {
  double worst = 0.0;
  for (const auto& of_depth : result.fits) worst = std::max(worst, of_depth[indexOf(form)].*miss);
  return worst;
}

std::string formsText(const ProfileResult& result) {
  std::string text = fmt::format("{:<15}{:>10}{:>10}{:>10}   worst of {} depths\n", "form", "RMS", "unseen", "largest",
                                 result.profiles.size());
  for (const ProfileForm form : tissue::kProfileForms) {
    text += fmt::format("{:<15}{:>8.2f} %{:>8.2f} %{:>8.1f} %{}\n", nameOf(form),
                        100.0 * worstOverDepths(result, form, &ProfileFit::rms),
                        100.0 * worstOverDepths(result, form, &ProfileFit::unseen_rms),
                        100.0 * worstOverDepths(result, form, &ProfileFit::largest_miss),
                        form == result.chosen ? "  <-" : "");
  }
  return text;
}

std::string shapeNumbers(const ProfileFit& fit) {
  std::string text;
  for (const FittedNumber& number : fit.numbers) {
    text += fmt::format("{}{} {:.4g}{}", text.empty() ? "" : ", ", number.name, number.value,
                        number.at_end ? " (at the end of its range)" : "");
  }
  return text;
}

std::string depthsText(const ProfileResult& result) {
  std::string text = fmt::format("{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}  {}\n", "depth", "skin", "places", "RMS", "vector",
                                 "force", nameOf(result.chosen));
  for (std::size_t i = 0; i < result.profiles.size(); ++i) {
    const ProfileFit& fit = result.chosenFit(i);
    const std::string vector_rms = fit.vector_rms ? fmt::format("{:.2f} %", 100.0 * *fit.vector_rms) : "-";
    const std::string force = result.force ? fmt::format("{:.3f} N", result.table.shapes[i].force_n) : "-";
    text += fmt::format("{:>8.2f}{:>8.2f}{:>8}{:>7.2f} %{:>9}{:>9}  {}\n", fit.depth_mm, fit.surface_mm, fit.places,
                        100.0 * fit.rms, vector_rms, force, shapeNumbers(fit));
  }
  return text;
}

/// Lines for a scene that uses the table, or its missing part.
std::string tableKeys(const ProfileResult& result) {
  if (!result.force || result.table.stack.layers.empty()) {
    return "the table as layers of a scene: needs --forces and --layer\n";
  }
  return fmt::format(
      "the table as layers of a scene:\n[tissue]\nlayer_table = \"{}\"\n\n[deformation]\ntissue = \"layered\"\n",
      result.table_file.empty() ? "TABLE.json (write it with -o)" : result.table_file);
}

/// Lines for a scene that uses the one curve for all depths.
std::string profileKeys(const ProfileResult& result) {
  return fmt::format(
      "[deformation]\ntissue = \"gaussian\"\nprofile = \"user\"\nprofile_file = \"{}\"\nregion = \"linear\"\n"
      "normal_radius_mm = {:.4g}\nnormal_radius_per_depth = {:.4g}\n",
      result.profile_file.empty() ? "PROFILE.csv (write it with --profile)" : result.profile_file,
      result.shared.radius_mm, result.shared.radius_per_depth);
}

Json profileFitJson(const ProfileFit& fit) {
  Json json = {{"form", nameOf(fit.form)},
               {"surface_mm", fit.surface_mm},
               {"surface_measured", fit.surface_measured},
               {"rms", fit.rms},
               {"unseen_rms", fit.unseen_rms},
               {"vector_rms", orNull(fit.vector_rms)},
               {"largest_miss", fit.largest_miss}};
  json["numbers"] = numbersJson(fit.numbers);
  if (fit.form != ProfileForm::measured) {
    json["outward_mm"] = fit.outward_mm;
    json["outward_width_mm"] = fit.outward_width_mm;
  }
  return json;
}

}  // namespace

std::string textOf(const ProfileResult& result) {
  std::string text = fmt::format("{}: {} depths\n\n", result.file, result.profiles.size());
  text += formsText(result) + "\n" + depthsText(result);
  text += "\nRMS over the area within 40 mm, of the skin's depth on the axis; unseen: of places left out of the fit.\n";
  if (!result.chosenFit(0).surface_measured) {
    text += "No place within 2 mm of the axis: the skin is assumed to touch the indenter there.\n";
  }
  text += "\n" + tableKeys(result);
  text += fmt::format("\none curve for all depths, which misses by {:.1f} %, as a scene's own profile:\n",
                      100.0 * result.shared.rms);
  text += profileKeys(result);
  for (const std::string& file : result.written) text += "-> " + file + "\n";
  return text;
}

Json toJson(const ProfileResult& result) {
  Json json = {{"file", result.file}, {"chosen", nameOf(result.chosen)}};
  json["rms_worst"] = worstOverDepths(result, result.chosen, &ProfileFit::rms);
  json["depths"] = Json::array();
  for (std::size_t i = 0; i < result.profiles.size(); ++i) {
    Json depth = {{"depth_mm", result.profiles[i].depth_mm}, {"places", result.profiles[i].radius_mm.size()}};
    depth["force_n"] = result.force ? Json(result.table.shapes[i].force_n) : Json(nullptr);
    for (const ProfileFit& fit : result.fits[i]) depth["fits"].push_back(profileFitJson(fit));
    json["depths"].push_back(std::move(depth));
  }
  json["shared_profile"] = {{"normal_radius_mm", result.shared.radius_mm},
                            {"normal_radius_per_depth", result.shared.radius_per_depth},
                            {"rms", result.shared.rms}};
  json["scene"] = profileKeys(result);
  json["written"] = result.written;
  return json;
}

}  // namespace palpate::app
