#include "report/page/study_page.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

// Columns of a terminal.
constexpr std::size_t kLineWidth = 100;

std::string wrapped(const std::string& text, const std::string& first, const std::string& rest) {
  std::istringstream words(text);
  std::string lines, line = first;
  bool fresh = true;
  for (std::string word; words >> word; fresh = false) {
    if (!fresh && line.size() + 1 + word.size() > kLineWidth) {
      lines += line + "\n";
      line = rest;
      fresh = true;
    }
    line += (fresh ? "" : " ") + word;
  }
  return lines + line + "\n";
}

std::string paragraphs(const std::vector<std::string>& texts, std::string_view before = "") {
  std::string markdown;
  for (const std::string& text : texts) markdown += fmt::format("{}{}\n{}", before, text, before.empty() ? "\n" : "");
  return markdown + (before.empty() ? "" : "\n");
}

std::string figureMarkdown(const StudyFigure& figure) {
  const std::string data = toCsv(figure.figure).empty() ? "" : fmt::format(", [CSV]({}.csv)", figure.stem);
  return fmt::format("![{0}]({1}.png)\n\n*{0}* [SVG]({1}.svg){2}\n\n", figure.caption, figure.stem, data);
}

std::string tableMarkdown(const StudyTable& table) {
  const std::string heading = fmt::format("{} [CSV]({}.csv)\n\n", table.title, table.stem);
  return table.shown ? heading + toMarkdown(table.table) + "\n" : heading;
}

std::string endMarkdown(const StudyPage& page) {
  std::string markdown = "## How it was measured\n\n" + paragraphs(page.method);
  markdown += fmt::format("```\n{}\n```\n\n", page.command);
  if (!page.machine.empty()) markdown += page.machine + "\n\n";
  return markdown + fmt::format("The run took {:.0f} s.\n", page.seconds);
}

}  // namespace

std::string toMarkdown(const StudyPage& page) {
  std::string markdown = fmt::format("# {}\n\n{}\n\n## Findings\n\n", page.title, page.question);
  markdown += paragraphs(page.findings, "- ");
  for (const StudyFigure& figure : page.figures) markdown += figureMarkdown(figure);
  if (!page.tables.empty()) markdown += "## Tables\n\n";
  for (const StudyTable& table : page.tables) markdown += tableMarkdown(table);
  return markdown + endMarkdown(page);
}

namespace {

Json rowsAsJson(const TextTable& table) {
  Json rows = Json::array();
  for (const std::vector<std::string>& cells : table.rows) {
    Json row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double number = 0.0;
      const char* end = cells[i].data() + cells[i].size();
      const auto [stopped, error] = std::from_chars(cells[i].data(), end, number);
      if (error == std::errc() && stopped == end) {
        row[table.headings[i]] = number;
      } else {
        row[table.headings[i]] = cells[i];
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The member at the end of a path of names with dots between them.
Json& memberAt(Json& json, std::string_view path) {
  Json* member = &json;
  for (const std::string_view name : split(path, '.')) member = &(*member)[std::string(name)];
  return *member;
}

}  // namespace

std::string toJson(const StudyPage& page) {
  Json json;
  json["study"] = page.name;
  json["title"] = page.title;
  json["findings"] = page.findings;
  json["numbers"] = Json::object();
  for (const auto& [name, value] : page.numbers) {
    json["numbers"][name] = value;
    if (page.numbers_on_top) memberAt(json, name) = value;
  }
  for (const auto& [name, words] : page.words) memberAt(json, name) = words;
  const bool numbers = json.contains("figures");
  for (const StudyFigure& figure : page.figures) {
    memberAt(json, numbers ? "figures.files" : "figures").push_back(figure.stem + ".svg");
  }
  for (const StudyTable& table : page.tables) json["tables"].push_back(table.stem + ".csv");
  for (const StudyTable& table : page.tables) {
    if (!table.key.empty()) json[table.key] = rowsAsJson(table.table);
  }
  json["command"] = page.command;
  json["machine"] = page.machine;
  json["seconds"] = page.seconds;
  return jsonDump(json, 2) + "\n";
}

std::string textOf(const StudyPage& page) {
  std::string text = fmt::format("{}\n\n", page.title);
  for (const std::string& finding : page.findings) text += wrapped(finding, "- ", "  ");
  return text;
}

void writePage(const StudyPage& page, const std::filesystem::path& folder, const Progress& progress) {
  makeFolder(folder);
  for (const StudyFigure& figure : page.figures) {
    report(progress, "drawing " + figure.stem, 0.0);
    figures::writePng(figure.figure, folder / (figure.stem + ".png"));
    figures::writeSvg(figure.figure, folder / (figure.stem + ".svg"));
    const std::string data = toCsv(figure.figure);  // a single surface has none
    if (!data.empty()) writeFile(folder / (figure.stem + ".csv"), data);
  }
  for (const StudyTable& table : page.tables) writeFile(folder / (table.stem + ".csv"), toCsv(table.table));
  writeFile(folder / (page.name + ".md"), toMarkdown(page));
}

std::string counted(double number) {
  const std::string digits = fmt::format("{:.0f}", std::abs(number));
  std::string text = number < 0.0 && digits != "0" ? "-" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += language().thousands_sign;
    text += digits[i];
  }
  return text;
}

std::string rounded(double number, int digits) {
  if (number == 0.0 || !std::isfinite(number)) return fmt::format("{:g}", WrittenNumber{number});
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(number)) + 1e-9));
  const int decimals = digits - 1 - leading;
  const double unit = std::pow(10.0, -decimals);
  return decimals > 0 ? fmt::format("{:.{}f}", WrittenNumber{number}, decimals)
                      : counted(unit * std::round(number / unit));
}

std::string percent(double share) { return rounded(100.0 * share) + " %"; }

void makeFolder(const std::filesystem::path& folder) {
  std::error_code trouble;
  std::filesystem::create_directories(folder, trouble);
  if (trouble) throw Error::inFile(folder.string(), "cannot be made: " + trouble.message());
  if (!std::filesystem::is_directory(folder)) throw Error::inFile(folder.string(), "is not a folder");
}

}  // namespace palpate::study
