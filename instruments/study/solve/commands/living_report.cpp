#include "solve/commands/realism_reports.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <vector>

#include "palpate/base/json.h"
#include "solve/realism/living_limbs.h"
#include "solve/realism/living_tests.h"

namespace palpate::app {

namespace {

using lab::LimbModel;
using lab::LivingFigures;
using lab::LivingTest;

/// People with odd numbers, whom the limb's muscles were fitted to, and with even ones, whom nothing was fitted to.
struct LivingHalves {
  LivingFigures odd;
  lab::LivingFigures even;
};

struct LivingReport {
  std::size_t people = 0;
  int left_out = 0;
  LivingHalves body;          ///< LimbModel::body
  LivingHalves limb;          ///< LimbModel::limb
  LivingHalves relaxed_limb;  ///< LimbModel::relaxed_limb
};

/// The tests of one half, and the model's values for them.
LivingFigures computeHalfFigures(const std::vector<LivingTest>& tests, const std::vector<double>& n_per_mm, int rest) {
  std::vector<LivingTest> half;
  std::vector<double> stiffness;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (tests[i].person % 2 != rest) continue;
    half.push_back(tests[i]);
    stiffness.push_back(n_per_mm[i]);
  }
  return lab::livingFigures(half, stiffness);
}

double percentNumber(double share) { return std::round(1000.0 * share) / 10.0; }
double ratioNumber(double value) { return std::round(1000.0 * value) / 1000.0; }

Json halfJson(const LivingFigures& figures) {
  Json json = {{"tests", figures.tests},
               {"median_error_percent", percentNumber(figures.median_error)},
               {"bias_percent", percentNumber(figures.bias)},
               {"median_error_without_bias_percent", percentNumber(figures.spread_error)},
               {"thin_cover_ratio", ratioNumber(figures.thinCoverRatio())}};
  json["ratio_by_cover"] = Json::array();
  for (std::size_t c = 0; c < figures.covers.size(); ++c) {
    json["ratio_by_cover"].push_back({{"from_mm", lab::kCoverLimitsMm[c]},
                                      {"to_mm", lab::kCoverLimitsMm[c + 1]},
                                      {"tests", figures.covers[c].tests},
                                      {"ratio", ratioNumber(figures.covers[c].ratio)}});
  }
  return json;
}

std::string figuresLine(const char* model, const char* half, const LivingFigures& figures) {
  std::string line = fmt::format("  {:<14}{:<6}{:>6}{:>9.1f} %{:>+8.0f} %{:>9.1f} %", model, half, figures.tests,
                                 100.0 * figures.median_error, 100.0 * figures.bias, 100.0 * figures.spread_error);
  for (const LivingFigures::Cover& cover : figures.covers) {
    line += fmt::format("{:>14}", cover.tests == 0 ? "-" : fmt::format("{:.2f} ({})", cover.ratio, cover.tests));
  }
  return line + "\n";
}

Json livingJson(const LivingReport& living) {
  Json json = halfJson(living.relaxed_limb.even);
  json["half"] = "even";
  json["model"] = "relaxed_limb";
  json["people"] = living.people;
  json["left_out"] = living.left_out;
  json["fitted_half"] = halfJson(living.relaxed_limb.odd);
  json["default_moduli_on_a_limb"] = {{"even", halfJson(living.limb.even)}, {"odd", halfJson(living.limb.odd)}};
  json["default_body"] = {{"even", halfJson(living.body.even)}, {"odd", halfJson(living.body.odd)}};
  json["sites"] = Json::array();
  for (const lab::LimbSite& site : lab::limbSites()) {
    json["sites"].push_back({{"site", site.code},
                             {"name", site.name},
                             {"bone_radius_mm", site.bone_radius_mm},
                             {"muscle_kpa", site.muscle_kpa}});
  }
  return json;
}

std::string livingText(const LivingReport& living) {
  std::string text = fmt::format(
      "{} presses of a probe on the limbs of {} people; {} rows without thickness left out. Product over living "
      "stiffness:\n",
      living.body.odd.tests + living.body.even.tests, living.people, living.left_out);
  text +=
      fmt::format("  {:<14}{:<6}{:>6}{:>11}{:>10}{:>11}", "layers", "people", "tests", "median", "bias", "without it");
  for (std::size_t c = 0; c + 1 < lab::kCoverLimitsMm.size(); ++c) {
    text += fmt::format("{:>14}", fmt::format("{:g}-{:g} mm", lab::kCoverLimitsMm[c], lab::kCoverLimitsMm[c + 1]));
  }
  text += "\n";
  for (const auto& [model, halves] : {std::pair{"body", &living.body}, std::pair{"limb", &living.limb},
                                      std::pair{"relaxed limb", &living.relaxed_limb}}) {
    text += figuresLine(model, "odd", halves->odd);
    text += figuresLine(model, "even", halves->even);
  }
  text +=
      "body: default layers on a plane of bone; limb: the test's own skin, a round bone and the limb's free sides; "
      "relaxed limb:\nthe muscle of each site at rest, fitted to the odd people alone\n";
  return text;
}

}  // namespace

std::pair<Json, std::string> judgeLiving(const std::filesystem::path& list_or_folder, const Progress& progress) {
  const lab::LivingTests living = lab::readLivingTests(list_or_folder);
  LivingReport result;
  std::set<int> people;
  for (const LivingTest& test : living.tests) people.insert(test.person);
  result.people = people.size();
  result.left_out = living.left_out;
  double done = 0.0;
  for (const auto& [model, halves] :
       {std::pair{LimbModel::body, &result.body}, std::pair{LimbModel::limb, &result.limb},
        std::pair{LimbModel::relaxed_limb, &result.relaxed_limb}}) {
    const auto third = [&](std::string_view stage, double share) { report(progress, stage, done + share / 3.0); };
    const std::vector<double> n_per_mm = lab::probeStiffnesses(living.tests, model, third);
    halves->odd = computeHalfFigures(living.tests, n_per_mm, 1);
    halves->even = computeHalfFigures(living.tests, n_per_mm, 0);
    done += 1.0 / 3.0;
  }
  return {livingJson(result), livingText(result)};
}

}  // namespace palpate::app
