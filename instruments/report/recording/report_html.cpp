#include "report/recording/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "cli/kit/readable_text.h"
#include "palpate/base/base64.h"
#include "palpate/base/language.h"
#include "report/page/report_html.h"

namespace palpate::app {

namespace {

/// Screen and paper, light; system fonts only, nothing from elsewhere.
constexpr std::string_view kPageStyle = R"css(
:root { color-scheme: light; --ink: #222; --quiet: #5d6470; --line: #dfe3e8; --wash: #f5f7f9; --accent: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 66rem; margin: 0 auto; padding: 2.5rem 1.5rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 0.3rem; overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 0.6rem; padding-top: 1.2rem; border-top: 1px solid var(--line); }
p { max-width: 50rem; }
.quiet { color: var(--quiet); }
.summary { margin: 1.2rem 0; padding: 0.9rem 1.2rem 0.9rem 2.2rem; background: var(--wash);
  border-left: 4px solid var(--accent); border-radius: 0 6px 6px 0; }
.summary li { margin: 0.4rem 0; overflow-wrap: anywhere; }
figure { margin: 1.2rem 0; }
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { color: var(--quiet); font-size: 0.9rem; margin: 0.4rem auto 0; max-width: 50rem; }
.wide { overflow-x: auto; margin: 0.6rem 0 1.2rem; }
table { border-collapse: collapse; font-size: 0.9rem; line-height: 1.35; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 0.3rem 0.8rem 0.3rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; vertical-align: bottom; }
.numbers th + th, .numbers td + td { text-align: right; padding-left: 0.8rem; padding-right: 0; }
.facts th { width: 9rem; }
.facts td, .words td { white-space: pre-wrap; overflow-wrap: anywhere; }
dt { font-weight: 600; margin-top: 0.6rem; }
dd { margin: 0 0 0 1.2rem; max-width: 48rem; }
@media print {
  @page { margin: 16mm; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  figure, tr, .summary li, dt, dd { break-inside: avoid; }
  h2, dt { break-after: avoid; }
  .wide { overflow: visible; }
  table { font-size: 8.5pt; }
}
)css";

/// Takes the smaller of SVG and PNG: curves are small as SVG, surfaces as PNG.
std::string pictureData(const figures::Figure& figure) {
  constexpr double kPixels = 1.6;  // for a CSS pixel: sharp on screens and on paper
  const std::string png = figures::renderPng(figure, kPixels);
  const bool surfaces = std::ranges::any_of(
      figure.panels, [](const figures::Panel& panel) { return std::holds_alternative<figures::MeshView>(panel); });
  if (surfaces) return "data:image/png;base64," + base64(png);
  const std::string svg = figures::renderSvg(figure);
  return svg.size() <= png.size() ? "data:image/svg+xml;base64," + base64(svg) : "data:image/png;base64," + base64(png);
}

std::string htmlRow(std::string_view tag, const Cells& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += htmlElement(tag, cell);
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

std::string htmlElement(std::string_view tag, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>", tag, escapedText(text));
}

std::string headingHtml(std::string_view text) { return htmlElement("h2", text) + "\n"; }

std::string paragraphHtml(std::string_view text) { return htmlElement("p", text) + "\n"; }

std::string tableOf(std::string_view kind, const Cells& headings, const std::vector<Cells>& rows) {
  std::string html = fmt::format("<div class=\"wide\"><table class=\"{}\">", kind);
  if (!headings.empty()) html += "<thead>" + htmlRow("th", headings) + "</thead>";
  html += "<tbody>\n";
  for (const Cells& row : rows) html += htmlRow("td", row);
  return html + "</tbody></table></div>\n";
}

std::string factRow(std::string_view name, std::string_view value) {
  return value.empty() ? std::string()
                       : fmt::format("<tr>{}{}</tr>\n", htmlElement("th", name), htmlElement("td", value));
}

std::string figureHtml(std::string_view id, const figures::Figure& figure, std::string_view alternative,
                       std::string_view caption) {
  return fmt::format("<figure id=\"{}\"><img alt=\"{}\" src=\"{}\" />{}</figure>\n", id, escapedText(alternative),
                     pictureData(figure), htmlElement("figcaption", caption));
}

std::string pageBegin(std::string_view name) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\" />\n{}\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n{}\n<style>{}</style>\n</head>\n"
      "<body>\n<main>\n{}\n",
      language().code, kReportMark, htmlElement("title", name), kPageStyle, htmlElement("h1", name));
}

std::string summaryHtml(const std::vector<std::string>& sentences) {
  std::string html = "<ul class=\"summary\">\n";
  for (const std::string& sentence : sentences) html += htmlElement("li", sentence) + "\n";
  return html + "</ul>\n";
}

std::string definitionsHtml(const std::vector<std::pair<std::string, std::string>>& meanings) {
  std::string html = headingHtml(tr("What the terms mean")) + "<dl>\n";
  for (const auto& [word, meaning] : meanings) html += htmlElement("dt", word) + htmlElement("dd", meaning) + "\n";
  return html + "</dl>\n";
}

}  // namespace palpate::app
