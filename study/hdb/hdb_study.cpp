// The study of the detecting box: what each size costs, which sizes a fast finger gets through, and the rule that
// follows.
#include "study/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/hdb/hdb_measurement.h"
#include "study/numbers/number_row.h"
#include "study/numbers/printed_numbers.h"
#include "study/page/plot_parts.h"

namespace palpate::study {

namespace {

// ----------------------------------------------------------------------------------------------------------- tables

TextTable sizeTable(const HdbMeasurement& found) {
  TextTable table{
      {"edge / model", "edge (mm)", "BSP leaves", "octree leaves", "box", "BSP (us)", "octree (us)", "our list (us)"},
      {}};
  for (const HdbSizeRow& row : found.sizes) {
    table.rows.push_back({fractionTicksAt({row.share}).front().text, rounded(row.edge_mm, 3),
                          counted(row.bsp_triangles), counted(row.octree_triangles), counted(row.exact_triangles),
                          rounded(row.bsp_us), rounded(row.octree_us), rounded(row.exact_us)});
  }
  return table;
}

TextTable punctureTable(const std::vector<PunctureRow>& rows) {
  TextTable table{
      {"speed (m/s)", "delay (ms)", "edge (mm)", "half edge / way", "found by", "triangles", "punctured (%)"}, {}};
  for (const PunctureRow& row : rows) {
    table.rows.push_back({rounded(metresPerSecond(row.speed_mm_s)), counted(row.delay_ticks), rounded(row.edge_mm, 3),
                          rounded(row.lead()), row.leaves ? "leaves" : "box", counted(row.triangles),
                          rounded(100.0 * row.punctured, 3)});
  }
  return table;
}

void addRuleRows(const HdbMeasurement& found, std::size_t model, const std::string& rule,
                 const std::vector<PunctureRow>& rows, TextTable& table) {
  for (const PunctureRow& row : rows) {
    const bool same_model = model == found.plan.triangles;
    table.rows.push_back({counted(static_cast<double>(model)), rule, rounded(metresPerSecond(row.speed_mm_s)),
                          counted(row.delay_ticks), rounded(row.edge_mm, 3), counted(row.triangles),
                          same_model ? percent(row.triangles / quarterRow(found).bsp_triangles) : "",
                          rounded(100.0 * row.punctured, 3)});
  }
}

TextTable ruleTable(const HdbMeasurement& found) {
  TextTable table{{"model", "margin", "speed (m/s)", "delay (ms)", "edge (mm)", "triangles", "of 1/4 with BSP leaves",
                   "punctured (%)"},
                  {}};
  addRuleRows(found, found.plan.triangles, "depth", found.recommended, table);
  addRuleRows(found, found.plan.fine_triangles, "depth", found.fine_recommended, table);
  addRuleRows(found, found.plan.fine_triangles, "longest triangle edge (E12)", found.fine_e12, table);
  return table;
}

std::vector<StudyTable> tablesOf(const HdbMeasurement& found) {
  std::vector<PunctureRow> all = found.punctures;
  all.insert(all.end(), found.leaf_punctures.begin(), found.leaf_punctures.end());
  all.insert(all.end(), found.leads.begin(), found.leads.end());
  return {{"hdb_rule_table", "The rule, on strokes that no other part of this study used.", ruleTable(found)},
          {"hdb_size_table", "Size of the box: triangles rendered, and time of a frame, touched, without drawing.",
           sizeTable(found)},
          {"hdb_punctures_table", "Every run of strokes.", punctureTable(all), false}};
}

// --------------------------------------------------------------------------------------------------------- findings

/// The printed times of a touched frame with a BSP tree, s.
struct PrintedDelays {
  double shortest = 0.0;
  double longest = 0.0;
};

PrintedDelays printedDelays() {
  const auto rows = printedNumbers().table_3_2.touched;
  return {1e-3 * parsePrinted(rows.front().ms).value, 1e-3 * parsePrinted(rows.back().ms).value};
}

double mostPunctured(const std::vector<PunctureRow>& rows, double from_lead, double to_lead) {
  double most = 0.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() >= from_lead && row.lead() <= to_lead) most = std::max(most, row.punctured);
  }
  return most;
}

double leastPunctured(const std::vector<PunctureRow>& rows, double to_lead) {
  double least = 1.0;
  for (const PunctureRow& row : rows) {
    if (row.lead() <= to_lead) least = std::min(least, row.punctured);
  }
  return least;
}

const PunctureRow& rowAt(const std::vector<PunctureRow>& rows, double speed, int delay) {
  return *std::min_element(rows.begin(), rows.end(), [&](const PunctureRow& a, const PunctureRow& b) {
    const auto distance = [&](const PunctureRow& row) {
      return std::abs(row.speed_mm_s - speed) + 1e3 * std::abs(row.delay_ticks - delay);
    };
    return distance(a) < distance(b);
  });
}

std::string strokesOf(double share) {
  if (share == 0.0) return "none of the strokes";
  return share == 1.0 ? "all strokes" : percent(share) + " of the strokes";
}

