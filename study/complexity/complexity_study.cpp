// The study of the search's cost: Tables 3.3 and 3.4 counted on complete trees, then each claim of 3.3.4 and 3.4.2
// against the counts of real models.
#include "study/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/hdb/complexity.h"
#include "palpate/scene/words.h"
#include "study/complexity/complexity_results.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

StudyTable wTable(const ComplexityResults& results) {
  StudyTable table{"complexity_table_w", "Worst w: printed, closed form, counted on a complete tree.", {}};
  table.table.headings = {"tree", "height", "printed", "closed form", "counted", "verdict"};
  for (const WorstColumn& column : results.columns) {
    const bool same = fmt::format("{:.2f}", column.counted) == fmt::format("{:.2f}", column.printed);
    table.table.rows.push_back({titleOf(column.tree), fmt::format("{}", column.height),
                                fmt::format("{:.2f}", column.printed), fmt::format("{:.4f}", column.closed),
                                fmt::format("{:.4f}", column.counted), same ? "reproduced" : "misprint (E13)"});
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

// The share of found leaves from which a tree tests more boxes on average than a list of its leaves has.
double shareWhereListWins(const ComplexityResults& results, TreeKind tree) {
  constexpr std::size_t kBins = 20;
  std::array<double, kBins> tested{};
  std::array<double, kBins> searches{};
  for (const SearchCase& one : results.cases) {
    if (one.tree != tree || one.sweep.leaves < kFewestLeaves) continue;
    for (const SearchCount& query : one.sweep.queries) {
      const double share = query.leaves_found / one.sweep.leaves;
      const auto bin = std::min(kBins - 1, static_cast<std::size_t>(share * kBins));
      tested[bin] += query.tested / one.sweep.leaves;
      searches[bin] += 1.0;
    }
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (tested[bin] > searches[bin]) return static_cast<double>(bin) / kBins;
  }
  return 1.0;
}

// The smallest tree from which on no search tested more than the printed worst case; 0 where the largest still does.
double leavesFromWhichPrintedHolds(const ComplexityResults& results, TreeKind tree) {
  double from = 0.0;
  for (const SearchCase* one : casesWhere(results, [&](const SearchCase& a) {
         return a.tree == tree && a.part == kPrintedPart && a.model == results.largest_model;
       })) {  // large trees first
    if (one->sweep.worst.tested > printedCost(tree) * one->sweep.leaves) break;
    from = one->sweep.leaves;
  }
  return from;
}

double mostNodesPerLeaf(const ComplexityResults& results, TreeKind tree) {
  double most = 0.0;
  for (const SearchCase& one : results.cases) {
    if (one.tree == tree && one.sweep.leaves >= kFewestLeaves)
      most = std::max(most, one.sweep.nodes / one.sweep.leaves);
  }
  return most;
}

double worstBoundRatio(const ComplexityResults& results) {
  double worst = 0.0;
  for (const SearchCase& one : results.cases) worst = std::max(worst, one.sweep.worst_over_bound);
  return worst;
}

// The height from which the printed estimate r w nodes exceeds n by itself.
int heightAboveLinear(TreeKind tree) {
  const int arity = arityOf(tree);
  for (int height = 1; height < 20; ++height) {
    if (hdb::visitedPerLeaf(arity, hdb::kWorstLeafRatio, hdb::worstSearch(arity, height).w) > 1.0) {
      return height;
    }
  }
  return 0;
}

// The exponent of the growth of the worst search with n, between the largest and the smallest threshold.
double growthExponent(const ComplexityResults& results, TreeKind tree, int part) {
  const auto cases = casesWhere(results, [&](const SearchCase& a) {
    return a.tree == tree && a.part == part && a.model == results.largest_model;
  });
  const SearchSweep& fine = cases.front()->sweep;
  const SearchSweep& coarse = cases.back()->sweep;
  return std::log(fine.worst.tested / coarse.worst.tested) / std::log(fine.leaves / coarse.leaves);
}

std::size_t reproducedColumns(const ComplexityResults& results) {
  return static_cast<std::size_t>(
      std::count_if(results.columns.begin(), results.columns.end(), [](const WorstColumn& column) {
        return fmt::format("{:.2f}", column.counted) == fmt::format("{:.2f}", column.printed);
      }));
}

std::string holdsFrom(const ComplexityResults& results, TreeKind tree) {
  const double leaves = leavesFromWhichPrintedHolds(results, tree);
  return leaves == 0.0 ? fmt::format("not even in the largest {}", titleOf(tree))
                       : fmt::format("from {:.0f} leaves on in the {}", leaves, titleOf(tree));
}

std::string costFinding(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "0.8 n and 0.4 n are no worst cases at the dissertation's own threshold. On the {} triangles (1024, box of 1/4) "
      "the nodes on the ways come to {:.2f} n at most in the BSP tree and {:.2f} n in the octree. A program must also "
      "test "
      "the other children of every node that it enters: up to {:.2f} n and {:.2f} n boxes, {:.2f} n and {:.2f} n on "
      "average. With smaller leaves the estimates do hold for the boxes tested, {} and {}.",
      results.largest_model, bsp.worst.on_paths / bsp.leaves, octree.worst.on_paths / octree.leaves,
      bsp.worst.tested / bsp.leaves, octree.worst.tested / octree.leaves, bsp.mean.tested / bsp.leaves,
      octree.mean.tested / octree.leaves, holdsFrom(results, TreeKind::Bsp), holdsFrom(results, TreeKind::Octree));
}

std::string shareFinding(const ComplexityResults& results) {
  const SearchSweep& large = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  const SearchSweep& small = printedCase(results, results.cases.front().model, TreeKind::Octree).sweep;
  return fmt::format(
      "The estimates assume that at most a tenth of the leaves meet the detecting box. With a box of 1/4 and leaves of "
      "1024 it is "
      "{:.2f} of them on average and {:.2f} at most in the octree of the {} triangles, {:.2f} and {:.2f} for the {}. A "
      "back is a sheet, and leaves are as large as the box itself while there are few of them.",
      large.mean.leaves_found / large.leaves, large.worst.leaves_found / large.leaves, results.largest_model,
      small.mean.leaves_found / small.leaves, small.worst.leaves_found / small.leaves, results.cases.front().model);
}

std::string linearFinding(const ComplexityResults& results) {
  return fmt::format(
      "\"Better than the n of linear searching\": on average until {} of the leaves are found in the BSP tree and {} "
      "in the octree; beyond, a list of the leaves would test fewer boxes. But no box is tested twice, so a search can "
      "never cost more than the tree has nodes (up to {:.2f} n and {:.2f} n here). It stays O(n); the worst case "
      "\"over O(n)\" of which 3.4.2 warns cannot happen.",
      percent(shareWhereListWins(results, TreeKind::Bsp)), percent(shareWhereListWins(results, TreeKind::Octree)),
      mostNodesPerLeaf(results, TreeKind::Bsp), mostNodesPerLeaf(results, TreeKind::Octree));
}

std::string treesFinding(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "\"0.4 n is better than 0.8 n\" compares different n: at the same threshold the octree of the {} triangles has "
      "{:.0f} leaves and the BSP tree {:.0f}, and a search tests {:.0f} boxes in the one and {:.0f} in the other.",
      results.largest_model, octree.leaves, bsp.leaves, octree.mean.tested, bsp.mean.tested);
}

