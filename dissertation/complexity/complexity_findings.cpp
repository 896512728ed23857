// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/complexity/complexity_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/hdb/complexity.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

// What (3.5) and (3.9) take for the largest share of leaves found.
constexpr double kPrintedShare = hdb::kWorstLeafRatio;
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

bool keepsToTheNodes(const ComplexityResults& results) {
  return std::all_of(results.cases.begin(), results.cases.end(),
                     [](const SearchCase& one) { return one.sweep.worst.tested <= one.sweep.nodes; });
}

std::string holdsFrom(const ComplexityResults& results, TreeKind tree) {
  const double leaves = leavesFromWhichPrintedHolds(results, tree);
  return leaves == 0.0 ? fmt::format("not even in the largest {}", titleOf(tree))
                       : fmt::format("from {:.0f} leaves on in the {}", leaves, titleOf(tree));
}

/// What of a search counts as its cost: nodes on the ways to the leaves, or boxes tested.
bool exceedsPrinted(const SearchSweep& sweep, TreeKind tree, double SearchCount::*cost) {
  return sweep.worst.*cost > printedCost(tree) * sweep.leaves;
}

std::string costVerdict(bool bsp, bool octree) {
  if (bsp && octree)
    return "For the boxes that a search tests, 0.8 n and 0.4 n are no worst cases at the dissertation's own threshold";
  if (bsp) return "For the boxes that a search tests, 0.8 n is no worst case, and 0.4 n was kept";
  return octree ? "For the boxes that a search tests, 0.4 n is no worst case, and 0.8 n was kept"
                : "The boxes that a search tests kept to 0.8 n and 0.4 n at the dissertation's own threshold";
}

std::string costFinding(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "{}. On the {} triangles (1024, box of 1/4) the nodes on the ways come to {:.2f} n at most in the BSP tree and "
      "{:.2f} n in the octree. A program must also test the other children of every node that it enters: up to {:.2f} "
      "n "
      "and {:.2f} n boxes, {:.2f} n and {:.2f} n on average. The estimates hold for the boxes tested {}, and {}.",
      costVerdict(exceedsPrinted(bsp, TreeKind::Bsp, &SearchCount::tested),
                  exceedsPrinted(octree, TreeKind::Octree, &SearchCount::tested)),
      results.largest_model, bsp.worst.on_paths / bsp.leaves, octree.worst.on_paths / octree.leaves,
      bsp.worst.tested / bsp.leaves, octree.worst.tested / octree.leaves, bsp.mean.tested / bsp.leaves,
      octree.mean.tested / octree.leaves, holdsFrom(results, TreeKind::Bsp), holdsFrom(results, TreeKind::Octree));
}

std::string shareFinding(const ComplexityResults& results) {
  const SearchSweep& large = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  const SearchSweep& small = printedCase(results, results.cases.front().model, TreeKind::Octree).sweep;
  const double most = std::max(large.worst.leaves_found / large.leaves, small.worst.leaves_found / small.leaves);
  return fmt::format(
      "The estimates assume that at most a tenth of the leaves meet the detecting box; {}. With a box of 1/4 and "
      "leaves of "
      "1024 it is {:.2f} of them on average and {:.2f} at most in the octree of the {} triangles, {:.2f} and {:.2f} "
      "for "
      "the {}.",
      most > kPrintedShare ? "here more do" : "so it is here", large.mean.leaves_found / large.leaves,
      large.worst.leaves_found / large.leaves, results.largest_model, small.mean.leaves_found / small.leaves,
      small.worst.leaves_found / small.leaves, results.cases.front().model);
}

std::string linearFinding(const ComplexityResults& results) {
  return fmt::format(
      "\"Better than the n of linear searching\": on average until {} of the leaves are found in the BSP tree and {} "
      "in the octree; beyond, a list of the leaves would test fewer boxes. {}",
      percent(shareWhereListWins(results, TreeKind::Bsp)), percent(shareWhereListWins(results, TreeKind::Octree)),
      keepsToTheNodes(results)
          ? fmt::format(
                "But no search tested more boxes than the tree has nodes (up to {:.2f} n and {:.2f} n here), and "
                "none can, because none is tested twice: it stays O(n), and the worst case \"over O(n)\" of "
                "which 3.4.2 warns cannot happen.",
                mostNodesPerLeaf(results, TreeKind::Bsp), mostNodesPerLeaf(results, TreeKind::Octree))
          : "Some search tested a box twice.");
}