std::string atLeast(double share) { return share == 1.0 ? strokesOf(share) : "at least " + strokesOf(share); }

std::string ruleFinding(const HdbMeasurement& found) {
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  const double worst = std::max(mostPunctured(found.recommended, 0.0, 1e9),  //
                                mostPunctured(found.fine_recommended, 0.0, 1e9));
  return fmt::format(
      "What replaces the guess: **edge = 2 (speed x delay + depth)**, with the speed of the finger now, the longest "
      "time until the box follows, and the depth that the tip may have. On {} strokes of each speed and delay that "
      "were not used before, on models of {} and {} triangles, {} got through. For {} m/s and {} ms the box is {} mm "
      "wide and holds {} triangles: {} of what the leaves of a BSP tree render for 1/4, {} of the model.",
      found.plan.strokes, counted(static_cast<double>(found.plan.triangles)),
      counted(static_cast<double>(found.plan.fine_triangles)), strokesOf(worst),
      rounded(metresPerSecond(usual.speed_mm_s)), usual.delay_ticks, rounded(usual.edge_mm), counted(usual.triangles),
      percent(usual.triangles / quarterRow(found).bsp_triangles),
      percent(usual.triangles / static_cast<double>(found.plan.triangles)));
}

/// The smallest share of the depth that held all strokes of every depth.
double safeMargin(const HdbMeasurement& found) {
  double unsafe = -1.0;
  for (const MarginRow& row : found.margins) {
    if (row.punctured > 0.0) unsafe = std::max(unsafe, row.share);
  }
  double safe = std::numeric_limits<double>::infinity();
  for (const MarginRow& row : found.margins) {
    if (row.share > unsafe) safe = std::min(safe, row.share);
  }
  return safe;
}

std::string marginFinding(const HdbMeasurement& found) {
  return fmt::format(
      "Why the depth: the proxy is never farther from the tip than that. Between two boxes the tip makes speed x "
      "delay, so the proxy makes at most that plus the depth before and the depth after (twice the depth is a proof); "
      "{} times the depth was enough for every depth from {:g} to {:g} mm. The largest triangle, which E12 adds "
      "instead, is no safe margin: on {} triangles (longest edge {} mm) up to {} get through with it. A triangle needs "
      "no room of its own, because the box finds whatever reaches into it.",
      rounded(safeMargin(found)), found.plan.depths_mm.front(), found.plan.depths_mm.back(),
      counted(static_cast<double>(found.plan.fine_triangles)), rounded(found.fine_triangle_edge),
      strokesOf(mostPunctured(found.fine_e12, 0.0, 1e9)));
}

std::string leadFinding(const HdbMeasurement& found) {
  return fmt::format(
      "One number decides: half the edge over the way that the finger makes until the box follows. Up to 0.5, {} get "
      "through; from 1.25 on {} at most, whatever the speed and the delay. That it is not exactly 1 comes from the "
      "proxy: where the body curves outwards it is faster than the tip below it, and behind a ridge it snaps forward. "
      "Both are ways of about the depth, hence that term.",
      atLeast(leastPunctured(found.leads, 0.5)), strokesOf(mostPunctured(found.leads, 1.25, 1e9)));
}

std::string quarterFinding(const HdbMeasurement& found) {
  const PrintedDelays printed = printedDelays();
  const auto safe = [&](double share, double delay) {
    return rounded(metresPerSecond(safeSpeed(share * found.longest_edge, delay, found.depth_mm)));
  };
  return fmt::format(
      "Is 1/4 right? For the computer of 2008 it was: its touched frames took {} to {} ms (Table 3.2), and by the rule "
      "a quarter of this model, {} mm, is then safe up to {} and {} m/s, while 1/10 is safe up to {} and {} m/s only - "
      "\"the proxy might get through the model surface frequently\". It is no property of the model: with a collision "
      "thread of 100 Hz, 1/4 is safe up to {} m/s, more than any finger needs, and on a model twice as long 1/4 would "
      "be twice as wide for nothing.",
      rounded(1e3 * printed.shortest, 3), rounded(1e3 * printed.longest, 3),
      rounded(kPrintedBoxShare * found.longest_edge, 3), safe(kPrintedBoxShare, printed.shortest),
      safe(kPrintedBoxShare, printed.longest), safe(kTenth, printed.shortest), safe(kTenth, printed.longest),
      safe(kPrintedBoxShare, 0.01));
}

std::string costFinding(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const auto all = static_cast<double>(found.plan.triangles);
  return fmt::format(
      "What 1/4 costs on {} triangles: the box meets {} of them on average ({}), the leaves that it meets hold {} "
      "(BSP, {}) and {} (octree, {}); the text says a third in one place and a tenth in another. A frame that tests "
      "them all takes {} us (BSP) and {} us (octree) here, our exact list {} us, and the default finger, which needs "
      "no box, {} us.",
      counted(all), counted(quarter.exact_triangles), percent(quarter.exact_triangles / all),
      counted(quarter.bsp_triangles), percent(quarter.bsp_triangles / all), counted(quarter.octree_triangles),
      percent(quarter.octree_triangles / all), rounded(quarter.bsp_us), rounded(quarter.octree_us),
      rounded(quarter.exact_us), rounded(found.tick_us));
}

