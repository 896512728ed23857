#include "dissertation/errata/errata_study.h"

#include <fmt/format.h>

#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/scene/words.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

std::string rowName(const ErratumEffect& effect) {
  if (effect.text.erratum != Erratum::none) return scene::nameOf(effect.text.erratum);
  return effect.inert.empty() ? "none" : "all";
}

std::string activeText(const ErratumEffect& effect) {
  return effect.inert.empty() ? effect.active : fmt::format("{}; inert: {}", effect.active, effect.inert);
}

std::string number(const ErratumEffect& effect, double value, int digits) {
  return !effect.isMeasured() ? "" : fmt::format("{:.{}f}", value, digits);
}

std::vector<std::string> rowCells(const ErratumEffect& effect) {
  return {rowName(effect),
          number(effect, effect.look.touching_percent, 1),
          number(effect, effect.look.peak_force_n, 2),
          number(effect, effect.look.drag_mm, 1),
          number(effect, effect.force_n, 3),
          number(effect, effect.proxy_mm, 2),
          effect.isMeasured() ? fmt::format("{}", effect.lost_ticks) : "",
          number(effect, effect.missed_percent, 0),
          number(effect, effect.skin_mm, 2),
          number(effect, effect.skin_rms_mm, 3),
          number(effect, effect.strain_percent, 1),
          number(effect, effect.moved_ratio, 2),
          effect.isMeasured() ? effect.reading : fmt::format("- ({})", effect.text.choice),
          activeText(effect),
          effect.isMeasured() ? fmt::format("{}; {}", effect.body, effect.tissue) : "",
          effect.text.erratum == Erratum::none ? "" : std::string(wordFor(effect.text.by_default)),
          fmt::format("{}", effect.text.ours)};
}

Json toJsonObject(const ErratumEffect& effect) {
  Json json = {{"erratum", rowName(effect)}, {"printed", effect.text.printed}, {"ours", effect.text.ours}};
  if (effect.text.erratum != Erratum::none) json["by_default"] = wordFor(effect.text.by_default);
  if (!effect.isMeasured()) {
    json["not_measured"] = effect.text.choice;
    return json;
  }
  json["reading"] = effect.reading;
  json["body"] = effect.body;
  json["tissue"] = effect.tissue;
  json["active"] = effect.active;
  if (!effect.inert.empty()) json["inert"] = effect.inert;
  json["touching_percent"] = effect.look.touching_percent;
  json["peak_force_n"] = effect.look.peak_force_n;
  json["drag_mm"] = effect.look.drag_mm;
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
    "touching, peak and drag: of this run by itself; the share of ticks in contact, the largest force, and the "
    "longest\n"
    "that a finger pulls the skin along. The other columns: largest differences of force, proxy, skin and strain from\n"
    "the corrected run (\"none\") with the same active options; ticks at which only one of the two touches; moved\n"
    "vertices as a multiple of the corrected ones; \"missed\" is the largest share of the triangles in the detecting "
    "box\n"
    "that the leaves found lack. A row of an erratum takes that reading alone, \"all\" every switch of fidelity; what "
    "is\n"
    "inert has no place under the active options.\n";

std::vector<const ErratumEffect*> allRows(const ErrataEffects& effects) {
  std::vector<const ErratumEffect*> rows;
  for (const auto* list : {&effects.corrected, &effects.all_literal, &effects.errata}) {
    for (const ErratumEffect& effect : *list) rows.push_back(&effect);
  }
  return rows;
}

/// How the printed form comes back.
std::string switchText(const scene::ErratumText& erratum) {
  switch (erratum.form) {
    case scene::LiteralForm::switchable:
      return fmt::format("fidelity: {}", erratum.choice);
    case scene::LiteralForm::setting:
      return fmt::format("`{}`", erratum.choice);
    case scene::LiteralForm::none:
      return fmt::format("none: {}", erratum.choice);
  }
  return "";
}

Json toJsonArray(const std::vector<ErratumEffect>& effects) {
  Json list = Json::array();
  for (const ErratumEffect& effect : effects) list.push_back(toJsonObject(effect));
  return list;
}

}  // namespace

TextTable tableOf(const ErrataEffects& effects) {
  TextTable table{{"erratum", "touching %", "peak N", "drag mm", "force N", "proxy mm", "lost ticks", "missed %",
                   "skin mm", "rms mm", "strain %", "moved x", "other reading", "active", "body and tissue",
                   "by default", "what the engine does"},
                  {}};
  for (const ErratumEffect* effect : allRows(effects)) table.rows.push_back(rowCells(*effect));
  return table;
}

std::string errataLegend() { return kLegend; }

std::string errataList() {
  TextTable table{{"erratum", "printed", "ours", "by default", "switch"}, {}};
  for (const scene::ErratumText& erratum : scene::errata()) {
    table.rows.push_back({scene::nameOf(erratum.erratum), std::string(erratum.printed), std::string(erratum.ours),
                          std::string(wordFor(erratum.by_default)), switchText(erratum)});
  }
  return toMarkdown(table);
}

std::string errataText(const ErrataEffects& effects) { return plainText(tableOf(effects)) + "\n" + kLegend; }

std::string errataJson(const ErrataEffects& effects) {
  const Json json = {{"corrected", toJsonArray(effects.corrected)},
                     {"all_literal", toJsonArray(effects.all_literal)},
                     {"errata", toJsonArray(effects.errata)}};
  return jsonDump(json, 2) + "\n";
}

void writeErrata(const ErrataEffects& effects, const std::filesystem::path& folder) {
  makeFolder(folder);
  const TextTable table = tableOf(effects);
  writeFile(folder / "errata.md", fmt::format("# What each erratum changes\n\n{}\n{}", kLegend, toMarkdown(table)));
  writeFile(folder / "errata.csv", toCsv(table));
  writeFile(folder / "errata.json", errataJson(effects));
}

}  // namespace palpate::study
