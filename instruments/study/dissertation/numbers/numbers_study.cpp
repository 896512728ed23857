#include "dissertation/numbers/numbers_study.h"

#include <fmt/format.h>
#include <functional>

#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "report/page/study_page.h"

namespace palpate::study {

std::vector<NumberRow> studyNumbers(const PrintedNumbers& printed) {
  Rows rows;
  addHaptics(printed, rows);
  addPartitionComplexity(printed, rows);
  addMeasuredRates(printed, rows);
  addProfile(printed, rows);
  addInterpolation(printed, rows);
  addMeasuredEllipses(printed, rows);
  addStatements(printed, rows);
  return rows;
}

namespace {

std::string verdictText(const NumberRow& row) {
  const std::string_view name = wordFor(row.verdict);
  return row.erratum != Erratum::none ? fmt::format("{} (E{})", name, numberOf(row.erratum)) : std::string(name);
}

std::string offText(const NumberRow& row) { return row.off_percent ? fmt::format("{:+.2g} %", *row.off_percent) : ""; }

std::vector<std::string> rowCells(const NumberRow& row) {
  return {row.where, row.what, row.printed, row.ours, offText(row), row.tolerance, verdictText(row), row.reason};
}

Json toJsonObject(const NumberRow& row) {
  Json json = {{"where", row.where},
               {"what", row.what},
               {"printed", row.printed},
               {"ours", row.ours},
               {"verdict", wordFor(row.verdict)},
               {"tolerance", row.tolerance}};
  if (row.off_percent) json["off_percent"] = *row.off_percent;
  if (row.erratum != Erratum::none) json["erratum"] = fmt::format("E{}", numberOf(row.erratum));
  json["reason"] = row.reason;
  return json;
}

Json toJsonArray(const std::vector<NumberRow>& rows, bool deciding) {
  Json list = Json::array();
  for (const NumberRow& row : rows) {
    if (decides(row.verdict) == deciding) list.push_back(toJsonObject(row));
  }
  return list;
}

constexpr const char* kNumbersLegend =
    "off: ours over the printed number. tolerance: how far ours may be from it, half of the last printed digit where\n"
    "nothing else is said. from our engine: computed by the engine's code. arithmetic of printed numbers: a "
    "reciprocal,\n"
    "a ratio, a mean or a comparison of other printed numbers, which shows that the text agrees with itself.\n";

TextTable tableWhere(const std::vector<NumberRow>& rows, const std::function<bool(const NumberRow&)>& wanted) {
  TextTable table{{"where", "number", "printed", "ours", "off", "tolerance", "verdict", "how or why"}, {}};
  for (const NumberRow& row : rows) {
    if (wanted(row)) table.rows.push_back(rowCells(row));
  }
  return table;
}

TextTable wholeTable(const std::vector<NumberRow>& rows) {
  return tableWhere(rows, [](const NumberRow&) { return true; });
}

}  // namespace

TextTable tableOf(const std::vector<NumberRow>& rows, bool deciding) {
  return tableWhere(rows, [=](const NumberRow& row) { return decides(row.verdict) == deciding; });
}

std::string countsLine(const std::vector<NumberRow>& rows) {
  std::string line;
  for (const auto& [word, verdict] : WordsOf<Verdict>::kAll) {
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", countRows(rows, verdict), word);
  }
  return line;
}

std::string numbersLegend() { return kNumbersLegend; }

std::string textOf(const std::vector<NumberRow>& rows) {
  return plainText(wholeTable(rows)) + "\n" + kNumbersLegend + "\n" + countsLine(rows) + "\n";
}

std::string toJson(const std::vector<NumberRow>& rows) {
  Json counts;
  for (const auto& [word, verdict] : WordsOf<Verdict>::kAll) counts[word] = countRows(rows, verdict);
  const Json json = {{"holds", studyHolds(rows)},
                     {"counts", counts},
                     {"rows", toJsonArray(rows, true)},
                     {"statements", toJsonArray(rows, false)}};
  return jsonDump(json, 2) + "\n";
}

std::string toMarkdown(const std::vector<NumberRow>& rows) {
  return "# The dissertation's numbers beside ours\n\n" + countsLine(rows) + ".\n\n" + kNumbersLegend +
         "\n## Numbers that can be computed\n\n" + toMarkdown(tableOf(rows, true)) +
         "\n## Statements that contradict themselves, and numbers that nobody can compute today\n\n" +
         toMarkdown(tableOf(rows, false));
}

std::string toCsv(const std::vector<NumberRow>& rows) {
  TextTable table{{"where", "number", "printed", "ours", "off_percent", "tolerance", "verdict", "erratum", "reason"},
                  {}};
  for (const NumberRow& row : rows) {
    const std::string erratum = row.erratum != Erratum::none ? fmt::format("E{}", numberOf(row.erratum)) : "";
    const std::string off = row.off_percent ? fmt::format("{:.4g}", *row.off_percent) : "";
    table.rows.push_back({row.where, row.what, row.printed, row.ours, off, row.tolerance,
                          std::string(wordFor(row.verdict)), erratum, row.reason});
  }
  return toCsv(table);
}

void writeNumbers(const std::vector<NumberRow>& rows, const std::filesystem::path& folder) {
  makeFolder(folder);
  writeFile(folder / "numbers.md", toMarkdown(rows));
  writeFile(folder / "numbers.csv", toCsv(rows));
  writeFile(folder / "numbers.json", toJson(rows));
}

}  // namespace palpate::study
