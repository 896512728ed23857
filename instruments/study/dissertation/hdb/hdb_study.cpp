// The study of the detecting box: what each size costs, which sizes a fast finger gets through, and the rule that
// follows.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include "dissertation/hdb/hdb_measurement.h"
#include "report/page/plot_parts.h"

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

const char* nameOf(hdb::HdbQuery query) {
  switch (query) {
    case hdb::HdbQuery::leaves:
      return "leaves";
    case hdb::HdbQuery::triangles:
      return "triangles, asked every tick";
    case hdb::HdbQuery::coherent:
      return "coherent list";
    case hdb::HdbQuery::linked:
      break;
  }
  return "octree with a linked list";
}

TextTable listTable(const ListCosts& costs) {
  TextTable table{{"model", "list", "listed", "asked or moved (%)", "boxes tested to follow", "boxes tested to find",
                   "tick (us)", "over the default finger's", "made in (us)", "bytes a triangle", "same forces"},
                  {}};
  for (std::size_t m = 0; m < costs.models.size(); ++m) {
    for (const ListRow& row : costs.rows) {
      const auto model = static_cast<double>(row.model);
      if (row.model != costs.models[m]) continue;
      table.rows.push_back({counted(model), nameOf(row.query), counted(row.listed), rounded(100.0 * row.asked),
                            counted(row.moved), counted(row.tested), rounded(row.tick_us),
                            rounded(row.tick_us / costs.default_us[m]), counted(row.make_us),
                            rounded(row.bytes / model), row.same ? "to the bit" : "NO"});
    }
  }
  return table;
}

std::vector<StudyTable> makeTables(const HdbMeasurement& found) {
  std::vector<PunctureRow> all = found.punctures;
  all.insert(all.end(), found.leaf_punctures.begin(), found.leaf_punctures.end());
  all.insert(all.end(), found.leads.begin(), found.leads.end());
  return {{"hdb_rule_table", "The rule, on strokes that no other part of this study used.", ruleTable(found)},
          {"hdb_size_table", "Size of the box: triangles rendered, and time of a frame, touched, without drawing.",
           sizeTable(found)},
          {"hdb_lists_table",
           "The list of 6.2 (4): ways to keep what may be touched, on the same strokes at 200 mm/s in one run, box of "
           "1/4; counts are means over the ticks.",
           listTable(found.lists)},
          {"hdb_punctures_table", "Every run of strokes.", punctureTable(all), false}};
}

std::vector<std::string> describeMethod(const HdbMeasurement& found) {
  return {
      fmt::format(
          "Model: the benchmark's back with {} triangles, 350 x 400 mm; box shares are of its longest edge, {} mm. "
          "Partitions: case C, threshold 1024.",
          counted(static_cast<double>(found.plan.triangles)), rounded(found.longest_edge, 3)),
      fmt::format(
          "Strokes: {} for each speed, the same ways at every speed. A finger comes down through 20 mm of "
          "air at up to 45 degree, presses {} mm deep and slides 160 mm in any direction, at one speed "
          "throughout, at 1 kHz. It sees only the triangles that the box found "
          "(`engine/core/palpate/hdb/hdb_finger.h`); the box is put round the proxy every 10, 20 or 50 ticks. A "
          "stroke gets through when its tip is under the skin and nothing holds it.",
          found.plan.strokes, rounded(found.depth_mm)),
      fmt::format("Times: at {} places, tip 5 mm deep, the fastest of {} runs at each. The dissertation's way tests "
                  "every triangle of the leaves against the tip's way and for its nearest point "
                  "(`instruments/study/lab/measured/literal_process.h`).",
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
          {"most_punctured_from_lead_1_25", mostPunctured(found.leads, 1.25)},
          {"rule_most_punctured", mostPunctured(found.recommended)},
          {"rule_most_punctured_fine", mostPunctured(found.fine_recommended)},
          {"e12_most_punctured_fine", mostPunctured(found.fine_e12)},
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
          .findings = hdbFindings(found),
          .method = describeMethod(found),
          .tables = makeTables(found),
          .figures = hdbFigures(found),
          .numbers = numbersOf(found)};
}

}  // namespace palpate::study