std::string treesFinding(const ComplexityResults& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "\"0.4 n is better than 0.8 n\" compares different n: at the same threshold the octree of the {} triangles has "
      "{:.0f} leaves and the BSP tree {:.0f}, and a search tests {:.0f} boxes in the one and {:.0f} in the other: the "
      "{} "
      "is better here.",
      results.largest_model, octree.leaves, bsp.leaves, octree.mean.tested, bsp.mean.tested,
      titleOf(octree.mean.tested < bsp.mean.tested ? TreeKind::Octree : TreeKind::Bsp));
}

std::ptrdiff_t columnsWith(const ComplexityResults& results, Verdict verdict) {
  return std::count_if(results.columns.begin(), results.columns.end(),
                       [&](const WorstColumn& column) { return verdictOf(column) == verdict; });
}

std::string columnsFinding(const ComplexityResults& results) {
  const bool same = std::all_of(results.columns.begin(), results.columns.end(), [](const WorstColumn& column) {
    return std::abs(column.counted - column.closed) <= kSameW * column.closed;
  });
  const auto misprints = columnsWith(results, Verdict::misprint);
  const auto failed = columnsWith(results, Verdict::not_reproduced);
  return fmt::format(
      "Counted node by node on complete trees, w {} the closed form says. {} of the {} printed values come "
      "out{}{}.",
      same ? "is what" : "is NOT what", columnsWith(results, Verdict::from_engine), results.columns.size(),
      misprints > 0 ? fmt::format(", {} are misprints in the last digit (E13)", misprints) : "",
      failed > 0 ? fmt::format(", {} do NOT, and no erratum says why", failed) : "");
}

std::string boundFinding(const ComplexityResults& results) {
  const double nearest = worstBoundRatio(results);
  return fmt::format(
      "The estimate r w nodes multiplies the worst r with the worst w, which never meet: w is that of a single leaf. "
      "So "
      "it passes n by itself from height {} of the BSP tree and {} of the octree on. The true most, the nodes on the "
      "ways "
      "to m leaves, was {} every search counted ({:.2f} of it at most).",
      heightAboveLinear(TreeKind::Bsp), heightAboveLinear(TreeKind::Octree), nearest <= 1.0 ? "kept by" : "NOT kept by",
      nearest);
}

std::string growthFinding(const ComplexityResults& results) {
  const std::array exponents{growthExponent(results, TreeKind::Bsp, 4), growthExponent(results, TreeKind::Octree, 4),
                             growthExponent(results, TreeKind::Bsp, 16), growthExponent(results, TreeKind::Octree, 16)};
  const bool below = std::all_of(exponents.begin(), exponents.end(), [](double power) { return power < 1.0; });
  return fmt::format(
      "Over the thresholds the worst search grows with the leaves like n to the power {:.2f} (BSP) and {:.2f} (octree) "
      "for "
      "a box of 1/4, {:.2f} and {:.2f} for 1/16: {}.",
      exponents[0], exponents[1], exponents[2], exponents[3],
      below ? "more slowly than the tree" : "as fast as the tree, or faster");
}

}  // namespace

Verdict verdictOf(const WorstColumn& column) {
  const char* table = column.tree == TreeKind::Bsp ? "Table 3.3" : "Table 3.4";
  return judged(fmt::format("{}, height {}", table, column.height), "w", fmt::format("{:.2f}", column.printed),
                column.counted, "")
      .verdict;
}

std::string wordOf(Verdict verdict) {
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
  return {costFinding(results),    shareFinding(results), linearFinding(results), treesFinding(results),
          columnsFinding(results), boundFinding(results), growthFinding(results)};
}

}  // namespace palpate::study
