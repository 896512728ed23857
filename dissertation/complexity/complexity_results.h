// What the complexity study measures: w counted on complete trees, and searches of real models over thresholds and
// sizes of the detecting box.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "dissertation/numbers/number_row.h"
#include "lab/measured/haptic_frames.h"
#include "palpate/hdb/haptic_box.h"
#include "report/page/plot_parts.h"
#include "report/page/study_page.h"

namespace palpate::study {

// What the search for the leaves around the proxy really visits, counted node by node, beside the closed forms of
// (3.1) to (3.9).
//
// The dissertation's cost c counts the nodes on the ways to the leaves found. A program does more: it tests the box of
// every child of a node that it enters. Both are counted here, on complete trees, where the closed forms must hold
// exactly, and on the trees of real models.
// Based on: Ji (2008), 3.3.4 and 3.4.2.

/// Children of a node: 2 or 8.
int arityOf(hdb::TreeKind tree);

/// One query, or the worst or mean of many.
struct SearchCount {
  double leaves_found = 0.0;  ///< m
  double on_paths = 0.0;      ///< nodes with a found leaf below them: the c of the text
  double entered = 0.0;       ///< and those that were entered in vain
  double tested = 0.0;        ///< boxes tested: what a program does
};

/// Small triangles, one in the middle of each cell of a regular division of a cube into arity^height cells, so that the
/// tree over them with a threshold of 1 is complete.
mesh::TriangleMesh completeTreeMesh(hdb::TreeKind tree, int height);

/// Counts one search.
class SearchCounter {
 public:
  /// The partition must outlive the counter.
  explicit SearchCounter(const hdb::Partition& partition);

  SearchCount count(const Box3& box);

 private:
  const hdb::Partition& partition_;
  std::vector<Index> parents_;
  std::vector<std::uint32_t> stamp_of_node_;
  std::uint32_t stamp_ = 0;
  hdb::LeafHits hits_;
};

/// Many searches over one tree with a detecting box of one size.
struct SearchSweep {
  int height = 0;
  double leaves = 0.0;  ///< n
  double nodes = 0.0;   ///< of the whole tree
  SearchCount mean;
  SearchCount worst;                 ///< each number by itself
  double worst_over_bound = 0.0;     ///< largest on_paths over mostNodesOnPaths; at most 1
  std::vector<SearchCount> queries;  ///< all of them
};

/// Searches around up to `most_places` vertices of the mesh, evenly chosen; the box is a cube.
SearchSweep sweepSearches(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, double edge_mm,
                          std::size_t most_places);

inline constexpr std::array kStudiedThresholds{64, 128, 256, 512, 1024, 2048, 4096};
/// Edges of the detecting box as parts of the model's longest edge; a quarter is the dissertation's.
inline constexpr std::array kBoxParts{16, 8, 4, 2};
inline constexpr int kPrintedPart = 4;
/// In smaller trees a single leaf is too large a share of all for shares to mean something.
inline constexpr double kFewestLeaves = 30.0;

/// What (3.5) and (3.9) print for c over n.
double printedCost(hdb::TreeKind tree);

/// A column of Table 3.3 or 3.4.
struct WorstColumn {
  hdb::TreeKind tree = hdb::TreeKind::Bsp;
  int height = 0;
  double printed = 0.0;
  double closed = 0.0;
  double counted = 0.0;
};

/// Searches in one tree with one size of box.
struct SearchCase {
  std::string model;
  hdb::TreeKind tree = hdb::TreeKind::Bsp;
  Index threshold = 0;
  int part = 0;
  SearchSweep sweep;
};

struct ComplexityResults {
  std::vector<WorstColumn> columns;
  std::vector<SearchCase> cases;  ///< by model, tree, threshold, part
  std::string largest_model;
};

ComplexityResults measureComplexity(const StudySettings& settings);

std::vector<const SearchCase*> casesWhere(const ComplexityResults& results,
                                          const std::function<bool(const SearchCase&)>& wanted);

/// Threshold and box as printed. The model must have been measured.
const SearchCase& printedCase(const ComplexityResults& results, const std::string& model, hdb::TreeKind tree);

/// complexity_figures.cpp: the pictures of the study.
std::vector<StudyFigure> complexityFigures(const ComplexityResults& results);

// What the counted searches say of the printed estimates: sentences made of nothing but the results.

/// A paragraph each, most important first. The printed threshold and box must have been measured in the first and the
/// largest model.
std::vector<std::string> complexityFindings(const ComplexityResults& results);

/// A misprint only where the list of misprints has it and the counted w is the number that it names (number_row.h).
Verdict verdictOf(const WorstColumn& column);
/// "reproduced", "misprint (E13)" or "NOT REPRODUCED".
std::string wordOf(Verdict verdict);

/// The share of found leaves from which a tree tests more boxes on average than a list of its leaves has.
double shareWhereListWins(const ComplexityResults& results, hdb::TreeKind tree);
/// The most of all searches over what a search can cost.
double worstBoundRatio(const ComplexityResults& results);

}  // namespace palpate::study
