// The study of lumps: what people found in silicone, and what trainees find whose finger is the engine's.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/plot_parts.h"
#include "teach/study/lump_measurement.h"

namespace palpate::study {

namespace {

std::string printedCell(double percent) { return std::isfinite(percent) ? fmt::format("{:.0f}", percent) : "-"; }

std::string intervalCell(double found, double low, double high) {
  return fmt::format("{:.0f} ({:.0f} to {:.0f})", found, low, high);
}

// ------------------------------------------------------------------------------------------- tables

TextTable figureTable(const LumpMeasurement& found) {
  TextTable table{{"study", "lumps", "printed (%)", "trainees (%, 95 %)", "of many (%)", ""}, {}};
  for (const ExaminedGroup& group : found.groups) {
    for (const DetectionFigure& figure : group.figures) {
      table.rows.push_back({group.words, figure.words, printedCell(figure.printed),
                            intervalCell(figure.found, figure.low, figure.high), fmt::format("{:.0f}", figure.expected),
                            figure.fitted ? "fitted" : "predicted"});
    }
  }
  return table;
}

TextTable pressTable(const LumpMeasurement& found) {
  TextTable table{{"told", "by", "d'", "measured (%)", "trainees (%, 95 %)"}, {}};
  const auto add = [&](const std::string& what, const std::vector<TwoPresses>& rows) {
    for (const TwoPresses& row : rows) {
      table.rows.push_back({what, row.words, fmt::format("{:.2f}", row.d_prime), printedCell(row.printed),
                            intervalCell(row.found, row.low, row.high)});
    }
  };
  add("over a lump or not", found.detection);
  add("5 or 7 mm", found.sizes);
  return table;
}

TextTable cueTable(const LumpMeasurement& found) {
  TextTable table{{"lump", "force, nearer / deeper (%)", "pattern, nearer / deeper (%)"}, {}};
  for (const CueRow& row : found.cues) {
    table.rows.push_back(
        {fmt::format("{:g} mm, {:g} kPa", row.diameter_mm, row.young_kpa),
         fmt::format("{} / {}", rounded(100.0 * row.by_depth[0].force), rounded(100.0 * row.by_depth[1].force)),
         fmt::format("{} / {}", rounded(100.0 * row.by_depth[0].pattern), rounded(100.0 * row.by_depth[1].pattern))});
  }
  return table;
}

TextTable otherwiseTable(const LumpMeasurement& found) {
  TextTable table{{"assumed"}, {}};
  const ExaminedGroup& later = found.groups.front();
  for (const DetectionFigure& figure : later.figures) table.headings.push_back(figure.words + " (%)");
  table.headings.insert(table.headings.end(), {"Weber fraction", "spread"});
  const auto add = [&](const std::string& words, const auto& percents, const lumps::LumpObserver& observer) {
    std::vector<std::string> row = {words};
    for (const double percent : percents) row.push_back(fmt::format("{:.1f}", percent));
    row.push_back(fmt::format("{:.3f}", observer.pattern_weber));
    row.push_back(fmt::format("{:.2f}", observer.spread));
    table.rows.push_back(std::move(row));
  };
  std::vector<double> usual;
  for (const DetectionFigure& figure : later.figures) usual.push_back(figure.expected);
  add("as elsewhere here", usual, later.observer);
  for (const AssumedOtherwise& row : found.otherwise) add(row.words, row.expected, row.observer);
  return table;
}

// ------------------------------------------------------------------------------------------- pictures

/// Draws a 95 % interval as an upright line.
void addInterval(Plot& plot, double x, double low, double high) {
  if (plot.shapes.empty()) plot.shapes.push_back({.name = "95 %", .closed = false, .colour = figures::kBlue});
  plot.shapes.front().paths.push_back({Vec2(x, low), Vec2(x, high)});
}

Plot percentPlot(const std::string& title, const std::string& label) {
  Plot plot{.title = title};
  plot.x = {.label = label};
  plot.y = {.label = "found", .unit = "%", .from = 0.0, .to = 100.0};
  return plot;
}

Series pointsNamed(const std::string& name, Marker marker, const figures::Colour& colour) {
  return {.name = name, .stroke = Stroke::none, .marker = marker, .colour = colour};
}

Plot detectionPlot(const ExaminedGroup& group) {
  Plot plot = percentPlot(group.words, "lumps");
  Series printed = pointsNamed("printed", Marker::square, figures::kInk);
  Series trainees = pointsNamed("trainees", Marker::circle, figures::kBlue);
  double x = 0.0;
  for (const DetectionFigure& figure : group.figures) {
    if (!std::isfinite(figure.printed) || figure.name == "hardest_deep") continue;
    x += 1.0;
    plot.x.ticks.push_back({x, figure.words});
    printed.x.push_back(x);
    printed.y.push_back(figure.printed);
    trainees.x.push_back(x);
    trainees.y.push_back(figure.found);
    addInterval(plot, x, figure.low, figure.high);
  }
  plot.x.from = 0.5;
  plot.x.to = x + 0.5;
  plot.series = {printed, trainees};
  return plot;
}

Plot pressPlot(const LumpMeasurement& found) {
  Plot plot = percentPlot("Which press was over a lump of 5 mm?", "felt by");
  plot.y.label = "right";
  plot.y.from = 40.0;
  Series printed = pointsNamed("measured (Yu et al.)", Marker::square, figures::kInk);
  Series trainees = pointsNamed("trainees", Marker::circle, figures::kBlue);
  double x = 0.0;
  for (const TwoPresses& row : found.detection) {
    x += 1.0;
    plot.x.ticks.push_back({x, row.words});
    trainees.x.push_back(x);
    trainees.y.push_back(row.found);
    addInterval(plot, x, row.low, row.high);
    if (!std::isfinite(row.printed)) continue;
    printed.x.push_back(x);
    printed.y.push_back(row.printed);
  }
  plot.x.from = 0.5;
  plot.x.to = x + 0.5;
  plot.series = {printed, trainees};
  return plot;
}

// ------------------------------------------------------------------------------------------- page

std::vector<std::pair<std::string, double>> lumpNumbers(const LumpMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers;
  const auto add = [&](const std::string& name, double value) {
    if (std::isfinite(value)) numbers.emplace_back(name, value);
  };
  const auto add_interval = [&](const std::string& name, double low, double high) {
    add("intervals." + name + ".low", low);
    add("intervals." + name + ".high", high);
  };
  for (const ExaminedGroup& group : found.groups) {
    for (const DetectionFigure& figure : group.figures) {
      const std::string name = group.name + "." + figure.name;
      add("figures." + name, figure.found);
      add("printed." + name, figure.printed);
      add("expected." + name, figure.expected);
      add_interval(name, figure.low, figure.high);
    }
    add("observers." + group.name + ".force_weber", group.observer.force_weber);
    add("observers." + group.name + ".pattern_weber", group.observer.pattern_weber);
    add("observers." + group.name + ".spread", group.observer.spread);
    add("worst_points." + group.name, group.worstPoints());
    add("force_only." + group.name + ".mean", group.force_only_mean);
    add("force_only." + group.name + ".size_0_3", group.force_only_smallest);
  }
  for (const auto& [task, rows] : {std::pair("detection", &found.detection), std::pair("size", &found.sizes)}) {
    for (const TwoPresses& row : *rows) {
      const std::string name = fmt::format("{}.{}", task, row.name);
      add(name, row.found);
      add("printed." + name, row.printed);
      add("expected." + name, row.expected);
      add_interval(name, row.low, row.high);
    }
  }
  add("people", static_cast<double>(found.plan.people));
  return numbers;
}

std::vector<std::pair<std::string, std::vector<std::string>>> lumpLabels(const LumpMeasurement& found) {
  std::vector<std::pair<std::string, std::vector<std::string>>> words;
  for (const ExaminedGroup& group : found.groups) {
    std::vector<std::string> fitted;
    for (const DetectionFigure& figure : group.figures) {
      if (figure.fitted) fitted.push_back(figure.name);
    }
    words.emplace_back("fitted." + group.name, std::move(fitted));
  }
  const SiliconeSet& set = found.set;
  words.emplace_back(
      "assumed",
      std::vector<std::string>{
          fmt::format("matrix of {:g} kPa", set.matrix_kpa),
          fmt::format("skin of {:g} mm and {:g} kPa", set.skin_mm, set.skin_kpa),
          fmt::format("lumps of {:g}, {:g} and {:g} kPa", set.young_kpa[0], set.young_kpa[1], set.young_kpa[2]),
          fmt::format("centres {:g} and {:g} mm deep", set.centres_mm[0], set.centres_mm[1]),
          "three sizes, three hardnesses, two depths, each with each", fmt::format("a press of {:g} N", set.press_n),
          fmt::format("strokes {:g} mm apart", lumps::kStrokesApartMm),
          "half of the spread between people, half between lumps"});
  return words;
}

std::vector<std::string> lumpMethod(const LumpMeasurement& found) {
  const SiliconeSet& set = found.set;
  return {
      "Printed figures are those of \"Physicians' abilities to detect lumps in silicone breast models\" (JAMA 1985; 80 "
      "physicians), of a later study with the same kind of set, as works quote it that cite \"Lump detection is "
      "enhanced in silicone breast models simulating postmenopausal breast tissue\" (1996), and of Yu et al., "
      "\"Towards high fidelity remote palpation system\" (12 people). They were read in abstracts and quotations.",
      fmt::format("Assumed, because nobody printed it: {} lumps, three sizes (printed) with three hardnesses ({:g}, "
                  "{:g}, {:g} kPa) at two depths (centres at {:g} and {:g} mm), in silicone of {:g} kPa under a skin "
                  "of {:g} mm and {:g} kPa; a press of {:g} N; strokes {:g} mm apart, the nearest evenly drawn.",
                  found.cues.size() * set.centres_mm.size(), set.young_kpa[0], set.young_kpa[1], set.young_kpa[2],
                  set.centres_mm[0], set.centres_mm[1], set.matrix_kpa, set.skin_mm, set.skin_kpa, set.press_n,
                  lumps::kStrokesApartMm),
      "The layers are solved by finite elements, the lumps are felt as in any scene (docs/explanation/lumps.md): every "
      "stroke is one of the engine's finger, tick by tick, and what it tells is the greatest rise of the force and of "
      "a taxel of 8 x 8 over the same press without the lump.",
      fmt::format("Found is what is clear enough: C = sqrt((force / 0.08)^2 + (pattern / Weber fraction)^2), P = 0.98 "
                  "Phi(ln C / spread). Two numbers are fitted to two figures of each study, all others are predicted. "
                  "{} trainees of each study then draw their skill, strokes and luck (half of the squared spread "
                  "between people, half between lumps), seed {}; intervals are over people. Of two presses, d' is C "
                  "of a stroke over the middle, with the later study's Weber fraction; ten answers a person.",
                  counted(static_cast<double>(found.plan.people)), found.plan.seed)};
}

StudyPage studyLumps(const StudySettings& settings) {
  const LumpPlan plan = lumpPlan(settings);
  const LumpMeasurement found = measureLumps(plan, settings.progress);
  StudyPage page = {
      .title = "Lumps that people find",
      .question =
          "Two published groups looked for lumps in silicone, and found more of the large, of the hard, of the near "
          "ones. Does a simulated finger that feels force and the pattern of pressure find as many, and which of them? "
          "Would the force alone do?",
      .findings = lumpFindings(found),
      .method = lumpMethod(found),
      .tables = {{"lumps_figures", "What was printed and what trainees find.", figureTable(found)},
                 {"lumps_presses", "Two presses.", pressTable(found)},
                 {"lumps_cues", "What a finger right over a lump feels more than beside it.", cueTable(found)}},
      .figures = {{"lumps",
                   "Lumps found by people and by simulated trainees (1.0 and 0.3 cm are fitted); which of two presses "
                   "was over a lump, by force alone and by patterns of taxels.",
                   Figure{.panels = {detectionPlot(found.groups[0]), detectionPlot(found.groups[1]), pressPlot(found)},
                          .columns = 2}}},
      .numbers = lumpNumbers(found),
      .numbers_on_top = true,
      .words = lumpLabels(found)};
  if (settings.seed || settings.cases) {
    page.command = fmt::format("palpate study lumps --seed {} --cases {}{} --out DIR", plan.seed, plan.people,
                               settings.quick ? " --quick" : "");
  }
  if (!found.otherwise.empty()) {
    page.tables.push_back({"lumps_otherwise", "The later study, if what is assumed were otherwise: fitted again.",
                           otherwiseTable(found)});
  }
  return page;
}

}  // namespace

Study lumpStudy() {
  return {.name = "lumps",
          .what = "Lumps that people find: published detection against trainees whose finger is the engine's",
          .run = studyLumps,
          .draws = true};
}

}  // namespace palpate::study
