#include "study/numbers_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "palpate/base/text.h"
#include "study/folder.h"

namespace palpate::study {

namespace {

constexpr std::array kVerdicts{Verdict::reproduced, Verdict::misprint, Verdict::not_reproduced, Verdict::inconsistent,
                               Verdict::not_computable};

std::string verdictText(const NumberRow& row) {
  const std::string_view name = nameOf(row.verdict);
  return row.erratum > 0 ? fmt::format("{} (E{})", name, row.erratum) : std::string(name);
}

std::vector<std::string> cellsOf(const NumberRow& row) {
  return {row.where, row.what, row.printed, row.ours, verdictText(row), row.reason};
}

std::vector<std::string> headings() { return {"where", "number", "printed", "ours", "verdict", "how or why"}; }

std::string closingLine(const std::vector<NumberRow>& rows) {
  std::string line;
  for (const Verdict verdict : kVerdicts) {
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", countOf(rows, verdict), nameOf(verdict));
  }
  return line;
}

using Widths = std::vector<std::size_t>;

Widths widthsOf(const std::vector<NumberRow>& rows) {
  Widths widths;
  for (const std::string& heading : headings()) widths.push_back(heading.size());
  for (const NumberRow& row : rows) {
    const auto cells = cellsOf(row);
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  return widths;
}

std::string aligned(const std::vector<std::string>& cells, const Widths& widths) {
  std::string line;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) line += fmt::format("{:<{}}  ", cells[i], widths[i]);
  return line + cells.back() + "\n";
}

nlohmann::ordered_json objectOf(const NumberRow& row) {
  nlohmann::ordered_json json = {{"where", row.where},
                                 {"what", row.what},
                                 {"printed", row.printed},
                                 {"ours", row.ours},
                                 {"verdict", nameOf(row.verdict)}};
  if (row.erratum > 0) json["erratum"] = fmt::format("E{}", row.erratum);
  json["reason"] = row.reason;
  return json;
}

nlohmann::ordered_json listOf(const std::vector<NumberRow>& rows, bool deciding) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NumberRow& row : rows) {
    if (decides(row.verdict) == deciding) list.push_back(objectOf(row));
  }
  return list;
}

std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string markdownRow(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string markdownTable(const std::vector<NumberRow>& rows, bool deciding) {
  std::string table = markdownRow(headings()) + markdownRow(std::vector<std::string>(headings().size(), "---"));
  for (const NumberRow& row : rows) {
    if (decides(row.verdict) == deciding) table += markdownRow(cellsOf(row));
  }
  return table;
}

}  // namespace

std::string textOf(const std::vector<NumberRow>& rows) {
  const Widths widths = widthsOf(rows);
  std::string text = aligned(headings(), widths);
  for (const NumberRow& row : rows) text += aligned(cellsOf(row), widths);
  return text + "\n" + closingLine(rows) + "\n";
}

std::string jsonOf(const std::vector<NumberRow>& rows) {
  nlohmann::ordered_json counts;
  for (const Verdict verdict : kVerdicts) counts[nameOf(verdict)] = countOf(rows, verdict);
  const nlohmann::ordered_json json = {{"holds", studyHolds(rows)},
                                       {"counts", counts},
                                       {"rows", listOf(rows, true)},
                                       {"statements", listOf(rows, false)}};
  return json.dump(2) + "\n";
}

std::string markdownOf(const std::vector<NumberRow>& rows) {
  return "# The dissertation's numbers beside ours\n\n" + closingLine(rows) +
         ".\n\n## Numbers that can be computed\n\n" + markdownTable(rows, true) +
         "\n## Statements that contradict themselves, and numbers that nobody can compute today\n\n" +
         markdownTable(rows, false);
}

std::string csvOf(const std::vector<NumberRow>& rows) {
  std::string csv = "where,number,printed,ours,verdict,erratum,reason\n";
  for (const NumberRow& row : rows) {
    const std::string erratum = row.erratum > 0 ? fmt::format("E{}", row.erratum) : "";
    csv += fmt::format("{},{},{},{},{},{},{}\n", quoted(row.where), quoted(row.what), quoted(row.printed),
                       quoted(row.ours), quoted(std::string(nameOf(row.verdict))), erratum, quoted(row.reason));
  }
  return csv;
}

void writeNumbers(const std::vector<NumberRow>& rows, const std::filesystem::path& folder) {
  makeFolder(folder);
  writeFile(folder / "numbers.md", markdownOf(rows));
  writeFile(folder / "numbers.csv", csvOf(rows));
  writeFile(folder / "numbers.json", jsonOf(rows));
}

}  // namespace palpate::study