std::string leavesFinding(const HdbMeasurement& found) {
  double hidden = 0.0;  // strokes that only the leaves' overhang saved, in the worst case
  for (std::size_t i = 0; i < found.punctures.size(); ++i) {
    hidden = std::max(hidden, found.punctures[i].punctured - found.leaf_punctures[i].punctured);
  }
  return fmt::format(
      "Leaves hide a small box: they reach beyond it, so that up to {} of the strokes more are held than by the box's "
      "own triangles. This is luck and not a margin, because a leaf may end right behind the box.",
      percent(hidden));
}

std::string elseIfFinding(const HdbMeasurement& found) {
  return fmt::format(
      "The printed traversal, ELSEIF for the second child (E4), lets {} through although the box follows at every "
      "tick, with 1/16, 1/4 and the whole model alike: no size of box mends that.",
      strokesOf(found.else_if_punctured));
}

std::vector<std::string> methodOf(const HdbMeasurement& found) {
  return {
      fmt::format(
          "Model: the benchmark's back with {} triangles, 350 x 400 mm; box shares are of its longest edge, {} mm. "
          "Partitions: case C, threshold 1024.",
          counted(static_cast<double>(found.plan.triangles)), rounded(found.longest_edge, 3)),
      fmt::format("Strokes: {} for each speed, the same ways at every speed. A finger comes down through 20 mm of "
                  "air at up to 45 degree, presses {} mm deep and slides 160 mm in any direction, at one speed "
                  "throughout, at 1 kHz. It sees only the triangles that the box found "
                  "(`src/palpate/hdb/hdb_finger.h`); the box is put round the proxy every 10, 20 or 50 ticks. A "
                  "stroke gets through when its tip is under the skin and nothing holds it.",
                  found.plan.strokes, rounded(found.depth_mm)),
      fmt::format("Times: at {} places, tip 5 mm deep, the fastest of {} runs at each. The dissertation's way tests "
                  "every triangle of the leaves against the tip's way and for its nearest point "
                  "(`study/measured/literal_process.h`).",
                  found.plan.places, found.plan.runs)};
}

std::vector<std::pair<std::string, double>> numbersOf(const HdbMeasurement& found) {
  const HdbSizeRow& quarter = quarterRow(found);
  const PunctureRow& usual = rowAt(found.recommended, 500.0, 10);
  return {{"quarter_edge_mm", quarter.edge_mm},
          {"quarter_bsp_triangles", quarter.bsp_triangles},
          {"quarter_octree_triangles", quarter.octree_triangles},
          {"quarter_exact_triangles", quarter.exact_triangles},
          {"quarter_bsp_us", quarter.bsp_us},
          {"quarter_octree_us", quarter.octree_us},
          {"quarter_exact_us", quarter.exact_us},
          {"tick_us", found.tick_us},
          {"least_punctured_up_to_lead_0_5", leastPunctured(found.leads, 0.5)},
          {"most_punctured_from_lead_1_25", mostPunctured(found.leads, 1.25, 1e9)},
          {"rule_most_punctured", mostPunctured(found.recommended, 0.0, 1e9)},
          {"rule_most_punctured_fine", mostPunctured(found.fine_recommended, 0.0, 1e9)},
          {"e12_most_punctured_fine", mostPunctured(found.fine_e12, 0.0, 1e9)},
          {"safe_margin_over_depth", safeMargin(found)},
          {"rule_edge_mm_at_0_5_mps_10_ms", usual.edge_mm},
          {"rule_triangles_at_0_5_mps_10_ms", usual.triangles},
          {"rule_share_of_quarter_at_0_5_mps_10_ms", usual.triangles / quarter.bsp_triangles},
          {"else_if_punctured", found.else_if_punctured}};
}

}  // namespace

StudyPage studyHdb(const StudySettings& settings) {
  const HdbMeasurement found = measureHdbSizes(hdbPlan(settings.quick), settings.progress);
  return {.title = "The size of the haptic detecting box",
          .question =
              "The haptic process sees only triangles near the proxy: those that a box around it meets. Too small a "
              "box lets a fast finger through the skin, because the box follows late; too large a box costs time. The "
              "dissertation settles on a quarter of the model \"after several experiments\" (3.3.3). Is that right, "
              "and what should replace the guess (E12)?",
          .findings = {ruleFinding(found), marginFinding(found), leadFinding(found), quarterFinding(found),
                       costFinding(found), leavesFinding(found), elseIfFinding(found)},
          .method = methodOf(found),
          .tables = tablesOf(found),
          .figures = hdbFigures(found),
          .numbers = numbersOf(found)};
}

}  // namespace palpate::study
