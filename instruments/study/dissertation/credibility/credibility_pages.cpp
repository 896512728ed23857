// The file as text, JSON and HTML: the same numbers in each.
#include "dissertation/credibility/credibility.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "report/page/report_html.h"

namespace palpate::study {

namespace {

/// Version of the JSON object, so that readers can refuse unknown ones.
constexpr int kVersion = 1;
constexpr const char* kStandard = "ASME V&V 40-2018, in its shape";

Json evidenceJson(const Evidence& evidence) {
  Json json = {{"name", evidence.name},       {"title", evidence.title},
               {"against", evidence.against}, {"command", evidence.command.empty() ? Json() : Json(evidence.command)},
               {"holds", evidence.holds()},   {"finding", formatFinding(evidence)}};
  json["numbers"] = Json::object();
  for (const CredibilityNumber& number : evidence.numbers) {
    json["numbers"][number.name] = {{"value", number.value},
                                    {"unit", number.unit.empty() ? Json() : Json(number.unit)},
                                    {"bar", number.bar ? Json(*number.bar) : Json()},
                                    {"holds", number.holds()}};
  }
  return json;
}

Json riskJson(const ContextOfUse& use) {
  return {
      {"influence", wordFor(use.influence)}, {"consequence", wordFor(use.consequence)}, {"risk", wordFor(use.risk())}};
}

std::vector<std::string> uncovered(const CredibilityFile& file) {
  std::vector<std::string> names;
  for (const CredibilityFactor& factor : file.factors) {
    if (factor.evidence.empty()) names.push_back(factor.name);
  }
  return names;
}

std::string shownValue(const CredibilityNumber& number) {
  constexpr int kDigits = 4;
  return number.unit.empty() && number.value == static_cast<double>(static_cast<long long>(number.value))
             ? counted(number.value)
             : rounded(number.value, kDigits);
}

/// Every number of a section, one per row.
TextTable numbersTable(const CredibilitySection& section) {
  TextTable table{{"evidence", "number", "value", "unit", "bar", "holds"}, {}};
  for (const Evidence& evidence : section.evidence) {
    for (const CredibilityNumber& number : evidence.numbers) {
      table.rows.push_back({evidence.title, number.name, shownValue(number), number.unit,
                            number.bar ? fmt::format("at most {}", rounded(*number.bar, 4)) : "",
                            !number.bar      ? ""
                            : number.holds() ? "yes"
                                             : "NO"});
    }
  }
  return table;
}

TextTable studiesTable(const CredibilitySection& section) {
  TextTable table{{"evidence", "against", "the same numbers alone"}, {}};
  for (const Evidence& evidence : section.evidence) {
    table.rows.push_back(
        {evidence.title, evidence.against, evidence.command.empty() ? "this study" : "`" + evidence.command + "`"});
  }
  return table;
}

StudyPage sectionPage(const CredibilitySection& section, const CredibilityFile& file) {
  StudyPage page;
  page.name = section.name;
  page.title = section.title;
  page.question = section.holds() ? "All numbers with a bar are within it." : "A number is BEYOND its bar.";
  for (const Evidence& evidence : section.evidence) page.findings.push_back(formatFinding(evidence));
  page.tables = {{section.name, "Every number.", numbersTable(section)},
                 {section.name + "_studies", "What it is compared with.", studiesTable(section)}};
  page.command = file.command;
  page.seconds = file.seconds;
  return page;
}

StudyPage usePage(const CredibilityFile& file) {
  StudyPage page;
  page.name = "context_of_use";
  page.title = "Question, context of use and model risk";
  page.question = file.use.question;
  page.findings = {fmt::format("Model risk is **{}**: influence {}, consequence of a wrong decision {}.",
                               wordFor(file.use.risk()), wordFor(file.use.influence), wordFor(file.use.consequence)),
                   file.use.context};
  TextTable factors{{"factor", "evidence"}, {}};
  for (const CredibilityFactor& factor : file.factors) {
    factors.rows.push_back({factor.name, factor.evidence.empty()
                                             ? "none: see limits"
                                             : fmt::format("{}", fmt::join(factor.evidence, ", "))});
  }
  page.tables = {{"factors", "Credibility factors of the standard, and the evidence for them.", std::move(factors)}};
  page.command = file.command;
  page.seconds = file.seconds;
  return page;
}

StudyPage limitsPage(const CredibilityFile& file) {
  StudyPage page;
  page.name = "limits";
  page.title = "Limits";
  page.question = "What this file does not claim.";
  for (const CredibilityLimit& limit : file.limits) {
    page.findings.push_back(fmt::format("**{}**: {}", limit.name, limit.sentence));
  }
  page.command = file.command;
  page.seconds = file.seconds;
  return page;
}

}  // namespace

std::string textOf(const CredibilityFile& file) {
  std::string text = fmt::format("Credibility of Palpate {}: {}\n\n{}\n", file.release,
                                 file.holds() ? "every bar holds" : "a bar is BROKEN", file.use.question);
  text += fmt::format("Model risk {}: influence {}, consequence {}.\n", wordFor(file.use.risk()),
                      wordFor(file.use.influence), wordFor(file.use.consequence));
  for (const CredibilitySection& section : file.sections) text += "\n" + textOf(sectionPage(section, file));
  text += "\n" + textOf(limitsPage(file));
  return text;
}

std::string toJson(const CredibilityFile& file) {
  Json json = {{"study", "credibility"},
               {"version", kVersion},
               {"standard", kStandard},
               {"release", file.release},
               {"holds", file.holds()},
               {"question_of_interest", file.use.question},
               {"context_of_use", file.use.context},
               {"model_risk", riskJson(file.use)}};
  for (const CredibilitySection& section : file.sections) {
    json[section.name] = {{"holds", section.holds()}, {"evidence", Json::array()}};
    for (const Evidence& evidence : section.evidence) json[section.name]["evidence"].push_back(evidenceJson(evidence));
  }
  json["factors"] = Json::array();
  for (const CredibilityFactor& factor : file.factors) {
    json["factors"].push_back({{"name", factor.name}, {"evidence", factor.evidence}});
  }
  json["factors_without_evidence"] = uncovered(file);
  json["limits"] = Json::array();
  for (const CredibilityLimit& limit : file.limits) {
    json["limits"].push_back({{"name", limit.name}, {"sentence", limit.sentence}});
  }
  json["seed"] = file.seed;
  json["quick"] = file.quick;
  json["command"] = file.command;
  json["machine"] = file.machine;
  json["seconds"] = file.seconds;
  return jsonDump(json, 2) + "\n";
}

std::string toHtml(const CredibilityFile& file) {
  ReportHead head;
  head.title = fmt::format("Credibility of Palpate {}", file.release);
  head.about = file.holds() ? "Every number of this file comes from the run that wrote it, and every bar holds."
                            : "Every number of this file comes from the run that wrote it. A bar is BROKEN.";
  if (file.quick) head.about += " This was a quick run: for a look at the file, not for its numbers.";
  head.about += fmt::format(" Standard: {}.", kStandard);
  head.command = file.command;
  head.machine = file.machine;
  head.seconds = file.seconds;
  std::vector<StudyPage> chapters = {usePage(file)};
  for (const CredibilitySection& section : file.sections) chapters.push_back(sectionPage(section, file));
  chapters.push_back(limitsPage(file));
  return reportHtml(head, chapters, {});  // no figures: no folder is read
}

void writeCredibility(const CredibilityFile& credibility, const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".html") {
    writeFile(file, toHtml(credibility));
  } else if (ending == ".json") {
    writeFile(file, toJson(credibility));
  } else {
    throw Error::inFile(file.string(), "must end in .html or .json");
  }
}

}  // namespace palpate::study
