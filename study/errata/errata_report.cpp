#include "study/errata/errata_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "study/page/study_page.h"
#include "study/page/text_table.h"

namespace palpate::study {

namespace {

std::string nameOf(const ErratumEffect& effect) {
  return effect.text.erratum == Erratum::none ? "all" : scene::nameOf(effect.text.erratum);
}

std::string number(const ErratumEffect& effect, double value, int digits) {
  return effect.reading.empty() ? "" : fmt::format("{:.{}f}", value, digits);
}

std::vector<std::string> cellsOf(const ErratumEffect& effect) {
  return {nameOf(effect),
          number(effect, effect.force_n, 3),
          number(effect, effect.proxy_mm, 2),
          effect.reading.empty() ? "" : fmt::format("{}", effect.lost_ticks),
          number(effect, effect.missed_percent, 0),
          number(effect, effect.skin_mm, 2),
          number(effect, effect.skin_rms_mm, 3),
          number(effect, effect.strain_percent, 1),
          number(effect, effect.moved_ratio, 2),
          effect.reading.empty() ? fmt::format("- ({})", effect.text.choice) : effect.reading,
          fmt::format("{}", effect.text.ours)};
}

nlohmann::ordered_json objectOf(const ErratumEffect& effect) {
  nlohmann::ordered_json json = {
      {"erratum", nameOf(effect)}, {"printed", effect.text.printed}, {"ours", effect.text.ours}};
  if (effect.reading.empty()) {
    json["not_measured"] = effect.text.choice;
    return json;
  }
  json["reading"] = effect.reading;
  json["force_n"] = effect.force_n;
  json["proxy_mm"] = effect.proxy_mm;
  json["lost_ticks"] = effect.lost_ticks;
  json["missed_percent"] = effect.missed_percent;
  json["skin_mm"] = effect.skin_mm;
  json["skin_rms_mm"] = effect.skin_rms_mm;
  json["strain_percent"] = effect.strain_percent;
  json["moved_ratio"] = effect.moved_ratio;
  return json;
}

constexpr const char* kLegend =
    "Each row: the scene with that reading alone against the corrected scene. Largest differences of force, proxy,\n"
    "skin and strain; ticks at which only one of the two touches; moved vertices as a multiple of the corrected ones.\n"
    "Errata of the partition are measured with contact.source = \"hdb\" on both sides; \"missed\" is the largest share "
    "of\n"
    "the triangles in the detecting box that the leaves found lack.\n";

}  // namespace

TextTable tableOf(const std::vector<ErratumEffect>& effects) {
  TextTable table{{"erratum", "force N", "proxy mm", "lost ticks", "missed %", "skin mm", "rms mm", "strain %",
                   "moved x", "other reading", "what the engine does"},
                  {}};
  for (const ErratumEffect& effect : effects) table.rows.push_back(cellsOf(effect));
  return table;
}

std::string errataLegend() { return kLegend; }

std::string errataText(const std::vector<ErratumEffect>& effects) {
  return plainText(tableOf(effects)) + "\n" + kLegend;
}

std::string errataJson(const std::vector<ErratumEffect>& effects) {
  nlohmann::ordered_json json;
  for (const ErratumEffect& effect : effects) {
    if (effect.text.erratum == Erratum::none) {
      json["all_literal"] = objectOf(effect);
    } else {
      json["errata"].push_back(objectOf(effect));
    }
  }
  return json.dump(2) + "\n";
}

void writeErrata(const std::vector<ErratumEffect>& effects, const std::filesystem::path& folder) {
  makeFolder(folder);
  const TextTable table = tableOf(effects);
  writeFile(folder / "errata.md", fmt::format("# What each erratum changes\n\n{}\n{}", kLegend, markdownOf(table)));
  writeFile(folder / "errata.csv", csvOf(table));
  writeFile(folder / "errata.json", errataJson(effects));
}

}  // namespace palpate::study
