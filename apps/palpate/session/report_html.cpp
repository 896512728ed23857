// Own.
#include "apps/palpate/session/report_html.h"

#include <fmt/format.h>

namespace palpate::app {

namespace {

std::string rowOf(std::string_view tag, const Cells& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += elementOf(tag, cell);
  return html + "</tr>\n";
}

}  // namespace

std::string escapedText(std::string_view text) {
  std::string html;
  for (const char letter : readableText(text)) {
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += letter;
    }
  }
  return html;
}

std::string elementOf(std::string_view tag, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>", tag, escapedText(text));
}

std::string tableOf(std::string_view kind, const Cells& headings, const std::vector<Cells>& rows) {
  std::string html = fmt::format("<div class=\"wide\"><table class=\"{}\">", kind);
  if (!headings.empty()) html += "<thead>" + rowOf("th", headings) + "</thead>";
  html += "<tbody>\n";
  for (const Cells& row : rows) html += rowOf("td", row);
  return html + "</tbody></table></div>\n";
}

}  // namespace palpate::app
