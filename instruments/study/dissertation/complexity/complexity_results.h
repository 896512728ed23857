// Results of the complexity study: w counted on complete trees, and searches of real models over thresholds and sizes
// of the detecting box.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "dissertation/complexity/search_cost.h"
#include "dissertation/numbers/number_row.h"
#include "report/page/plot_parts.h"
#include "report/page/study_page.h"

namespace palpate::study {

inline constexpr std::array kStudiedThresholds{64, 128, 256, 512, 1024, 2048, 4096};
/// Edges of the detecting box as parts of the model's longest edge; a quarter is the dissertation's.
inline constexpr std::array kBoxParts{16, 8, 4, 2};
inline constexpr int kPrintedPart = 4;
/// In smaller trees a single leaf is too large a share of all for shares to mean something.
inline constexpr double kFewestLeaves = 30.0;

/// Printed c over n in (3.5) and (3.9).
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

// Findings from the counted searches about the printed estimates: sentences made of nothing but the results.

/// Paragraphs, most important first. The printed threshold and box must have been measured in the first and the largest
/// model.
std::vector<std::string> complexityFindings(const ComplexityResults& results);

/// A misprint only where the list of misprints has it and the counted w is the number that it names (number_row.h).
Verdict columnVerdict(const WorstColumn& column);
/// "reproduced", "misprint (E13)" or "NOT REPRODUCED".
std::string verdictText(Verdict verdict);

/// The share of found leaves from which a tree tests more boxes on average than a list of its leaves has.
double shareWhereListWins(const ComplexityResults& results, hdb::TreeKind tree);
/// The largest ratio, over all searches, of a cost to its bound.
double worstBoundRatio(const ComplexityResults& results);

}  // namespace palpate::study
