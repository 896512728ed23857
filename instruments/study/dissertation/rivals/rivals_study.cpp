// The study of Table 4.1's rivals: tables, findings and figures out of one measurement.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include "dissertation/rivals/rivals_findings.h"

namespace palpate::study {

namespace {

// ----------------------------------------------------------------------------------------------------------- tables

TextTable commonTable(const RivalsMeasurement& found) {
  TextTable table{{"method", "tissue", "depth (mm)", "error", "into the body only", "force (N)", "truth (N)", "before",
                   "a press", "memory"},
                  {}};
  for (const Rival rival : kRivals) {
    forEachCommon(found, rival, [&](const RivalRow& row) {
      table.rows.push_back({nameOf(rival), row.truth.tissue, fmt::format("{:g}", row.truth.depth_mm),
                            percent(row.error), percent(row.normal_error), row.force_n ? rounded(*row.force_n) : "-",
                            rounded(row.truth.force_n), readableTime(1e3 * row.once_ms), readableTime(row.press_us),
                            readableBytes(row.bytes)});
    });
  }
  return table;
}

TextTable sizeTable(const RivalsMeasurement& found) {
  TextTable table{{"method", "vertices of the skin", "error", "before", "a press", "memory"}, {}};
  for (const Rival rival : kRivals) {
    for (const int cells : found.plan.cells) {
      const RivalRow& row = findRivalRow(found, rival, kFittedTissue, 10.0, cells);
      table.rows.push_back({nameOf(rival), fmt::format("{}", row.vertices), percent(row.error),
                            readableTime(1e3 * row.once_ms), readableTime(row.press_us), readableBytes(row.bytes)});
    }
  }
  return table;
}

TextTable latticeTable(const RivalsMeasurement& found) {
  TextTable table{{"lattice (mm)", "tissue", "depth (mm)", "error"}, {}};
  for (const RivalRow& row : found.rows) {
    if (row.rival != Rival::free_form || row.cells != found.plan.common_cells) continue;
    table.rows.push_back({fmt::format("{:g}", row.lattice_mm), row.truth.tissue,
                          fmt::format("{:g}", row.truth.depth_mm), percent(row.error)});
  }
  return table;
}

std::vector<std::string> describeMethod(const RivalsPlan& plan) {
  return {
      fmt::format(
          "The truth: finite elements of finite strain under a frictionless ball of 8 mm, made outside this project "
          "(`instruments/study/dissertation/rivals/layered_truth.json` says how and how it was checked). The body of "
          "the rivals: a block of {:g} mm with the same layers on a fixed base, cells of {:.1f} mm unless said "
          "otherwise; the error is the root mean square over the vertices within 40 mm, as a share of the depth of the "
          "ball.",
          plan.side_mm, plan.side_mm / plan.common_cells),
      "Free form drags the middle of the skin, as FSMD does; springs and elements are kept out of the ball. Springs "
      "are relaxed from rest until no node feels more than a thousandth of the ball's force, explicitly; between two "
      "pictures a finger moves less, so that fewer steps may do. Elements solve for one answer a touched node "
      "(Eigen's SimplicialLDLT). Where answers are kept, \"before\" is reckoned from the time of one.",
      "Times are those of one processor. Of FSMD they hold normals and the check against folds, of the "
      "others only the skin's places. Memory is that of the arrays, counted."};
}

std::vector<std::pair<std::string, double>> numbersOf(const RivalsMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const Rival rival : kRivals) {
    numbers.emplace_back(fmt::format("{}_mean_error_percent", keyOf(rival)), 100.0 * meanError(found, rival));
    numbers.emplace_back(fmt::format("{}_worst_error_percent", keyOf(rival)), 100.0 * errorExtent(found, rival).most);
    numbers.emplace_back(fmt::format("{}_press_us", keyOf(rival)), slowestUs(found, rival));
    numbers.emplace_back(fmt::format("{}_bytes", keyOf(rival)),
                         findRivalRow(found, rival, kFittedTissue, 10.0, found.plan.common_cells).bytes);
  }
  return numbers;
}

}  // namespace

StudyPage studyRivals(const StudySettings& settings) {
  const RivalsMeasurement found = measureRivals(rivalsPlan(settings.quick), settings.progress);
  return {
      .title = "The rivals of Table 4.1",
      .question =
          "Table 4.1 sets functional shape matching against other ways to deform: finite elements are \"most "
          "accurate\" and \"very expensive\", masses and springs are \"fast\", free-form deformation is \"fast\" and "
          "\"not accurate\". Nothing was measured. On the same press of the same layered body: how near to the "
          "truth is each, how long does it take, and what memory?",
      .findings = rivalFindings(found),
      .method = describeMethod(found.plan),
      .tables = {{"rivals_table", "Every tissue and depth.", commonTable(found)},
                 {"rivals_sizes", "Other sizes, \"back_mid\" pressed 10 mm.", sizeTable(found)},
                 {"rivals_lattices", "Free form with every lattice.", latticeTable(found), false}},
      .figures = rivalFigures(found),
      .numbers = numbersOf(found)};
}

}  // namespace palpate::study
