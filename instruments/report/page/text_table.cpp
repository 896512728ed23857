#include "report/page/study_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::study {

namespace {

using Cells = std::vector<std::string>;

std::vector<std::size_t> columnWidths(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& heading : table.headings) widths.push_back(heading.size());
  for (const Cells& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  return widths;
}

std::string aligned(const Cells& cells, const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) line += fmt::format("{:<{}}  ", cells[i], widths[i]);
  return line + cells.back() + "\n";
}

std::string markdownRow(const Cells& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += fmt::format(" {} |", cell);
  return line + "\n";
}

std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return fmt::format("\"{}\"", text);
}

std::string csvRow(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (!line.empty()) line += ',';
    line += quoted(cell);
  }
  return line + "\n";
}

}  // namespace

std::string plainText(const TextTable& table) {
  const auto widths = columnWidths(table);
  std::string text = aligned(table.headings, widths);
  for (const Cells& row : table.rows) text += aligned(row, widths);
  return text;
}

std::string toMarkdown(const TextTable& table) {
  std::string text = markdownRow(table.headings) + markdownRow(Cells(table.headings.size(), "---"));
  for (const Cells& row : table.rows) text += markdownRow(row);
  return text;
}

std::string toCsv(const TextTable& table) {
  std::string text = csvRow(table.headings);
  for (const Cells& row : table.rows) text += csvRow(row);
  return text;
}

}  // namespace palpate::study
