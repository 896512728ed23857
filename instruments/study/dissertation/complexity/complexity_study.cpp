// The study of the search's cost: Tables 3.3 and 3.4 counted on complete trees, then each claim of 3.3.4 and 3.4.2
// against the counts of real models.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include "dissertation/complexity/complexity_results.h"
#include "palpate/scene/words.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

StudyTable wTable(const ComplexityResults& results) {
  StudyTable table{"complexity_table_w", "Worst w: printed, closed form, counted on a complete tree.", {}};
  table.table.headings = {"tree", "height", "printed", "closed form", "counted", "verdict"};
  for (const WorstColumn& column : results.columns) {
    table.table.rows.push_back({titleOf(column.tree), fmt::format("{}", column.height),
                                fmt::format("{:.2f}", column.printed), fmt::format("{:.4f}", column.closed),
                                fmt::format("{:.4f}", column.counted), verdictText(columnVerdict(column))});
  }
  return table;
}

StudyTable casesTable(const ComplexityResults& results) {
  StudyTable table{"complexity_searches", "All counted searches.", {}, false};
  table.table.headings = {"model",       "tree",        "threshold",  "hdb_part",       "height",   "leaves",
                          "nodes",       "found_mean",  "found_max",  "ways_mean",      "ways_max", "entered_mean",
                          "entered_max", "tested_mean", "tested_max", "ways_over_bound"};
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  for (const SearchCase& one : results.cases) {
    const SearchSweep& sweep = one.sweep;
    table.table.rows.push_back({one.model, titleOf(one.tree), fmt::format("{}", one.threshold),
                                fmt::format("1/{}", one.part), fmt::format("{}", sweep.height), number(sweep.leaves),
                                number(sweep.nodes), number(sweep.mean.leaves_found), number(sweep.worst.leaves_found),
                                number(sweep.mean.on_paths), number(sweep.worst.on_paths), number(sweep.mean.entered),
                                number(sweep.worst.entered), number(sweep.mean.tested), number(sweep.worst.tested),
                                number(sweep.worst_over_bound)});
  }
  return table;
}

StudyTable quarterTable(const ComplexityResults& results) {
  StudyTable table{"complexity_quarter",
                   "Searches with the dissertation's box (1/4) and threshold (1024); cost over the number of leaves n. "
                   "Printed: c at most 0.8 n and 0.4 n.",
                   {}};
  table.table.headings = {"model",
                          "tree",
                          "height",
                          "leaves n",
                          "found, mean",
                          "found, most",
                          "nodes on ways, most",
                          "boxes tested, mean",
                          "boxes tested, most"};
  for (const SearchCase* one : casesWhere(
           results, [](const SearchCase& a) { return a.threshold == kPrintedThreshold && a.part == kPrintedPart; })) {
    const SearchSweep& sweep = one->sweep;
    const auto share = [&](double count) { return fmt::format("{:.2f} n", count / sweep.leaves); };
    table.table.rows.push_back({one->model, titleOf(one->tree), fmt::format("{}", sweep.height),
                                fmt::format("{:.0f}", sweep.leaves), share(sweep.mean.leaves_found),
                                share(sweep.worst.leaves_found), share(sweep.worst.on_paths), share(sweep.mean.tested),
                                share(sweep.worst.tested)});
  }
  return table;
}

std::vector<std::pair<std::string, double>> numbersOf(const ComplexityResults& results) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const TreeKind tree : kTrees) {
    const SearchSweep& sweep = printedCase(results, results.largest_model, tree).sweep;
    const std::string name(wordFor(tree));
    numbers.emplace_back(name + "_leaf_ratio_mean", sweep.mean.leaves_found / sweep.leaves);
    numbers.emplace_back(name + "_leaf_ratio_max", sweep.worst.leaves_found / sweep.leaves);
    numbers.emplace_back(name + "_ways_over_n_max", sweep.worst.on_paths / sweep.leaves);
    numbers.emplace_back(name + "_tested_over_n_max", sweep.worst.tested / sweep.leaves);
    numbers.emplace_back(name + "_list_wins_from_leaf_ratio", shareWhereListWins(results, tree));
  }
  numbers.emplace_back("ways_over_bound_max", worstBoundRatio(results));
  return numbers;
}

}  // namespace

StudyPage studyComplexity(const StudySettings& settings) {
  const ComplexityResults results = measureComplexity(settings);
  return {.title = "What a search for the leaves costs",
          .question =
              "Sections 3.3.4 and 3.4.2 estimate the cost of finding the leaves around the proxy as 0.8 n boxes for "
              "the BSP tree and 0.4 n for the octree, n being the leaves, from a worst case w (Tables 3.3 and 3.4) and "
              "a share r = 0.1 of leaves found. What do searches really visit, and where do the claims stand?",
          .findings = complexityFindings(results),
          .method = {"Complete trees are made from small triangles in the cells of a regular division. Real models are "
                     "the built-in back and hand, which stand in for the unpublished ones, with case C; the proxy "
                     "stands on up to 1500 vertices each. A search enters a node whose tight box meets the detecting "
                     "box. Counted are the nodes on the ways to the leaves found (the text's c) and the boxes tested "
                     "(what a program does). Only trees of 30 leaves or more count where a list is compared."},
          .tables = {wTable(results), quarterTable(results), casesTable(results)},
          .figures = complexityFigures(results),
          .numbers = numbersOf(results)};
}

}  // namespace palpate::study
