#include "report/page/report_html.h"

#include <fmt/format.h>
#include <algorithm>
#include <string_view>

#include "palpate/base/base64.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::study {

namespace {

/// The look of the report, its style sheet. Screen: contents next to the text where there is room, figures as wide as
/// the column. Paper: no contents, one chapter per page, nothing torn apart. System fonts only.
constexpr std::string_view kReportStyle = R"css(
:root { --ink: #222; --quiet: #5d6470; --line: #dfe3e8; --paper: #fff; --wash: #f5f7f9; --accent: #0072b2; }
* { box-sizing: border-box; }
html { scroll-behavior: smooth; }
body {
  margin: 0; color: var(--ink); background: var(--paper);
  font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif;
}
.sheet { display: grid; grid-template-columns: 17rem minmax(0, 1fr); }
nav {
  position: sticky; top: 0; align-self: start; height: 100vh; overflow: auto; padding: 2rem 1.25rem;
  background: var(--wash); border-right: 1px solid var(--line); font-size: 0.9rem;
}
nav p { margin: 0 0 0.75rem; font-weight: 600; }
nav ol { margin: 0; padding-left: 1.5rem; }
nav li { margin: 0.4rem 0; color: var(--quiet); }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
main { max-width: 84rem; padding: 2.5rem 3rem 5rem; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 0.75rem; }
h2 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 0.5rem; }
h3 { font-size: 1.05rem; margin: 2rem 0 0.5rem; }
section { padding-top: 2.5rem; margin-top: 2.5rem; border-top: 1px solid var(--line); }
.question { color: var(--quiet); font-size: 1.05rem; margin: 0 0 1rem; max-width: 48rem; }
.findings {
  margin: 0; max-width: 62rem; padding: 1rem 1.25rem 1rem 2.4rem; background: var(--wash);
  border-left: 4px solid var(--accent); border-radius: 0 6px 6px 0;
}
.findings li { margin: 0.45rem 0; }
.glance td:first-child { white-space: nowrap; font-weight: 600; }
.glance td { padding: 0.5rem 0.7rem; }
figure { margin: 1.75rem 0; }
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { color: var(--quiet); font-size: 0.9rem; margin: 0.5rem auto 0; max-width: 48rem; text-align: center; }
.wide { overflow-x: auto; margin: 0.5rem 0 1.25rem; }
table { border-collapse: collapse; font-size: 0.84rem; line-height: 1.35; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 0.3rem 0.7rem; border-bottom: 1px solid var(--line); }
th { background: var(--wash); font-weight: 600; vertical-align: bottom; }
tbody tr:hover { background: #fafbfc; }
details { margin: 0.5rem 0 1.25rem; }
summary { cursor: pointer; color: var(--accent); }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Consolas, monospace; font-size: 0.88em; }
pre {
  background: var(--wash); border: 1px solid var(--line); border-radius: 6px; padding: 0.7rem 1rem;
  overflow-x: auto;
}
.method p { margin: 0.5rem 0; max-width: 48rem; }
.machine { color: var(--quiet); font-size: 0.85rem; }
@media (max-width: 70rem) {
  .sheet { display: block; }
  nav { position: static; height: auto; border-right: 0; border-bottom: 1px solid var(--line); }
  main { padding: 1.5rem 1.25rem 3rem; }
}
@media print {
  body { font-size: 10.5pt; }
  .sheet { display: block; }
  nav { position: static; height: auto; border: 0; background: none; padding: 0; }
  main { max-width: none; padding: 0; }
  section { break-before: page; border: 0; margin: 0; padding: 0; }
  figure, tr, .findings li { break-inside: avoid; }
  figure img { max-height: 22cm; }
  h2, h3, summary { break-after: avoid; }
  .wide { overflow: visible; }
  table { font-size: 7.5pt; }
  a { color: inherit; }
}
)css";

namespace fs = std::filesystem;

// Longer tables are folded up.
constexpr std::size_t kLongTable = 30;
constexpr std::uintmax_t kLargePicture = 250'000;
constexpr double kScaleOfLargePictures = 1.2;  // pixels for 1/96 inch
constexpr std::size_t kMaxPictureBytes = std::size_t{64} << 20;

std::string_view htmlEntity(char letter) {
  switch (letter) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

std::string escaped(std::string_view text) {
  std::string html;
  for (const char letter : text) {
    const std::string_view entity = htmlEntity(letter);
    if (entity.empty()) {
      html += letter;
    } else {
      html += entity;
    }
  }
  return html;
}

// Text between two marks becomes an element; a mark without a second one stays.
std::string withElement(std::string html, std::string_view mark, std::string_view tag) {
  for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at)) {
    const std::size_t end = html.find(mark, at + mark.size());
    if (end == std::string::npos) break;
    const std::string inside = html.substr(at + mark.size(), end - at - mark.size());
    const std::string marked = fmt::format("<{0}>{1}</{0}>", tag, inside);
    html.replace(at, end + mark.size() - at, marked);
    at += marked.size();
  }
  return html;
}

std::string element(std::string_view tag, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>", tag, htmlText(text));
}

std::string dataUri(std::string_view kind, std::string_view bytes) {
  return fmt::format("data:image/{};base64,{}", kind, base64(bytes));
}

