// The look of the report: its style sheet.
#pragma once

#include <string_view>

namespace palpate::study {

/// Screen: contents beside the text where there is room, figures as wide as the column. Paper: no contents, a chapter a
/// page, nothing torn apart. System fonts only.
inline constexpr std::string_view kReportStyle = R"css(
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

}  // namespace palpate::study