std::vector<std::string> findingsOf(const ComplexityResults& results) {
  return {
      costFinding(results),
      shareFinding(results),
      linearFinding(results),
      treesFinding(results),
      fmt::format("Counted node by node on complete trees, w is what the closed form says, and {} of the {} printed "
                  "values come out; the others are misprints in the last digit (E13).",
                  reproducedColumns(results), results.columns.size()),
      fmt::format(
          "The estimate r w nodes multiplies the worst r with the worst w, which never meet: w is that of a single "
          "leaf. So it passes n by itself from height {} of the BSP tree and {} of the octree on. The true most, "
          "the nodes on the ways to m leaves, was kept by every search counted (the nearest came to {:.2f} of "
          "it).",
          heightAboveLinear(TreeKind::Bsp), heightAboveLinear(TreeKind::Octree), worstBoundRatio(results)),
      fmt::format(
          "Over the thresholds the worst search grows with the leaves like n to the power {:.2f} (BSP) and {:.2f} "
          "(octree) for a box of 1/4, {:.2f} and {:.2f} for 1/16. The cost is that of the leaves found and the "
          "ways to them, m + m log(n / m), not that of the tree.",
          growthExponent(results, TreeKind::Bsp, 4), growthExponent(results, TreeKind::Octree, 4),
          growthExponent(results, TreeKind::Bsp, 16), growthExponent(results, TreeKind::Octree, 16))};
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
          .findings = findingsOf(results),
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
