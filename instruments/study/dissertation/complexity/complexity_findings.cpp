// Fills in the sentences of complexity_findings.txt and the verdicts that the numbers decide.
#include "dissertation/complexity/complexity_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "dissertation/cost/complexity.h"
#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

// Largest share of leaves found in (3.5) and (3.9).
constexpr double kPrintedShare = kWorstLeafRatio;
constexpr double kSameW = 1e-9;

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

// The height from which the printed estimate r w nodes exceeds n by itself.
int heightAboveLinear(TreeKind tree) {
  const int arity = treeArity(tree);
  for (int height = 1; height < 20; ++height) {
    if (visitedPerLeaf(arity, kWorstLeafRatio, worstSearch(arity, height).w) > 1.0) {
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

bool keepsToTheNodes(const ComplexityResults& results) {
  return std::all_of(results.cases.begin(), results.cases.end(),
                     [](const SearchCase& one) { return one.sweep.worst.tested <= one.sweep.nodes; });
}

FindingValues holdsFrom(const ComplexityResults& results, TreeKind tree) {
  return {{"leaves", leavesFromWhichPrintedHolds(results, tree)}, {"tree", titleOf(tree)}};
}

/// Compares a cost of a search: nodes on the ways to the leaves, or boxes tested.
bool exceedsPrinted(const SearchSweep& sweep, TreeKind tree, double SearchCount::*cost) {
  return sweep.worst.*cost > printedCost(tree) * sweep.leaves;
}

FindingValues costOfSearches(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  const bool bsp_fails = exceedsPrinted(bsp, TreeKind::Bsp, &SearchCount::tested);
  const bool octree_fails = exceedsPrinted(octree, TreeKind::Octree, &SearchCount::tested);
  return {{"estimates", bsp_fails && octree_fails ? "both_fail"
                        : bsp_fails               ? "bsp_fails"
                        : octree_fails            ? "octree_fails"
                                                  : "hold"},
          {"model", results.largest_model},
          {"bsp_on_paths", bsp.worst.on_paths / bsp.leaves},
          {"octree_on_paths", octree.worst.on_paths / octree.leaves},
          {"worst_tested", {bsp.worst.tested / bsp.leaves, octree.worst.tested / octree.leaves}},
          {"mean_tested", {bsp.mean.tested / bsp.leaves, octree.mean.tested / octree.leaves}},
          {"hold_from", {holdsFrom(results, TreeKind::Bsp), holdsFrom(results, TreeKind::Octree)}}};
}

FindingValues shareOfLeaves(const ComplexityResults& results) {
  const SearchSweep& large = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  const SearchSweep& small = printedCase(results, results.cases.front().model, TreeKind::Octree).sweep;
  const double large_worst = large.worst.leaves_found / large.leaves;
  const double small_worst = small.worst.leaves_found / small.leaves;
  return {{"more", std::max(large_worst, small_worst) > kPrintedShare},
          {"large_mean", large.mean.leaves_found / large.leaves},
          {"large_worst", large_worst},
          {"large", results.largest_model},
          {"small_mean", small.mean.leaves_found / small.leaves},
          {"small_worst", small_worst},
          {"small", results.cases.front().model}};
}

FindingValues againstLinear(const ComplexityResults& results) {
  return {{"bsp", shareWhereListWins(results, TreeKind::Bsp)},
          {"octree", shareWhereListWins(results, TreeKind::Octree)},
          {"once", keepsToTheNodes(results)},
          {"nodes_per_leaf", {mostNodesPerLeaf(results, TreeKind::Bsp), mostNodesPerLeaf(results, TreeKind::Octree)}}};
}

FindingValues searchesOfTrees(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return {{"model", results.largest_model},
          {"octree_leaves", octree.leaves},
          {"bsp_leaves", bsp.leaves},
          {"octree_tested", octree.mean.tested},
          {"bsp_tested", bsp.mean.tested},
          {"better", titleOf(octree.mean.tested < bsp.mean.tested ? TreeKind::Octree : TreeKind::Bsp)}};
}

std::ptrdiff_t columnsWith(const ComplexityResults& results, Verdict verdict) {
  return std::count_if(results.columns.begin(), results.columns.end(),
                       [&](const WorstColumn& column) { return columnVerdict(column) == verdict; });
}

FindingValues printedColumns(const ComplexityResults& results) {
  const bool same = std::all_of(results.columns.begin(), results.columns.end(), [](const WorstColumn& column) {
    return std::abs(column.counted - column.closed) <= kSameW * column.closed;
  });
  return {{"same", same},
          {"reproduced", columnsWith(results, Verdict::from_engine)},
          {"columns", results.columns.size()},
          {"misprints", columnsWith(results, Verdict::misprint)},
          {"failed", columnsWith(results, Verdict::not_reproduced)}};
}

FindingValues boundOfSearches(const ComplexityResults& results) {
  const double nearest = worstBoundRatio(results);
  return {{"bsp_height", heightAboveLinear(TreeKind::Bsp)},
          {"octree_height", heightAboveLinear(TreeKind::Octree)},
          {"kept", nearest <= 1.0},
          {"nearest", nearest}};
}

FindingValues growthOfSearches(const ComplexityResults& results) {
  const std::array exponents{growthExponent(results, TreeKind::Bsp, 4), growthExponent(results, TreeKind::Octree, 4),
                             growthExponent(results, TreeKind::Bsp, 16), growthExponent(results, TreeKind::Octree, 16)};
  return {{"bsp", exponents[0]},
          {"octree", exponents[1]},
          {"small_box", {exponents[2], exponents[3]}},
          {"slowly", std::all_of(exponents.begin(), exponents.end(), [](double power) { return power < 1.0; })}};
}

}  // namespace

Verdict columnVerdict(const WorstColumn& column) {
  const char* table = column.tree == TreeKind::Bsp ? "Table 3.3" : "Table 3.4";
  return judged(fmt::format("{}, height {}", table, column.height), "w", fmt::format("{:.2f}", column.printed),
                column.counted, "")
      .verdict;
}

std::string verdictText(Verdict verdict) {
  if (verdict == Verdict::misprint) return fmt::format("{} (E13)", wordFor(verdict));
  return verdict == Verdict::from_engine ? "reproduced" : std::string(wordFor(verdict));
}

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

double worstBoundRatio(const ComplexityResults& results) {
  double worst = 0.0;
  for (const SearchCase& one : results.cases) worst = std::max(worst, one.sweep.worst_over_bound);
  return worst;
}

std::vector<std::string> complexityFindings(const ComplexityResults& results) {
  return formatFindings(texts::complexity_findings, {{"cost", costOfSearches(results)},
                                                     {"share", shareOfLeaves(results)},
                                                     {"linear", againstLinear(results)},
                                                     {"trees", searchesOfTrees(results)},
                                                     {"columns", printedColumns(results)},
                                                     {"bound", boundOfSearches(results)},
                                                     {"growth", growthOfSearches(results)}});
}

}  // namespace palpate::study