// Takes the smaller of the two files of a figure: curves are small as SVG, surfaces as PNG. Where both are large, a PNG
// with fewer pixels, sharp enough for the column of text.
std::string pictureUri(const StudyFigure& figure, const fs::path& folder) {
  const fs::path svg = folder / (figure.stem + ".svg");
  const fs::path png = folder / (figure.stem + ".png");
  for (const fs::path& file : {svg, png}) {
    if (!fs::is_regular_file(file)) throw Error::inFile(file.string(), "the report needs this picture");
  }
  const auto svg_bytes = fs::file_size(svg);
  const auto png_bytes = fs::file_size(png);
  if (std::min(svg_bytes, png_bytes) > kLargePicture) {
    return dataUri("png", figures::renderPng(figure.figure, kScaleOfLargePictures));
  }
  return svg_bytes <= png_bytes ? dataUri("svg+xml", readFile(svg, kMaxPictureBytes))
                                : dataUri("png", readFile(png, kMaxPictureBytes));
}

std::string figureHtml(const StudyFigure& figure, const fs::path& folder) {
  return fmt::format("<figure id=\"{}\"><img alt=\"{}\" src=\"{}\" /><figcaption>{}</figcaption></figure>\n",
                     escaped(figure.stem), escaped(figure.caption), pictureUri(figure, folder),
                     htmlText(figure.caption));
}

std::string rowHtml(std::string_view tag, const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += element(tag, cell);
  return row + "</tr>\n";
}

std::string tableHtml(const TextTable& table) {
  std::string html = "<div class=\"wide\"><table><thead>" + rowHtml("th", table.headings) + "</thead><tbody>\n";
  for (const auto& row : table.rows) html += rowHtml("td", row);
  return html + "</tbody></table></div>\n";
}

std::string tableHtml(const StudyTable& table) {
  if (!table.shown) return fmt::format("<p>{} <code>{}.csv</code></p>\n", htmlText(table.title), escaped(table.stem));
  const bool is_long = table.table.rows.size() > kLongTable;
  if (!is_long) return element("p", table.title) + tableHtml(table.table);
  return fmt::format("<details><summary>{} ({} rows)</summary>{}</details>\n", htmlText(table.title),
                     table.table.rows.size(), tableHtml(table.table));
}

std::string listHtml(std::string_view kind, const std::vector<std::string>& items) {
  std::string html = fmt::format("<ul class=\"{}\">\n", kind);
  for (const std::string& item : items) html += element("li", item) + "\n";
  return html + "</ul>\n";
}

std::string methodHtml(const StudyPage& page) {
  std::string html = "<h3>How it was measured</h3>\n<div class=\"method\">";
  for (const std::string& paragraph : page.method) html += element("p", paragraph);
  return html + fmt::format("</div>\n<pre>{}</pre>\n<p class=\"machine\">{} The run took {} s.</p>\n",
                            escaped(page.command), page.machine.empty() ? "" : escaped(page.machine) + ".",
                            rounded(page.seconds));
}

std::string chapterHtml(const StudyPage& page, std::size_t number, const fs::path& folder) {
  std::string html = fmt::format("<section id=\"{}\">\n<h2>{}. {}</h2>\n<p class=\"question\">{}</p>\n",
                                 escaped(page.name), number, htmlText(page.title), htmlText(page.question));
  html += listHtml("findings", page.findings);
  for (const StudyFigure& figure : page.figures) html += figureHtml(figure, folder);
  if (!page.tables.empty()) html += "<h3>Tables</h3>\n";
  for (const StudyTable& table : page.tables) html += tableHtml(table);
  return html + methodHtml(page) + "</section>\n";
}

std::string linkTo(const StudyPage& page) {
  return fmt::format("<a href=\"#{}\">{}</a>", escaped(page.name), htmlText(page.title));
}

std::string contentsHtml(const std::vector<StudyPage>& chapters) {
  std::string html = "<nav><p><a href=\"#top\">Contents</a></p>\n<ol>\n";
  for (const StudyPage& page : chapters) html += fmt::format("<li>{}</li>\n", linkTo(page));
  return html + "</ol></nav>\n";
}

// Each chapter's first finding.
std::string glanceHtml(const std::vector<StudyPage>& chapters) {
  std::string html = "<h3>At a glance</h3>\n<div class=\"wide\"><table class=\"glance\"><tbody>\n";
  for (const StudyPage& page : chapters) {
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", linkTo(page),
                        page.findings.empty() ? "" : htmlText(page.findings.front()));
  }
  return html + "</tbody></table></div>\n";
}

std::string headHtml(const ReportHead& head) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n",
      escaped(head.title), kReportStyle);
}

std::string openingHtml(const ReportHead& head) {
  return fmt::format(
      "<h1>{}</h1>\n<p class=\"question\">{}</p>\n<pre>{}</pre>\n<p class=\"machine\">{}. The run took {:.0f} s.</p>\n",
      htmlText(head.title), htmlText(head.about), escaped(head.command), escaped(head.machine), head.seconds);
}

}  // namespace

std::string htmlText(std::string_view text) {
  return withElement(withElement(escaped(text), "`", "code"), "**", "strong");
}

std::string reportHtml(const ReportHead& head, const std::vector<StudyPage>& chapters, const fs::path& folder) {
  std::string html =
      headHtml(head) + "<body id=\"top\">\n<div class=\"sheet\">\n" + contentsHtml(chapters) + "<main>\n";
  html += openingHtml(head) + glanceHtml(chapters);
  for (std::size_t i = 0; i < chapters.size(); ++i) html += chapterHtml(chapters[i], i + 1, folder);
  return html + "</main>\n</div>\n</body>\n</html>\n";
}

}  // namespace palpate::study
